"""The parametric object that turns a mesh into a Part solid: planar regions become single faces, with straight edges.

The mesh is a result of StarCell or any other closed mesh; the solid follows it. The engine builds the solid in double
precision from the mesh's points and hands it over in a file, bit by bit. The class is the proxy of a Part::FeaturePython, and
its path is stored in documents: rename or move it only with a migration.
All state is in properties. A recompute that fails raises, so that FreeCAD marks the object, and changes none of them.
"""
import importlib
import os
import tempfile

import FreeCAD
import numpy
import Part

from . import engine, mesh_transfer, operands, runner
from .operation_feature import HIDDEN, OUTPUT, READ_ONLY
from .stateless import Stateless
from .translation import QT_TRANSLATE_NOOP, translate

# FreeCAD's meshes hold single precision: points of one plane lie off it by a few roundings of their largest coordinate.
ROUNDING = 2.0 ** -22
MANY_TRIANGLES = 20000  # as faces they keep FreeCAD busy for long


class ToSolid(Stateless):
    command = "StarCell_ToSolid"
    title = QT_TRANSLATE_NOOP("StarCell", "To solid")
    help = QT_TRANSLATE_NOOP("StarCell", "Makes a Part solid of a closed mesh; its planar regions become single faces")

    def __init__(self, obj):
        obj.Proxy = self
        self.add_properties(obj)

    def add_properties(self, obj):
        """Adds what is missing: to a new object all, to one of an older version what came later."""
        for type_, name, help_, attributes in (
                ("App::PropertyLinkGlobal", "Source", QT_TRANSLATE_NOOP("App::Property", "The closed mesh to make a solid of"), 0),
                ("App::PropertyLength", "Tolerance", QT_TRANSLATE_NOOP(
                    "App::Property", "Points this close to a plane are taken to lie on it; 0: the rounding of the mesh's points"), 0),
                ("App::PropertyInteger", "Faces", QT_TRANSLATE_NOOP("App::Property", "Number of faces"), READ_ONLY | OUTPUT),
                ("App::PropertyLinkListGlobal", "Frames", QT_TRANSLATE_NOOP(
                    "App::Property", "Containers whose placement moves the mesh against the solid"), HIDDEN | OUTPUT)):
            if name not in obj.PropertiesList:
                obj.addProperty(type_, name, "Solid", help_, attributes)

    def execute(self, obj):
        try:
            engine.load()
            vertices, triangles, rounding = self._mesh(obj)
            tolerance = obj.Tolerance.Value or rounding
            with tempfile.TemporaryDirectory(prefix="starcell-") as folder:
                path = os.path.join(folder, "solid.bin")
                write_solid = _cad_module().write_solid
                faces = runner.run(lambda progress: write_solid(vertices, triangles, path, tolerance), obj.Label)
                shape = Part.Shape()
                shape.importBinary(path)
        except Exception as problem:
            raise RuntimeError("{}: {}".format(obj.Label, problem)) from None
        shape.Placement = obj.Placement  # assigning a shape overwrites the object's placement
        obj.Shape = shape
        obj.Faces = faces

    def _mesh(self, obj):
        """(vertices, triangles) in the coordinates of the container of `obj`, and how far rounding may have moved a vertex."""
        source = obj.Source
        if source is None:
            raise operands.OperandError(translate("StarCell", "Source is empty: it needs a mesh."))
        leaf, linked, own = operands.resolve(source, "")
        operands.check_valid(leaf)
        if not linked.isDerivedFrom("Mesh::Feature"):
            raise operands.OperandError(translate("StarCell", "'{}' is no mesh: take a result of StarCell or another closed mesh.").format(
                source.Label))
        points, triangles = mesh_transfer.from_mesh(linked.Mesh)
        if not len(triangles):
            raise operands.OperandError(translate("StarCell", "'{}' is an empty mesh: there is nothing to make a solid of.").format(
                source.Label))
        if len(triangles) > MANY_TRIANGLES:
            FreeCAD.Console.PrintWarning(translate("StarCell", "{}: '{}' has {} triangles. Those that are not coplanar become a face "
                                                               "each, and FreeCAD takes long to handle very many faces.").format(
                obj.Label, source.Label, len(triangles)) + "\n")
        frames = operands.frames_between(obj, [source])
        if frames != list(obj.Frames):
            obj.Frames = frames
        matrix = numpy.array((operands.to_frame(source, obj) * own).A).reshape(4, 4)
        moved = points if numpy.array_equal(matrix, numpy.eye(4)) else points @ matrix[:3, :3].T + matrix[:3, 3]
        stretch = max(1.0, numpy.linalg.norm(matrix[:3, :3], 2))
        return moved, triangles, ROUNDING * stretch * numpy.abs(points).max()

    def onDocumentRestored(self, obj):
        self.add_properties(obj)
        if FreeCAD.GuiUp and obj.ViewObject and not obj.ViewObject.Proxy:  # saved by a session without a GUI
            from .solid_view import SolidView

            SolidView(obj.ViewObject)


def _cad_module():
    try:
        return importlib.import_module("starcell_cad")
    except ImportError as problem:
        text = translate("StarCell", "StarCell's CAD module cannot be loaded: {}. Build it anew.").format(problem)
        raise engine.EngineMissing(text) from None
