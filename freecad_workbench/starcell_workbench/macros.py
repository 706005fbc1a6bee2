"""The functions for macros: each makes one parametric object, recomputes it, and returns it.

    make_union([a, b, ...], error=None, contact=None, label=None, document=None)

error, contact: mm as a number, or a text with a unit such as "0.1 mm"; None: automatic. Wrong arguments raise ValueError or
TypeError and leave the document as it was. What goes wrong in the computation itself marks the object invalid, as for every
FreeCAD object: `obj.isValid()` is False and the reason is in the report view.
"""
import FreeCAD

from . import lengths
from .boolean_feature import Cut, Intersection, Union
from .configuration_feature import ConfigurationSpace, FreePositions
from .depth_feature import PenetrationDepth
from .minkowski_feature import MinkowskiSum
from .offset_feature import Closing, Erode, Offset, Opening, Shell
from .operation_feature import recompute
from .remesh_feature import Remesh
from .repair_feature import Repair
from .rescue_feature import Rescue
from .simplify_feature import Simplify
from .solid_feature import ToSolid


def make_union(objects, error=None, contact=None, label=None, document=None):
    """The union of two or more objects."""
    return make(Union, {"Operands": objects}, error, contact, label, document)


def make_cut(base, tools, error=None, contact=None, label=None, document=None):
    """`base` without `tools`: one object, or a sequence of them."""
    return make(Cut, {"Base": base, "Tools": tools}, error, contact, label, document)


def make_intersection(objects, error=None, contact=None, label=None, document=None):
    """What two or more objects have in common."""
    return make(Intersection, {"Operands": objects}, error, contact, label, document)


def make_rescue(obj, error=None, contact=None, label=None, document=None):
    """The history of `obj` (Booleans, compounds, mirror images and links of Part) computed anew, all at once."""
    return make(Rescue, {"Source": obj}, error, contact, label, document)


def make_offset(obj, distance, error=None, contact=None, label=None, document=None):
    """`obj` made thicker (distance > 0, rounded edges) or thinner (< 0); distance: mm, or a text with a unit."""
    return _make_morphology(Offset, obj, "Distance", lengths.parse(distance, "distance"), error, contact, label, document)


def make_shell(obj, thickness, error=None, contact=None, label=None, document=None, open_faces=()):
    """A wall about the surface of `obj`: outside it (thickness > 0) or inside (< 0); mm, or a text with a unit.

    open_faces: names of faces of `obj`, such as "Face3", that get no wall.
    """
    if isinstance(open_faces, str) or not all(isinstance(name, str) for name in open_faces):
        raise TypeError("open_faces: expected names of faces, such as [\"Face3\"], not {!r}.".format(open_faces))
    return _make_morphology(Shell, obj, "Thickness", lengths.parse(thickness, "thickness"), error, contact, label, document,
                            OpenFaces=list(open_faces))


def make_erode(obj, element, error=None, contact=None, label=None, document=None):
    """What of `obj` is farther than a radius from its surface; or, `element` being an object, where that fits into `obj`."""
    return _make_with_element(Erode, obj, element, error, contact, label, document)


def make_opening(obj, element, error=None, contact=None, label=None, document=None):
    """`obj` with convex edges rounded by a radius, without what is thinner than twice that; or all that an object covers in it."""
    return _make_with_element(Opening, obj, element, error, contact, label, document)


def make_closing(obj, element, error=None, contact=None, label=None, document=None):
    """`obj` with concave edges rounded by a radius, and what is narrower than twice that, or than an object, filled."""
    return _make_with_element(Closing, obj, element, error, contact, label, document)


def make_minkowski_sum(obj, element, error=None, contact=None, label=None, document=None):
    """`obj` swept by `element`: all sums of a point of one and a point of the other, both as they stand in the document."""
    return make(MinkowskiSum, {"Source": obj, "Element": element}, error, contact, label, document)


