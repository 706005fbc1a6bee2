"""The history of a shape of Part as one expression: Booleans, compounds, mirror images and links, down to what they are made of.

Nothing of OpenCASCADE's Booleans is used, so they may be wrong, invalid or missing. Only the leaves count: primitives, which
are exact, other shapes, and meshes. Placements are FreeCAD's: operands are taken with their own placement in the coordinates
of the Boolean, whatever container they lie in, and the Boolean's placement moves what comes out.
Read in FreeCAD's main thread; solid() makes no FreeCAD calls, so that it can run in a worker.
"""
from dataclasses import dataclass
from typing import Callable

import FreeCAD

from . import operands
from .operands import OperandError
from .translation import translate


@dataclass
class Step:
    """One Boolean of the history, with the interface of operands.Operand."""
    label: str
    box: FreeCAD.BoundBox
    parts: list
    combine: Callable  # of the engine and the parts' solids

    def solid(self, starcell, error):
        return self.combine(starcell, [part.solid(starcell, error) for part in self.parts])


def read(obj, result, folder):
    """What `obj` is for the object `result`: a Step or an Operand. Shapes are written to files in `folder`. Raises OperandError."""
    return _Reader(folder).read(obj, operands.to_frame(obj, result))


class _Reader:
    def __init__(self, folder):
        self.folder = folder
        self.inside = []  # the Booleans that are being read, outmost first

    def read(self, obj, matrix):
        """`obj` moved by its own placement, then by `matrix`."""
        parts = []
        for path in operands.leaf_paths(obj):
            leaf, linked, own = operands.resolve(obj, path)
            if linked.TypeId in _STEPS:
                parts.append(self._step(linked, matrix * own))
                continue
            operand = operands.Operand(leaf.Label)
            operands.add_leaf(operand, obj, path, matrix, self.folder)
            parts += [operand] if operand.leaves else []
        if not parts:
            raise operands.nothing_solid(obj)
        return parts[0] if len(parts) == 1 else _union(obj, parts)

    def _step(self, obj, matrix):
        if obj in self.inside:
            raise OperandError(translate("StarCell", "'{}' is made from itself: its history runs in a circle.").format(obj.Label))
        self.inside.append(obj)
        step = _STEPS[obj.TypeId](self, obj, matrix)
        self.inside.pop()
        return step

    def _all(self, obj, objects, matrix):
        if not objects or None in objects:
            raise OperandError(translate("StarCell", "'{}' lacks an operand: it cannot be computed.").format(obj.Label))
        return [self.read(each, matrix) for each in objects]

    # What each kind of object does with its operands.

    def fuse(self, obj, matrix):
        return _union(obj, self._all(obj, [obj.Base, obj.Tool], matrix))

    def multi_fuse(self, obj, matrix):
        return _union(obj, self._all(obj, obj.Shapes, matrix))

    def compound(self, obj, matrix):
        return _union(obj, self._all(obj, obj.Links, matrix))

    def cut(self, obj, matrix):
        base, tool = self._all(obj, [obj.Base, obj.Tool], matrix)
        return Step(obj.Label, base.box, [base, tool], lambda starcell, solids: solids[0] - solids[1])

    def common(self, obj, matrix):
        return _intersection(obj, self._all(obj, [obj.Base, obj.Tool], matrix))

    def multi_common(self, obj, matrix):
        if len(obj.Shapes) != 1:
            return _intersection(obj, self._all(obj, obj.Shapes, matrix))
        # FreeCAD then takes the parts of the one operand, which must be a compound.
        _, compound, own = operands.resolve(obj.Shapes[0], "")
        if _STEPS.get(compound.TypeId) is not _Reader.compound:
            raise OperandError(translate("StarCell", "'{}' has one operand only, and '{}' is no compound of several.").format(
                obj.Label, compound.Label))
        return _intersection(obj, self._all(compound, compound.Links, matrix * own))

    def mirroring(self, obj, matrix):
        source, = self._all(obj, [obj.Source], matrix * _mirror(obj.Base, obj.Normal))
        return source


_STEPS = {"Part::Fuse": _Reader.fuse, "Part::MultiFuse": _Reader.multi_fuse, "Part::Cut": _Reader.cut, "Part::Common": _Reader.common,
          "Part::MultiCommon": _Reader.multi_common, "Part::Compound": _Reader.compound, "Part::Compound2": _Reader.compound,
          "Part::Mirroring": _Reader.mirroring}


def _union(obj, parts):
    box = FreeCAD.BoundBox()
    for part in parts:
        box.add(part.box)
    return Step(obj.Label, box, parts, lambda starcell, solids: starcell.union(solids))


def _intersection(obj, parts):
    box = parts[0].box
    for part in parts[1:]:
        common = box.intersected(part.box)
        box = common if common.isValid() else box
    return Step(obj.Label, box, parts, lambda starcell, solids: starcell.intersection(solids))


def _mirror(base, normal):
    """The reflection at the plane through `base`."""
    if normal.Length == 0:
        raise OperandError(translate("StarCell", "The plane of a mirror image has no normal."))
    n = list(FreeCAD.Vector(normal).normalize())
    rows = [[float(i == j) - 2 * n[i] * n[j] for j in range(3)] + [2 * base.dot(FreeCAD.Vector(*n)) * n[i]] for i in range(3)]
    return FreeCAD.Matrix(*rows[0], *rows[1], *rows[2], 0, 0, 0, 1)
