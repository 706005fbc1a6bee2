"""What a plane z = height has of an object: polygons with holes, curved edges as chords within a deflection.

A sketch or a flat face in that plane is taken as it is; of solids and meshes the section. Coordinates are those of the result's frame.
"""
import FreeCAD
import Mesh
import numpy
import Part

from . import operands
from .translation import translate

DEFLECTION_SHARE = 5e-3   # of the section's longest side
FLAT = 1e-7               # mm: what lies this near to the plane lies in it


class Section:
    """label, box, and `polygons`: a list of [outer ring, hole, ...], each (n, 2). Gathered in FreeCAD's main thread."""

    def __init__(self, each, obj, height):
        self.label, self.box, self.polygons, self.deflection = each.Label, FreeCAD.BoundBox(), [], 0.0
        faces = []
        for path in operands.leaf_paths(each):
            faces += _faces(each, path, operands.to_frame(each, obj), height)
        if not faces:
            raise operands.OperandError(translate("StarCell", "'{}' has nothing in the plane z = {:.6g} mm: neither a section nor a closed outline.").format(self.label, height))
        longest = max(max(face.BoundBox.XLength, face.BoundBox.YLength) for face in faces)
        for face in faces:
            self.box.add(face.BoundBox)
            rings = [self._ring(wire, DEFLECTION_SHARE * longest) for wire in face.Wires]
            outer = next(k for k, wire in enumerate(face.Wires) if wire.isSame(face.OuterWire))
            self.polygons.append([rings[outer]] + rings[:outer] + rings[outer + 1:])

    def _ring(self, wire, deflection):
        """Chords of curves leave them by at most the deflection."""
        points, end, edges = [], None, wire.OrderedEdges
        for edge in edges:
            if isinstance(edge.Curve, (Part.Line, Part.LineSegment)):
                chain = [vertex.Point for vertex in edge.Vertexes]
            else:
                chain, self.deflection = edge.discretize(Deflection=deflection), deflection
            # Edges run either way: from where the one before ended; the first one to where the second one is.
            if end is None and len(edges) > 1:
                far = [min((vertex.Point - p).Length for vertex in edges[1].Vertexes) for p in (chain[0], chain[-1])]
                chain = chain[::-1] if far[0] < far[1] else chain
            elif end is not None and (chain[-1] - end).Length < (chain[0] - end).Length:
                chain = chain[::-1]
            points += chain[:-1]
            end = chain[-1]
        return numpy.array([(p.x, p.y) for p in points])

    def solid(self, starcell, error):
        return self


def common_height(objects, obj):
    """z in the middle of what all of them have in common; if that is nothing, the middle of the first."""
    ranges = []
    for each in objects:
        box = FreeCAD.BoundBox()
        for path in operands.leaf_paths(each):
            box.add(_in_frame(each, path, operands.to_frame(each, obj)).BoundBox)
        if box.isValid():
            ranges.append((box.ZMin, box.ZMax))
    if not ranges:
        return 0.0
    low, high = max(z for z, _ in ranges), min(z for _, z in ranges)
    return 0.5 * (low + high) if low <= high + FLAT else 0.5 * sum(ranges[0])


def _in_frame(each, path, matrix):
    """The mesh or shape at a path, moved."""
    leaf, linked, own = operands.resolve(each, path)
    operands.check_valid(leaf)
    if operands.is_mesh(leaf):
        mesh = linked.Mesh.copy()
        mesh.Placement = FreeCAD.Placement()
        mesh.transform(matrix * own)
        return mesh
    shape = Part.getShape(each, path).copy()
    if shape.isNull() or not operands.is_rigid(matrix):
        return shape if shape.isNull() else shape.transformGeometry(matrix)
    shape.Placement = FreeCAD.Placement(matrix) * shape.Placement   # lines stay lines
    return shape


def _faces(each, path, matrix, height):
    """Flat faces at the height; none for what does not reach it."""
    found = _in_frame(each, path, matrix)
    if isinstance(found, Mesh.Mesh):
        loops = found.crossSections([(FreeCAD.Vector(0, 0, height), FreeCAD.Vector(0, 0, 1))], FLAT)[0]
        wires = [Part.makePolygon(loop if loop[0] == loop[-1] else loop + loop[:1]) for loop in loops if len(loop) > 2]
    elif found.isNull():
        return []
    else:
        flat = max(abs(found.BoundBox.ZMin - height), abs(found.BoundBox.ZMax - height)) <= FLAT
        if flat and found.Faces:
            return found.Faces
        wires = [wire for wire in found.Wires if wire.isClosed()] if flat else found.slice(FreeCAD.Vector(0, 0, 1), height) if found.Solids else []
    return Part.makeFace(wires, "Part::FaceMakerBullseye").Faces if wires else []
