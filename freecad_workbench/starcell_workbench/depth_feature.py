"""How deep two solids overlap, and which way out is the shortest; or how far apart they are (T§4.3).

The class is the proxy of an App::FeaturePython, and its path is stored in documents: rename or move it only with a migration.
All state is in properties. A recompute that fails raises, so that FreeCAD marks the object, and changes none of them.
"""
import tempfile

import FreeCAD

from . import engine, lengths, operands, runner
from .operation_feature import HIDDEN, OUTPUT, READ_ONLY, TESSELLATION_SHARE
from .stateless import Stateless
from .translation import QT_TRANSLATE_NOOP, translate

AUTOMATIC_SHARE = 0.01  # of the smaller solid's longest side


class PenetrationDepth(Stateless):
    command = "StarCell_PenetrationDepth"
    title = QT_TRANSLATE_NOOP("StarCell", "Penetration depth")
    help = QT_TRANSLATE_NOOP("StarCell", "Measures how far the second solid has to move to come free of the first, and which way; or how far apart they "
                                         "are. Both bounds are proved")

    def __init__(self, obj):
        obj.Proxy = self
        self.add_properties(obj)

    def add_properties(self, obj):
        """Adds what is missing: to a new object all, to one of an older version what came later."""
        given, found = "Measure", "Result"
        for type_, name, group, help_, attributes in (
                ("App::PropertyLinkGlobal", "First", given, QT_TRANSLATE_NOOP("App::Property", "The solid that stays"), 0),
                ("App::PropertyLinkGlobal", "Second", given, QT_TRANSLATE_NOOP("App::Property", "The solid that would move"), 0),
                ("App::PropertyLength", "Error", given, QT_TRANSLATE_NOOP(
                    "App::Property", "How far apart the two bounds may be; 0: a hundredth of the smaller solid's longest side"), 0),
                ("App::PropertyLinkListGlobal", "Frames", given, QT_TRANSLATE_NOOP(
                    "App::Property", "Containers whose placement moves a solid against the other"), HIDDEN | OUTPUT),
                ("App::PropertyLength", "DepthLower", found, QT_TRANSLATE_NOOP("App::Property", "No shorter move separates the solids; 0: none is proved"),
                 READ_ONLY | OUTPUT),
                ("App::PropertyLength", "DepthUpper", found, QT_TRANSLATE_NOOP(
                    "App::Property", "A move of this length along Direction separates them; 0: they do not overlap"), READ_ONLY | OUTPUT),
                ("App::PropertyVector", "Direction", found, QT_TRANSLATE_NOOP("App::Property", "The way out for the second solid, of length 1; 0 if none is needed"),
                 READ_ONLY | OUTPUT),
                ("App::PropertyLength", "ClearanceLower", found, QT_TRANSLATE_NOOP("App::Property", "The solids are at least this far apart; 0: they may touch"),
                 READ_ONLY | OUTPUT),
                ("App::PropertyLength", "ClearanceUpper", found, QT_TRANSLATE_NOOP("App::Property", "The solids are no farther apart than this; 0: they overlap"),
                 READ_ONLY | OUTPUT),
                ("App::PropertyVector", "PointOfFirst", found, QT_TRANSLATE_NOOP(
                    "App::Property", "Where the second solid touches the first once it is moved, or is nearest to it"), READ_ONLY | OUTPUT),
                ("App::PropertyVector", "PointOfSecond", found, QT_TRANSLATE_NOOP("App::Property", "The point of the second solid that gets or is nearest to that"),
                 READ_ONLY | OUTPUT),
                ("App::PropertyString", "Report", found, QT_TRANSLATE_NOOP("App::Property", "The result in words"), READ_ONLY | OUTPUT)):
            if name not in obj.PropertiesList:
                obj.addProperty(type_, name, group, help_, attributes)

    def linked(self, obj):
        return [each for each in (obj.First, obj.Second) if each]

    def execute(self, obj):
        try:
            starcell = engine.load()
            with tempfile.TemporaryDirectory(prefix="starcell-") as folder:
                depth = runner.run(self._work(obj, starcell, folder), obj.Label)
        except Exception as problem:
            raise RuntimeError("{}: {}".format(obj.Label, problem)) from None
        obj.DepthLower, obj.DepthUpper = depth.lower, depth.upper
        obj.ClearanceLower, obj.ClearanceUpper = depth.separation_lower, depth.separation_upper
        obj.Direction = FreeCAD.Vector(*depth.direction)
        obj.PointOfFirst, obj.PointOfSecond = FreeCAD.Vector(*depth.point_a), FreeCAD.Vector(*depth.point_b)
        obj.Report = in_words(obj, depth.deflection)

    def _work(self, obj, starcell, folder):
        for name in ("First", "Second"):
            if getattr(obj, name) is None:
                raise operands.OperandError(translate("StarCell", "{} is empty: it needs a solid.").format(name))
        frames = operands.frames_between(obj, self.linked(obj))
        if frames != list(obj.Frames):
            obj.Frames = frames
        first, second = (operands.gather(each, obj, folder) for each in (obj.First, obj.Second))
        error = obj.Error.Value or AUTOMATIC_SHARE * min(_longest(first.box), _longest(second.box))

        def work(progress):
            progress(0.0, translate("StarCell", "reading the operands"))
            a, b = (each.solid(starcell, 0.5 * TESSELLATION_SHARE * error) for each in (first, second))
            return starcell.penetration_depth(a, b, error=error, progress=progress)

        return work

    def onDocumentRestored(self, obj):
        self.add_properties(obj)
        if FreeCAD.GuiUp and obj.ViewObject and not obj.ViewObject.Proxy:  # saved by a session without a GUI
            from .depth_view import DepthView

            DepthView(obj.ViewObject)


def label(obj):
    """The measured length in a few characters, for the arrow."""
    overlap = obj.DepthUpper.Value > 0
    low, high = (obj.DepthLower, obj.DepthUpper) if overlap else (obj.ClearanceLower, obj.ClearanceUpper)
    if high.Value - low.Value <= 5e-4 * high.Value:  # one number, to the digits shown
        return "{:.4g} mm".format(high.Value)
    return "{} – {}".format(lengths.show(low, down=True), lengths.show(high))


def in_words(obj, deflection):
    if obj.DepthUpper.Value > 0:
        text = translate("StarCell", "The solids overlap. No move shorter than {} separates them; moving '{}' by {} along ({:.6g}, {:.6g}, {:.6g}) does.").format(
            lengths.show(obj.DepthLower, down=True), obj.Second.Label, lengths.show(obj.DepthUpper), *obj.Direction)
        if not obj.DepthLower.Value:
            text = translate("StarCell", "The solids touch or may overlap: moving '{}' by {} along ({:.6g}, {:.6g}, {:.6g}) separates them, and no least depth is "
                                         "proved.").format(obj.Second.Label, lengths.show(obj.DepthUpper), *obj.Direction)
    else:
        text = translate("StarCell", "The solids are apart, by at least {} and at most {}.").format(
            lengths.show(obj.ClearanceLower, down=True), lengths.show(obj.ClearanceUpper))
    if deflection:
        text += " " + translate("StarCell", "Curved faces were approximated within {}, counted in the bounds.").format(lengths.show(deflection))
    return text


def _longest(box):
    return max(box.XLength, box.YLength, box.ZLength)
