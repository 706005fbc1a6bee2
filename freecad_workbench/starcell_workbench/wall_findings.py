"""What morphology does to a part's walls: which ones are too thin for it, and which parts vanish, fall apart or grow together.

Beside the certificate, not part of it: walls are looked for with rays from points a spacing apart, so what is found is real, but
what is smaller than the spacing may be missed.
"""
from dataclasses import dataclass, field

import FreeCAD

from . import lengths
from .operation_feature import HIDDEN, OUTPUT, READ_ONLY, Highlighted
from .translation import QT_TRANSLATE_NOOP, translate

MOST_SPOKES = 2000  # kept for the highlight
MESH_SHARE = 0.05   # of the thickness looked for: what is curved need not be meshed finer
HIGHLIGHTED = Highlighted("ThinPlaces", "ShowThinPlaces", QT_TRANSLATE_NOOP("StarCell", "Show thin places"), QT_TRANSLATE_NOOP(
    "App::Property", "Draws the walls or gaps that are too thin, over everything else"), spokes="ThinSpokes")

PROPERTIES = (
    ("App::PropertyVectorList", "ThinPlaces", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP(
        "App::Property", "Boxes about the walls or gaps that are too thin, the thinnest first: two corners each")),
    ("App::PropertyFloatList", "Thicknesses", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP(
        "App::Property", "How thin each of these places is where it is thinnest, in mm")),
    ("App::PropertyVectorList", "ThinSpokes", READ_ONLY | OUTPUT | HIDDEN, QT_TRANSLATE_NOOP(
        "App::Property", "Segments across the thin places, from side to side: two ends each")),
)


@dataclass
class WallFindings:
    thickness: float                                # what is thinner was looked for, mm
    gaps: bool                                      # between walls, instead of walls
    boxes: list = field(default_factory=list)       # (lower, upper) of each place
    thicknesses: list = field(default_factory=list)
    spokes: list = field(default_factory=list)      # an array (k, 2, 3) a place
    spacing: float = 0.0
    pieces: list = None                             # for each part of the larger solid, parts of the smaller one; None: not counted
    problem: str = ""                               # why nothing was looked at


def examine(starcell, solid, reach, result, error, progress, counts_parts):
    """How `solid` fares when its surface moves by `reach` (mm; above 0 outward), and `result` is what becomes of it."""
    findings = WallFindings(2 * abs(reach), reach > 0)
    try:
        thin = starcell.thin_places(solid, findings.thickness, gaps=findings.gaps, error=max(error, MESH_SHARE * findings.thickness), progress=progress)
        findings.boxes, findings.thicknesses, findings.spokes, findings.spacing = thin.boxes, thin.thicknesses, thin.spokes, thin.spacing
        if counts_parts:
            larger, smaller = (result.as_solid(), thin.solid) if findings.gaps else (thin.solid, result.as_solid())
            findings.pieces = starcell.count_pieces(larger, smaller)
    except starcell.CancelledError:
        raise
    except (starcell.Error, ValueError) as problem:
        findings.problem = str(problem)
    return findings


def publish(obj, findings):
    """Sets the properties, and adds to the report."""
    obj.ThinPlaces = [FreeCAD.Vector(*corner) for box in findings.boxes for corner in box]
    obj.Thicknesses = [float(each) for each in findings.thicknesses]
    obj.ThinSpokes = [FreeCAD.Vector(*end) for spoke in _some(findings.spokes) for end in spoke]
    lines = in_words(findings)
    if lines:
        obj.Report += "\n" + "\n".join(lines)


def in_words(findings, shown=3):
    if findings.problem:
        return [translate("StarCell", "The walls could not be looked at: {}").format(findings.problem)]
    lines = _parts_in_words(findings)
    if findings.boxes:
        title = translate("StarCell", "Gaps narrower than {}: {} place(s).") if findings.gaps else translate(
            "StarCell", "Walls thinner than {}: {} place(s).")
        lines.append(title.format(lengths.show(findings.thickness), len(findings.boxes)))
        for (lower, upper), thickness in list(zip(findings.boxes, findings.thicknesses))[:shown]:
            lines.append(translate("StarCell", "{} near ({:.6g}, {:.6g}, {:.6g}), over {:.6g} × {:.6g} × {:.6g} mm.").format(
                lengths.show(thickness), *(0.5 * (lower + upper)), *(upper - lower)))
        if len(findings.boxes) > shown:
            lines.append(translate("StarCell", "… and {} more.").format(len(findings.boxes) - shown))
    return lines


def _parts_in_words(findings):
    if findings.pieces is None:
        return []
    if findings.gaps:
        joined = [count for count in findings.pieces if count > 1]
        return [translate("StarCell", "{} parts grow together into {}.").format(sum(joined), len(joined))] if joined else []
    lines, count = [], len(findings.pieces)
    vanished, split = findings.pieces.count(0), [pieces for pieces in findings.pieces if pieces > 1]
    if vanished == count:
        lines.append(translate("StarCell", "Nothing is left: the solid is nowhere as thick as {}.").format(lengths.show(findings.thickness)))
    elif vanished:
        lines.append(translate("StarCell", "{} of {} parts vanish(es).").format(vanished, count))
    if split:
        lines.append(translate("StarCell", "{} of {} parts fall(s) apart, into {} pieces.").format(len(split), count, sum(split)))
    return lines


def _some(spokes):
    """Of all places' spokes, evenly, no more than MOST_SPOKES."""
    step = -(-sum(len(each) for each in spokes) // MOST_SPOKES) or 1
    return [spoke for each in spokes for spoke in each[::step]]
