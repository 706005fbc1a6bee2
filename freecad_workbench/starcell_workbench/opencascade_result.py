"""What OpenCASCADE made of a history, measured for comparison: volume, and components and handles of its boundary.

A shell's Euler characteristic is V - E + sum over its faces of (2 - rims): vertices and edges are counted once however many
faces share them, edges without length (a sphere's poles) not at all, and a face with k rims is a sphere with k holes. A rim is
a wire, or wires that touch in a vertex. Points and lines that OpenCASCADE leaves within a face bound nothing, and do not count.
The volume comes from quadrature of low order: of a plain ellipsoid it is off by 0.04 %, of right results of a few curved faces
by up to 1 % (found among random trees: tests/long/freecad_trees.py).
"""
from dataclasses import dataclass, field

import Part

from . import report
from .translation import translate


@dataclass
class Measured:
    """`flaw` says why there is nothing to compare with; the rest is then whatever could be measured."""
    volume: float = 0.0
    rounding: float = 0.0      # how far the volume may be off
    components: int = 0
    genus: list = field(default_factory=list)  # of each shell, the most first; none if there is a flaw
    flaw: str = ""


def measure(obj):
    """The Measured of what FreeCAD has for `obj`. Never raises: OpenCASCADE may."""
    measured = Measured()
    try:
        shape = Part.getShape(obj)
        measured.flaw = _flaw(obj, shape)
        if not shape.isNull():
            measured.volume = shape.Volume
            measured.rounding = abs(shape.Volume) * (1e-6 if all(_is_planar(face) for face in shape.Faces) else 1e-2)
            measured.components = len(shape.Shells)
        if not measured.flaw:
            measured.genus = sorted((_genus(shell) for shell in shape.Shells), reverse=True)
    except Exception as problem:
        measured.flaw = translate("StarCell", "cannot be measured ({})").format(problem)
    return measured


def differences(measured, certificate, volume, tolerance):
    """What of it differs from a result of StarCell whose volume is known to `tolerance`: names of quantities."""
    names = []
    if abs(measured.volume - volume) > tolerance + measured.rounding:
        names.append(translate("StarCell", "volume"))
    if measured.components != certificate.components:
        names.append(translate("StarCell", "components"))
    elif measured.genus != sorted(certificate.genus, reverse=True):
        names.append(translate("StarCell", "genus"))
    return names


def in_words(measured, differing):
    if measured.flaw:
        text = translate("StarCell", "OpenCASCADE's result {}").format(measured.flaw)
        return text + (translate("StarCell", "; volume {:.6g} mm³.").format(measured.volume) if measured.volume else ".")
    text = translate("StarCell", "OpenCASCADE's result: volume {:.6g} mm³, {} components, genus {}").format(
        measured.volume, measured.components, report.genus(measured.genus)) if measured.components else translate(
        "StarCell", "OpenCASCADE's result: empty")
    if differing:
        return translate("StarCell", "{}: differs in {}.").format(text, translate("StarCell", " and ").join(differing))
    return translate("StarCell", "{}: agrees.").format(text)


def _flaw(obj, shape):
    if shape.isNull():
        return translate("StarCell", "is missing: its shape is null")
    failed = [each.Label for each in [obj] + obj.OutListRecursive if not each.isValid()]
    if failed:
        return translate("StarCell", "is out of date: '{}' failed").format(failed[0])
    if not shape.isValid():
        return translate("StarCell", "is invalid")
    if not all(shell.isClosed() for shell in shape.Shells):
        return translate("StarCell", "is not closed")
    if any(_characteristic(shell) > 2 or _characteristic(shell) % 2 for shell in shape.Shells):
        return translate("StarCell", "crosses or touches itself: it has a shell that is no surface")
    return ""


def _is_planar(face):
    return isinstance(face.Surface, Part.Plane)


def _genus(shell):
    return (2 - _characteristic(shell)) // 2


def _characteristic(shell):
    vertices, edges, faces = _Numbered(), _Numbered(), 0
    for face in shell.Faces:
        rims = []  # sets of vertices: the connected pieces of the boundary
        for wire in face.Wires:
            bounding = [edge for edge in wire.Edges if edge.Orientation in _BOUNDING]
            rim = {vertices[vertex] for edge in bounding for vertex in edge.Vertexes if vertex.Orientation in _BOUNDING}
            for edge in bounding:
                if not edge.Degenerated:
                    edges[edge]
            touched = [each for each in rims if each & rim]
            rims = [each for each in rims if not each & rim] + ([rim.union(*touched)] if rim else [])
        faces += 2 - len(rims)
    return len(vertices) - len(edges) + faces


_BOUNDING = ("Forward", "Reversed")  # others are scratches within a face


class _Numbered:
    """Numbers for shapes that are the same but for their orientation."""

    def __init__(self):
        self.known, self.count = {}, 0

    def __getitem__(self, shape):
        alike = self.known.setdefault(shape.hashCode(), [])
        for other, number in alike:
            if other.isSame(shape):
                return number
        alike.append((shape, self.count))
        self.count += 1
        return self.count - 1

    def __len__(self):
        return self.count
