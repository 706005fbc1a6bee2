"""The solid that broken meshes mean: the boundary of what their triangles wind about, taken together."""
import FreeCAD
import numpy

from . import operands
from .operation_feature import OUTPUT, READ_ONLY, Highlighted, OperationFeature, Role
from .translation import QT_TRANSLATE_NOOP, translate

MOST_LISTED = 1000  # places in the properties


class _Triangles:
    """All triangles of an object, as they are: an operand that need not be a solid."""

    def __init__(self, each, obj):
        self.label, self.box = each.Label, FreeCAD.BoundBox()
        self.leaves = [self._leaf(each, path, operands.to_frame(each, obj)) for path in operands.leaf_paths(each)]
        if not sum(len(leaf.triangles) for leaf in self.leaves):
            raise operands.OperandError(translate("StarCell", "'{}' has no triangles.").format(self.label))
        for leaf in self.leaves:
            self.box.add(leaf.box())

    def _leaf(self, each, path, matrix):
        leaf, linked, own = operands.resolve(each, path)
        operands.check_valid(leaf)
        if not operands.is_mesh(leaf):
            raise operands.OperandError(translate("StarCell", "'{}' is no mesh: Repair takes triangles. Of a shape, Mesh > Create mesh from shape "
                                                              "makes some.").format(leaf.Label))
        moved = matrix * own
        soup = operands.MeshLeaf(linked.Mesh, moved)
        if numpy.linalg.det(numpy.reshape(moved.A, (4, 4))[:3, :3]) < 0:  # a mirror image winds the other way
            soup.triangles = soup.triangles[:, ::-1]
        return soup

    def solid(self, starcell, error):
        """(vertices, triangles)."""
        before = numpy.cumsum([0] + [len(leaf.vertices) for leaf in self.leaves[:-1]])
        return (numpy.concatenate([leaf.vertices for leaf in self.leaves]),
                numpy.concatenate([leaf.triangles + first for leaf, first in zip(self.leaves, before)]))


class Repair(OperationFeature):
    command = "StarCell_Repair"
    title = QT_TRANSLATE_NOOP("StarCell", "Repair")
    help = QT_TRANSLATE_NOOP("StarCell", "Makes one sound solid of meshes that cross themselves, overlap, or have turned or missing triangles; says what "
                                         "was wrong, and where")
    roles = (Role("Meshes", QT_TRANSLATE_NOOP("App::Property", "The meshes, in any state; their triangles are taken together")),)
    outputs = (
        ("App::PropertyStringList", "Flaws", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP("App::Property", "What was wrong with the triangles, and where")),
        ("App::PropertyVectorList", "FlawPlaces", READ_ONLY | OUTPUT, QT_TRANSLATE_NOOP("App::Property", "Boxes about these places: two corners each")))
    highlighted = Highlighted("FlawPlaces", "ShowFlaws", QT_TRANSLATE_NOOP("StarCell", "Show what was wrong"), QT_TRANSLATE_NOOP(
        "App::Property", "Draws boxes about what was wrong with the triangles, over everything else"))

    def gather(self, each, obj, chosen, folder):
        return _Triangles(each, obj)

    def compute(self, starcell, solids, values, options):
        before = numpy.cumsum([0] + [len(vertices) for vertices, _ in solids["Meshes"][:-1]])
        return starcell.repair(numpy.concatenate([vertices for vertices, _ in solids["Meshes"]]),
                               numpy.concatenate([triangles + first for (_, triangles), first in zip(solids["Meshes"], before)]), **options)

    def examine(self, starcell, solids, values, result, options):
        return result.findings

    def published(self, obj, result, findings):
        listed = findings[:MOST_LISTED]
        obj.Flaws = [_in_words(*each) for each in listed]
        obj.FlawPlaces = [FreeCAD.Vector(*corner) for _, box in listed for corner in box]
        obj.Report += "\n" + "\n".join(_summary(findings, obj.Flaws))


def _in_words(what, box):
    lower, upper = (numpy.asarray(corner) for corner in box)
    return translate("StarCell", "{} near ({:.6g}, {:.6g}, {:.6g}), over {:.6g} × {:.6g} × {:.6g} mm").format(
        translate("StarCell", what), *(0.5 * (lower + upper)), *(upper - lower))


def _summary(findings, flaws, shown=3):
    if not findings:
        return [translate("StarCell", "The triangles close up, one by one, in sound pieces; nothing had to be mended.")]
    counts = {}
    for what, _ in findings:
        counts[what] = counts.get(what, 0) + 1
    lines = [translate("StarCell", "Wrong with the triangles: {}.").format(
        ", ".join("{} ({})".format(translate("StarCell", what), count) for what, count in sorted(counts.items(), key=lambda item: -item[1])))]
    lines += [flaw + "." for flaw in flaws[:shown]]
    if len(findings) > shown:
        lines.append(translate("StarCell", "… and {} more.").format(len(findings) - shown))
    return lines
