"""Meshes in and out of FreeCAD, as arrays: exact in float32, and quick."""
import io
from itertools import chain

import FreeCAD
import Mesh
import numpy

_HEADER = """ply
format binary_little_endian 1.0
element vertex {}
property float x
property float y
property float z
element face {}
property list uchar int vertex_indices
end_header
"""
_FACET = numpy.dtype([("count", "u1"), ("corners", "<i4", 3)])


def to_mesh(vertices, triangles):
    """vertices (n, 3), triangles (m, 3) as a Mesh.Mesh, through a binary PLY in memory; points are rounded to float32."""
    mesh = Mesh.Mesh()
    if len(triangles):
        facets = numpy.empty(len(triangles), dtype=_FACET)
        facets["count"] = 3
        facets["corners"] = triangles
        header = _HEADER.format(len(vertices), len(triangles)).encode()
        mesh.read(Stream=io.BytesIO(header + numpy.asarray(vertices, dtype="<f4").tobytes() + facets.tobytes()), Format="PLY")
    if mesh.CountFacets != len(triangles) or mesh.CountPoints != len(vertices):
        raise RuntimeError("FreeCAD took {} of {} triangles.".format(mesh.CountFacets, len(triangles)))
    return mesh


def from_mesh(mesh):
    """(vertices (n, 3) float64, triangles (m, 3) int32) of a Mesh.Mesh, in its own coordinates: its placement is left out."""
    still = mesh.copy()
    still.Placement = FreeCAD.Placement()
    points, facets = still.Topology
    vertices = numpy.fromiter(chain.from_iterable(points), float, 3 * len(points)).reshape(-1, 3)
    return vertices, numpy.fromiter(chain.from_iterable(facets), numpy.int32, 3 * len(facets)).reshape(-1, 3)


def area(vertices, triangles):
    """Area (mm^2) of a mesh."""
    a, b, c = numpy.moveaxis(numpy.asarray(vertices)[triangles], 1, 0)
    return float(numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2)


def volume(vertices, triangles):
    """Volume (mm^3) of a closed mesh, in double precision: signed tetrahedra over a point amid it."""
    if not len(triangles):
        return 0.0
    a, b, c = numpy.moveaxis((numpy.asarray(vertices) - numpy.mean(vertices, axis=0))[triangles], 1, 0)
    return float(numpy.einsum("ij,ij->", a, numpy.cross(b, c)) / 6)