def make_configuration_space(robot, obstacles, height=0, margin=None, turn_height=None, error=None, contact=None, label=None, document=None):
    """Where `robot` can be in the plane z = `height` (0: the middle of what all have in common) among `obstacles` (an object, or a sequence of them), and how turned: over x and y of its middle, the turn as height.

    height, margin, turn_height: mm, or a text with a unit; margin: how far beyond the obstacles, None: automatic; turn_height: of a full turn as drawn.
    """
    return make(ConfigurationSpace, {"Robot": robot, "Obstacles": obstacles}, error, contact, label, document, Height=lengths.parse(height, "height"),
                Margin=lengths.parse_positive(margin, "margin") if margin is not None else 0,
                TurnHeight=lengths.parse_positive(turn_height, "turn_height") if turn_height is not None else 0)


def make_free_positions(robot, obstacles, margin=None, error=None, contact=None, label=None, document=None):
    """Where the middle of `robot` can be in space, without a turn, so that it meets none of `obstacles`: an object, or a sequence of them."""
    return make(FreePositions, {"Robot": robot, "Obstacles": obstacles}, error, contact, label, document,
                Margin=lengths.parse_positive(margin, "margin") if margin is not None else 0)


def make_simplified(obj, error=None, contact=None, label=None, document=None):
    """`obj` in fewer triangles, within the error both ways."""
    return make(Simplify, {"Source": obj}, error, contact, label, document)


def make_remeshed(obj, edge_length=None, feature_angle=40.0, error=None, contact=None, label=None, document=None):
    """`obj` in well-shaped triangles, within the error both ways. Most edges are of `edge_length` (mm; None: five errors); edges at which the
    mesh turns by more than `feature_angle` degrees stay where they are."""
    length = 0.0 if edge_length is None else lengths.parse_positive(edge_length, "edge_length")
    degrees = lengths.parse_angle(feature_angle, "feature_angle")
    if not 0 < degrees < 180:
        raise ValueError("feature_angle: must be between 0 and 180 degrees, not {!r}.".format(feature_angle))
    return make(Remesh, {"Source": obj}, error, contact, label, document, EdgeLength=length, FeatureAngle=degrees)


def make_repaired(meshes, error=None, contact=None, label=None, document=None):
    """The solid that one or more meshes mean together, in whatever state they are: what their triangles wind about. Holes up to ten errors wide
    are filled; `Flaws` says what was wrong."""
    return make(Repair, {"Meshes": meshes}, error, contact, label, document)


def _make_with_element(operation, obj, element, error, contact, label, document):
    if _is_object(element):
        return make(operation, {"Source": obj, "Element": element}, error, contact, label, document)
    radius = lengths.parse_positive(element, "element")
    return make(operation, {"Source": obj, "Element": None}, error, contact, label, document, Radius=radius)


def _make_morphology(operation, obj, name, amount, error, contact, label, document, **others):
    if amount == 0:
        raise ValueError("{}: must not be 0.".format(name.lower()))
    return make(operation, {"Source": obj}, error, contact, label, document, **{name: amount}, **others)


def make_solid(source, label=None, document=None):
    """A Part solid of a closed mesh, one of StarCell's or another; its planar regions are single faces."""
    if not _is_object(source):
        raise TypeError("source: expected a document object, not {!r}.".format(source))
    document = document or source.Document
    _check_document(document, (source,))
    if not source.getLinkedObject(True).isDerivedFrom("Mesh::Feature"):
        raise ValueError("source: '{}' is no mesh; take a result of StarCell or another closed mesh.".format(source.Label))

    obj = document.addObject("Part::FeaturePython", "Solid")
    ToSolid(obj)
    _name_and_place(obj, label, {"Source": [source]})
    obj.Source = source
    if FreeCAD.GuiUp and obj.ViewObject:
        from .solid_view import SolidView

        SolidView(obj.ViewObject)
    recompute(obj)
    if obj.isValid():
        source.Visibility = False
    return obj


