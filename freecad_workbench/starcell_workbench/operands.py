"""FreeCAD's objects as operands: what each one holds, and how to hand it to the engine.

Understands Part and PartDesign objects, bodies, meshes (StarCell's own results among them), App::Part and groups (the
union of their visible solids), links and link arrays. Part's primitives are handed over exactly. Everything comes out in
the coordinates of one frame, the container of the result, so placements of nested containers count and a result inside a
moved container stays where it belongs.
An operand is gathered in FreeCAD's main thread; its solid() makes no FreeCAD calls, so that it can run in a worker.
"""
import os
import re
import tempfile
from dataclasses import dataclass, field

import FreeCAD
import numpy
import Part

from . import mesh_transfer, primitives
from .translation import translate


class OperandError(RuntimeError):
    """An object cannot be an operand; the message names it and says why."""


@dataclass
class Operand:
    """One operand of an operation: a name, a box that contains it, and the solids whose union it is."""
    label: str
    box: FreeCAD.BoundBox = field(default_factory=FreeCAD.BoundBox)
    leaves: list = field(default_factory=list)

    def solid(self, starcell, error):
        """The engine's solid; curved CAD faces may be approximated to `error` (mm)."""
        try:
            solids = [leaf.solid(starcell, error) for leaf in self.leaves]
        except (starcell.Error, ValueError) as problem:
            raise OperandError(translate("StarCell", "'{}' cannot be used: {}").format(self.label, problem)) from None
        return solids[0] if len(solids) == 1 else starcell.union(solids)


class _ShapeLeaf:
    """A CAD shape, passed on bit by bit through a file of OpenCASCADE's binary format. The engine reports it by the file's name."""

    def __init__(self, shape, matrix, label, folder, faces=False):
        self.matrix, self.faces = _array(matrix), faces
        own = tempfile.mkdtemp(dir=folder)
        name = re.sub(r"[^\w .()+-]", "_", label)[:60].strip(" .")
        self.path = os.path.join(own, (name or "operand") + ".bin")
        shape.exportBinary(self.path)

    def solid(self, starcell, error):
        stretch = numpy.linalg.norm(self.matrix[:3, :3], 2)
        return starcell.from_brep(self.path, error / stretch, recognise=not self.faces).transformed(self.matrix)


class _PrimitiveLeaf:
    """A primitive of Part, exact: see primitives.py."""

    def __init__(self, recipe, matrix):
        self.recipe, self.matrix = recipe, _array(matrix)

    def solid(self, starcell, error):
        return self.recipe(starcell).transformed(self.matrix)


class MeshLeaf:
    """A mesh: FreeCAD's float32 points, moved in double precision."""

    def __init__(self, mesh, matrix):
        points, self.triangles = mesh_transfer.from_mesh(mesh)
        map_ = _array(matrix)
        self.vertices = points @ map_[:3, :3].T + map_[:3, 3]

    def box(self):
        return FreeCAD.BoundBox(*self.vertices.min(axis=0), *self.vertices.max(axis=0))

    def solid(self, starcell, error):
        return starcell.Polyhedron(self.vertices, self.triangles)


def gather(obj, result, folder, faces=False):
    """The Operand that `obj` is for the object `result`; shapes are written to files in `folder`. Raises OperandError.

    `faces`: as polyhedra that know which CAD face their triangles came from, primitives too.
    """
    operand = Operand(obj.Label)
    for path in leaf_paths(obj):
        add_leaf(operand, obj, path, to_frame(obj, result), folder, faces)
    if not operand.leaves:
        raise nothing_solid(obj)
    return operand


def nothing_solid(obj):
    return OperandError(translate("StarCell", "'{}' has no solid: an operand is a solid of Part or PartDesign, a closed mesh, "
                                              "or a container or link of such.").format(obj.Label))


def to_frame(obj, result):
    """The matrix from the coordinates of the container of `obj` to those of the container of `result`."""
    return (frame(result).inverse() * frame(obj)).toMatrix()


def frame(obj):
    """The placement of the container that `obj` lies in."""
    container = obj.getParentGeoFeatureGroup()
    return container.getGlobalPlacement() if container else FreeCAD.Placement()


def containers(obj):
    """The containers around `obj`, inmost first: their placements move it."""
    around = []
    container = obj.getParentGeoFeatureGroup()
    while container:
        around.append(container)
        container = container.getParentGeoFeatureGroup()
    return around


