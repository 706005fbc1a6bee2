"""Offset and shell (T§4.2), erosion, opening and closing (T§1.2): morphology of one solid with a ball, or with another solid."""
import FreeCAD

from . import operands, wall_findings
from .operation_feature import OperationFeature, Parameter, Role
from .translation import QT_TRANSLATE_NOOP, translate


class _Morphology(OperationFeature):
    call = ""  # the engine's function of a solid and an amount
    roles = (Role("Source", QT_TRANSLATE_NOOP("App::Property", "The solid to work on"), many=False),)
    outputs = wall_findings.PROPERTIES
    highlighted = wall_findings.HIGHLIGHTED
    counts_parts = True  # whether the result is inside the source, or the source in it, well apart

    def compute(self, starcell, solids, values, options):
        amount = values[self.parameters[0].name]
        return getattr(starcell, self.call)(solids["Source"], amount, **options)

    def examine(self, starcell, solids, values, result, options):
        progress = options["progress"]
        return wall_findings.examine(starcell, solids["Source"], self.reach_of_ball(values[self.parameters[0].name]), result, options["error"],
                                     lambda done, stage: progress(1.0, stage), self.counts_parts)

    def published(self, obj, result, findings):
        wall_findings.publish(obj, findings)

    def grown(self, amount):
        """How far the result may reach beyond the source."""
        return 0.0

    def reach_of_ball(self, amount):
        """How far the ball moves the surface at first: above 0 outward."""
        return amount

    def _automatic_error(self, obj, given, chosen):
        # The result's size is known only with the amount.
        box = FreeCAD.BoundBox(given["Source"].box)
        box.enlarge(self.grown(chosen[self.parameters[0].name]))
        if not box.isValid() or obj.ErrorDivisor < 1:
            return super()._automatic_error(obj, given, chosen)
        return max(box.XLength, box.YLength, box.ZLength) / obj.ErrorDivisor


class Offset(_Morphology):
    command = "StarCell_Offset"
    title = QT_TRANSLATE_NOOP("StarCell", "Offset")
    help = QT_TRANSLATE_NOOP("StarCell", "Makes a solid thicker or thinner by the same amount everywhere, with a proved topology and distance")
    call = "offset"
    parameters = (Parameter("Distance", "App::PropertyDistance", QT_TRANSLATE_NOOP(
        "App::Property", "How far the surface moves: above 0 outward, with rounded edges; below 0 inward"), default=1.0),)

    def grown(self, amount):
        return max(0.0, amount)


class Shell(_Morphology):
    command = "StarCell_Shell"
    title = QT_TRANSLATE_NOOP("StarCell", "Shell")
    help = QT_TRANSLATE_NOOP("StarCell", "Makes a wall of even thickness about a solid's surface, open where faces are picked, with a proved topology and distance")
    call = "shell"
    faces = "OpenFaces"
    counts_parts = False
    parameters = (Parameter("Thickness", "App::PropertyDistance", QT_TRANSLATE_NOOP(
        "App::Property", "Thickness of the wall: above 0 outside the solid, below 0 inside"), default=1.0),
                  Parameter("OpenFaces", "App::PropertyStringList", QT_TRANSLATE_NOOP(
                      "App::Property", "Names of the source's faces that get no wall: Face3, ...")))

    def gather(self, each, obj, chosen, folder):
        return operands.gather(each, obj, folder, faces=bool(chosen["OpenFaces"]))

    def compute(self, starcell, solids, values, options):
        names = values["OpenFaces"]
        if not names:
            return super().compute(starcell, solids, values, options)
        solid = solids["Source"]
        if not len(getattr(solid, "cad_faces", ())):
            raise operands.OperandError(translate("StarCell", "Only a single CAD solid has faces that can be left open; take {} out of OpenFaces, "
                                                              "or make one solid of the source.").format(", ".join(names)))
        return starcell.shell(solid, values["Thickness"], open_faces=_numbers(names, max(solid.cad_faces)), **options)

    def grown(self, amount):
        return max(0.0, amount)


def _numbers(names, last):
    """Face3 is 3, as long as there is such a face."""
    numbers = []
    for name in names:
        number = name.strip()[4:]
        if not (name.strip().startswith("Face") and number.isdigit() and 1 <= int(number) <= last):
            raise operands.OperandError(translate("StarCell", "OpenFaces: '{}' is no face of the source; they are Face1 to Face{}.").format(name, last))
        numbers.append(int(number))
    return numbers


class _WithElement(_Morphology):
    """With a ball, or with any solid: `Element` counts before `Radius`."""
    roles = _Morphology.roles + (Role("Element", QT_TRANSLATE_NOOP(
        "App::Property", "The solid to work with, as it stands in the document; none: a ball about the origin"), many=False, least=0),)

    def compute(self, starcell, solids, values, options):
        element = solids["Element"]
        return getattr(starcell, self.call)(solids["Source"], values["Radius"] if element is None else element, **options)

    def examine(self, starcell, solids, values, result, options):
        # Walls too thin for a solid that is no ball are not looked for.
        return super().examine(starcell, solids, values, result, options) if solids["Element"] is None else None

    def published(self, obj, result, findings):
        super().published(obj, result, findings or wall_findings.WallFindings(0.0, False))

    def reach(self, boxes):
        return boxes["Source"]


class Erode(_WithElement):
    command = "StarCell_Erode"
    title = QT_TRANSLATE_NOOP("StarCell", "Erode")
    help = QT_TRANSLATE_NOOP("StarCell", "Keeps what of a solid is farther than a radius from its surface, or where a second solid fits into it")
    call = "erode"
    parameters = (Parameter("Radius", "App::PropertyLength", QT_TRANSLATE_NOOP("App::Property", "Radius of the ball"), default=1.0),)

    def reach_of_ball(self, amount):
        return -amount


class Opening(_WithElement):
    command = "StarCell_Opening"
    title = QT_TRANSLATE_NOOP("StarCell", "Opening")
    help = QT_TRANSLATE_NOOP("StarCell", "Rounds convex edges with a constant radius, and removes what is thinner than twice that, or where a second "
                                         "solid does not fit")
    call = "opening"
    counts_parts = False
    parameters = (Parameter("Radius", "App::PropertyLength", QT_TRANSLATE_NOOP("App::Property", "Radius of the rounding"), default=1.0),)

    def reach_of_ball(self, amount):
        return -amount


class Closing(_WithElement):
    command = "StarCell_Closing"
    title = QT_TRANSLATE_NOOP("StarCell", "Closing")
    help = QT_TRANSLATE_NOOP("StarCell", "Rounds concave edges with a constant radius, and fills what is narrower than twice that, or than a second solid")
    call = "closing"
    counts_parts = False
    parameters = (Parameter("Radius", "App::PropertyLength", QT_TRANSLATE_NOOP("App::Property", "Radius of the rounding"), default=1.0),)