def make_penetration_depth(first, second, error=None, label=None, document=None):
    """How far `second` has to move to come free of `first`, and which way; or how far apart they are. error: between the bounds."""
    for name, each in (("first", first), ("second", second)):
        if not _is_object(each):
            raise TypeError("{}: expected a document object, not {!r}.".format(name, each))
    if first is second:
        raise ValueError("second: is the same object as first, '{}'.".format(first.Label))
    error = None if error is None else lengths.parse_positive(error, "error")
    document = document or first.Document
    _check_document(document, (first, second))

    obj = document.addObject("App::FeaturePython", "PenetrationDepth")
    PenetrationDepth(obj)
    _name_and_place(obj, label, {"First": [first], "Second": [second]})
    obj.First, obj.Second, obj.Error = first, second, error or 0
    if FreeCAD.GuiUp and obj.ViewObject:
        from .depth_view import DepthView

        DepthView(obj.ViewObject)
    recompute(obj)
    return obj


def make(operation, given, error=None, contact=None, label=None, document=None, **values):
    """Any operation: given {role: object or sequence of objects}, values of its own parameters by name."""
    links = _check_links(operation, given)
    error, contact = (None if value is None else lengths.parse_positive(value, name) for name, value in (("error", error), ("contact", contact)))
    document = document or next(iter(links.values()))[0].Document
    _check_document(document, [each for objects in links.values() for each in objects])

    obj = document.addObject("Mesh::FeaturePython", operation.command.replace("StarCell_", ""))
    operation(obj)
    _name_and_place(obj, label, links)
    for role in operation.roles:
        setattr(obj, role.name, links[role.name] if role.many else next(iter(links[role.name]), None))
    for name, value in values.items():
        setattr(obj, name, value)
    obj.Error = error or 0
    obj.Contact = contact or 0
    if FreeCAD.GuiUp and obj.ViewObject:
        from .operation_view import OperationView

        OperationView(obj.ViewObject)
    recompute(obj)
    if obj.isValid() and not operation.keeps_operands:
        for each in obj.Proxy.linked(obj):
            each.Visibility = False
    return obj


def from_selection(operation, objects, **options):
    """The operation on a flat list of objects: a role of one takes the first, a role of many the rest."""
    given, rest = {}, list(objects)
    for role in operation.roles:
        given[role.name] = rest if role.many else rest.pop(0) if rest else None
    return make(operation, given, **options)


def _check_links(operation, given):
    links = {}
    for role in operation.roles:
        value = given[role.name]
        objects = [value] if _is_object(value) else [] if value is None and role.least == 0 else value
        if isinstance(objects, str) or not hasattr(objects, "__iter__"):
            raise TypeError("{}: expected document objects, not {!r}.".format(role.name, value))
        objects = list(objects)
        for each in objects:
            if not _is_object(each):
                raise TypeError("{}: expected document objects, not {!r}.".format(role.name, each))
        if len(objects) < role.least or not role.many and len(objects) > 1:
            raise ValueError("{}: expected {} {}, got {}.".format(
                role.name, "at least" if role.many else "exactly" if role.least else "at most", max(role.least, not role.many), len(objects)))
        links[role.name] = objects
    return links


def _check_document(document, objects):
    for each in objects:
        if each.Document is not document:
            raise ValueError("'{}' is in another document than the result, '{}': link it there first.".format(each.Label, document.Label))


def _name_and_place(obj, label, links):
    """Beside its operands, where these lie in one container."""
    if label:
        obj.Label = label
    container = _common_container(links)
    if container:
        container.addObject(obj)


def _is_object(value):
    return hasattr(value, "isDerivedFrom") and value.isDerivedFrom("App::DocumentObject")


def _common_container(links):
    """The App::Part that all operands lie in, if it is one and the same."""
    around = {each.getParentGeoFeatureGroup() for objects in links.values() for each in objects}
    container = around.pop()
    return container if container and not around and container.isDerivedFrom("App::Part") else None