def frames_between(obj, linked):
    """The containers whose placement moves one of the linked objects against `obj`: it has to be recomputed when they move."""
    own = containers(obj)
    return list({around.Name: around for each in linked for around in containers(each) if around not in own}.values())


def leaf_paths(obj):
    """Sub-object paths of everything visible under `obj` that holds a shape or a mesh: obj itself, if it does."""
    return _leaf_paths(obj, set(), "")


def _leaf_paths(obj, seen, path):
    leaf, matrix, _ = obj.getSubObject(path, retType=2)
    if is_mesh(leaf) or _has_shape(leaf):
        # A member of a group inside a container is listed under both.
        key = (leaf.Document.Name, leaf.Name, tuple(matrix.A))
        if key not in seen:
            seen.add(key)
            yield path
        return
    check_valid(leaf)
    for name in leaf.getSubObjects():
        if _is_visible(leaf, name):
            yield from _leaf_paths(obj, seen, path + name)


def check_valid(obj):
    if not (obj.isValid() and obj.getLinkedObject(True).isValid()):
        raise OperandError(translate("StarCell", "'{}' has an error of its own; mend it first.").format(obj.Label))


def resolve(obj, path):
    """(leaf, linked, matrix): the object at a path, what it links to in the end, and the matrix from the coordinates of that one's
    shape or mesh, without its own placement, to those of the container of `obj`."""
    leaf, matrix, _ = obj.getSubObject(path, retType=2)
    linked, beyond = leaf.getLinkedObject(True, FreeCAD.Matrix(), False)  # what a link adds to its own placement
    return leaf, linked, matrix * beyond


def add_leaf(operand, obj, path, matrix, folder, faces=False):
    """Adds the shape or mesh at a path, moved by `matrix`. Raises OperandError if there is no solid, unless it lies in a container."""
    leaf, linked, own = resolve(obj, path)
    check_valid(leaf)
    if is_mesh(leaf):
        mesh = linked.Mesh
        if mesh.CountFacets == 0:
            raise OperandError(translate("StarCell", "'{}' is an empty mesh.").format(leaf.Label))
        operand.leaves.append(MeshLeaf(mesh, matrix * own))
        operand.box.add(operand.leaves[-1].box())
        return
    shape = Part.getShape(obj, path)
    if shape.isNull() or not shape.Solids:
        if path:
            return  # sketches, datums and the like that live in a container
        raise OperandError(_no_solid(leaf, shape))
    # OpenCASCADE's placements turn and shift, no more: mirror images and stretches are left to the engine.
    rest = FreeCAD.Matrix() if is_rigid(matrix) else matrix
    if is_rigid(matrix):
        shape.Placement = FreeCAD.Placement(matrix) * shape.Placement
    recipe = None if faces else primitives.recipe(linked)
    operand.leaves.append(_PrimitiveLeaf(recipe, matrix * own) if recipe else _ShapeLeaf(shape, rest, leaf.Label, folder, faces))
    operand.box.add(shape.BoundBox.transformed(rest))


def is_rigid(matrix):
    linear = _array(matrix)[:3, :3]
    return numpy.linalg.det(linear) > 0 and numpy.allclose(linear @ linear.T, numpy.eye(3), atol=1e-9)


def _array(matrix):
    return numpy.array(matrix.A).reshape(4, 4)


def _no_solid(leaf, shape):
    if shape.isNull():
        return translate("StarCell", "'{}' has no solid: its shape is empty.").format(leaf.Label)
    if shape.Shells:
        return translate("StarCell", "'{}' is a surface, not a solid: make a solid of it first (Part > Create shape from mesh, "
                                     "Convert to solid).").format(leaf.Label)
    return translate("StarCell", "'{}' has no solid: it is a {}.").format(leaf.Label, shape.ShapeType.lower())


def is_mesh(obj):
    return obj.getLinkedObject(True).isDerivedFrom("Mesh::Feature")


def _has_shape(obj):
    return obj.getLinkedObject(True).isDerivedFrom("Part::Feature")


def _is_visible(parent, name):
    answer = parent.isElementVisible(name.rstrip("."))
    if answer >= 0:
        return bool(answer)
    return parent.getSubObject(name, retType=1).Visibility
