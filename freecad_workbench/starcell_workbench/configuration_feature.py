"""Configuration spaces: where a part can be among obstacles, as a surface that one can look at (T§5.1-5.4)."""
import math
from types import SimpleNamespace

import FreeCAD
import numpy

from . import lengths, planar_section
from .operation_feature import OUTPUT, READ_ONLY, OperationFeature, Parameter, Role
from .translation import QT_TRANSLATE_NOOP, translate

MARGIN_SHARE = 2   # of how far the robot reaches from its pivot: outside the obstacles it passes


class _FreeSpace(OperationFeature):
    keeps_operands = True   # they are looked at, not used up
    roles = (Role("Robot", QT_TRANSLATE_NOOP("App::Property", "The object that moves"), many=False),
             Role("Obstacles", QT_TRANSLATE_NOOP("App::Property", "The objects that it must not meet")))
    parameters = (Parameter("Margin", "App::PropertyLength", QT_TRANSLATE_NOOP(
        "App::Property", "How far beyond the obstacles positions reach; 0: twice the robot's reach from its pivot")),)
    outputs = (
        ("App::PropertyVector", "Pivot", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP("App::Property", "The robot's point whose positions are shown: the middle of its box")),
        ("App::PropertyInteger", "FreeComponents", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP(
            "App::Property", "Pieces of the free space, where a full turn is none: from one the robot gets into no other; -1: not told at this error")))

    def examine(self, starcell, solids, values, result, options):
        return result

    def published(self, obj, result, findings):
        obj.Pivot = FreeCAD.Vector(*result.pivot)
        obj.FreeComponents = -1 if result.free_components is None else result.free_components
        told = translate("StarCell", "Free pieces that the robot cannot leave: {}.").format(obj.FreeComponents)
        obj.Report += "\n" + (told if obj.FreeComponents >= 0 else translate("StarCell", "How many free pieces there are is not told at this error."))

    def reach(self, boxes):
        whole = FreeCAD.BoundBox()
        for box in boxes["Obstacles"]:
            whole.add(box)
        whole.enlarge(MARGIN_SHARE * 0.5 * boxes["Robot"].DiagonalLength)
        return whole


class ConfigurationSpace(_FreeSpace):
    command = "StarCell_ConfigurationSpace"
    title = QT_TRANSLATE_NOOP("StarCell", "Configuration space")
    help = QT_TRANSLATE_NOOP("StarCell", "Where the first object can be in a plane among the others, and how turned: a solid over x and y, whose height is the turn. "
                                         "Sections, faces and sketches; counts the pieces of it that the object cannot leave")
    parameters = _FreeSpace.parameters + (
        Parameter("Height", "App::PropertyDistance", QT_TRANSLATE_NOOP("App::Property", "z of the plane in which the motion is; 0: the middle of what all objects have in common")),
        Parameter("TurnHeight", "App::PropertyLength", QT_TRANSLATE_NOOP(
            "App::Property", "How high a full turn is drawn, above Height; 0: as the longest side of the bounds")))
    outputs = _FreeSpace.outputs + (
        ("App::PropertyLength", "TurnDrawn", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP("App::Property", "How high a full turn is drawn")),)

    def chosen(self, obj):
        values = super().chosen(obj)
        values["Height"] = values["Height"] or planar_section.common_height(self.linked(obj), obj)
        return values

    def gather(self, each, obj, chosen, folder):
        return planar_section.Section(each, obj, chosen["Height"])

    def compute(self, starcell, solids, values, options):
        return _planar(starcell, solids, values, options)

    def published(self, obj, result, findings):
        super().published(obj, result, findings)
        obj.TurnDrawn = result.turn_height
        lines = [translate("StarCell", "Error and distances count a turn as the length that the robot's farthest point moves; a full one is drawn {} high.").format(
            lengths.show(obj.TurnDrawn))]
        if result.deflection:
            lines.append(translate("StarCell", "Curved outlines were replaced by chords within {:.3g} mm: what is proved is proved of these.").format(result.deflection))
        obj.Report = "\n".join([obj.Report] + lines)


class FreePositions(_FreeSpace):
    command = "StarCell_FreePositions"
    title = QT_TRANSLATE_NOOP("StarCell", "Free positions")
    help = QT_TRANSLATE_NOOP("StarCell", "Where the middle of the first solid can be in space, without a turn, so that it meets none of the others; counts the pieces of "
                                         "it that the solid cannot leave")

    def compute(self, starcell, solids, values, options):
        return _spatial(starcell, solids, values, options)


def _planar(starcell, solids, values, options):
    """The mesh in x, y and height; certificate boxes likewise."""
    robot, obstacles = solids["Robot"], solids["Obstacles"]
    pivot = numpy.array([robot.box.Center.x, robot.box.Center.y])
    own = [[ring - pivot for ring in polygon] for polygon in robot.polygons]
    margin = values["Margin"] or MARGIN_SHARE * max(numpy.linalg.norm(polygon[0], axis=1).max() for polygon in own)
    lower = [min(each.box.XMin for each in obstacles) - margin, min(each.box.YMin for each in obstacles) - margin]
    upper = [max(each.box.XMax for each in obstacles) + margin, max(each.box.YMax for each in obstacles) + margin]
    found = starcell.free_space(starcell.PlanarRobot(own), [polygon for each in obstacles for polygon in each.polygons], (lower, upper), **options)
    turn = values["TurnHeight"] or max(numpy.subtract(upper, lower))

    def drawn(points):
        points = numpy.array(points, dtype=float)
        points[..., 2] = values["Height"] + points[..., 2] * turn / (2 * math.pi)
        return points

    def boxes(given):
        return [tuple(map(tuple, drawn(box))) for box in given]

    fields = {name: getattr(found.certificate, name) for name in (
        "verdict", "error_bound", "requested_error", "contact_tolerance", "components", "genus", "euler_characteristic", "tessellated", "statistics")}
    certificate = SimpleNamespace(contacts=boxes(found.certificate.contacts), unresolved=boxes(found.certificate.unresolved), **fields)
    return SimpleNamespace(vertices=drawn(found.vertices), triangles=found.triangles, certificate=certificate, free_components=found.free_components,
                           pivot=(*pivot, values["Height"]), turn_height=turn, deflection=max(each.deflection for each in [robot] + obstacles))


def _spatial(starcell, solids, values, options):
    robot, obstacles = solids["Robot"], solids["Obstacles"]
    low, high = (numpy.array(corner) for corner in robot.bounding_box)
    pivot = 0.5 * (low + high)
    move = numpy.eye(4)
    move[:3, 3] = -pivot
    whole = obstacles[0] if len(obstacles) == 1 else starcell.union(obstacles)
    margin = values["Margin"] or MARGIN_SHARE * 0.5 * numpy.linalg.norm(high - low)
    lower, upper = whole.bounding_box
    found = starcell.free_space(starcell.TranslatingRobot(robot.transformed(move)), whole, (numpy.subtract(lower, margin), numpy.add(upper, margin)), **options)
    return SimpleNamespace(vertices=found.vertices, triangles=found.triangles, certificate=found.certificate, free_components=found.free_components, pivot=pivot)
