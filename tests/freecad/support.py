"""What the tests in FreeCAD share: a fresh document a test, checks on meshes by FreeCAD's own means, and shape makers."""
import os
import tempfile
import unittest

import FreeCAD
import Mesh  # noqa: F401  (the type of Mesh::FeaturePython lives there)
from FreeCAD import Vector

from starcell_workbench import engine


class DocumentTest(unittest.TestCase):
    """self.doc is empty; closed afterwards, with whatever the test opened beside it."""

    def setUp(self):
        self.doc = FreeCAD.newDocument("Test")
        self.doc.UndoMode = 0

    def tearDown(self):
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)

    def box(self, size=(10, 10, 10), at=(0, 0, 0), name="Box"):
        box = self.doc.addObject("Part::Box", name)
        box.Length, box.Width, box.Height = size
        box.Placement.Base = Vector(*at)
        self.doc.recompute()
        return box

    def sphere(self, radius=6, at=(0, 0, 0), name="Sphere"):
        sphere = self.doc.addObject("Part::Sphere", name)
        sphere.Radius = radius
        sphere.Placement.Base = Vector(*at)
        self.doc.recompute()
        return sphere

    def part(self, members, at=(0, 0, 0), rotation=None, name="Part"):
        part = self.doc.addObject("App::Part", name)
        for member in members:
            part.addObject(member)
        part.Placement = FreeCAD.Placement(Vector(*at), rotation or FreeCAD.Rotation())
        self.doc.recompute()
        return part

    def reopened(self):
        """The document after saving, closing and opening it."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "saved.FCStd")
            self.doc.saveAs(path)
            FreeCAD.closeDocument(self.doc.Name)
            self.doc = FreeCAD.openDocument(path)
        return self.doc

    def assertSolid(self, obj, volume, components=1, genus=(0,), verdicts=("exact",), relative=1e-6):
        """A valid object whose mesh is closed, with this volume and topology, by FreeCAD's and by our own count."""
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertIn(obj.Verdict, verdicts)
        self.assertEqual(obj.Components, components)
        self.assertEqual(list(obj.Genus), list(genus))
        self.assertAlmostEqual(obj.Volume.Value, volume, delta=relative * volume)
        mesh = obj.Mesh
        self.assertEqual(mesh.CountFacets, obj.Triangles)
        self.assertAlmostEqual(mesh.Volume, volume, delta=max(relative, 1e-4) * volume)
        self.assertTrue(mesh.isSolid())
        self.assertFalse(mesh.hasNonManifolds())
        # Exactly, on the float32 coordinates: FreeCAD's own test rounds, and sees crossings between close facets.
        points, facets = mesh.Topology
        engine.load().Polyhedron([tuple(point) for point in points], facets)
        self.assertEqual(mesh.countComponents(), components)
        self.assertEqual(mesh.CountPoints - mesh.CountEdges + mesh.CountFacets, sum(2 - 2 * each for each in genus))

    def assertBox(self, obj, lower, upper, delta=1e-4):
        """The mesh's bounding box in global coordinates."""
        mesh = obj.Mesh.copy()
        mesh.Placement = obj.getGlobalPlacement()
        box = mesh.BoundBox
        for got, wanted in zip((box.XMin, box.YMin, box.ZMin, box.XMax, box.YMax, box.ZMax), (*lower, *upper)):
            self.assertAlmostEqual(got, wanted, delta=delta)


def snapshot(obj):
    """Everything of an operation's object that a failed recompute must leave as it is."""
    points, facets = obj.Mesh.Topology
    numbers = [round(float(getattr(obj, name)), 12) for name in ("ErrorBound", "Volume", "Seconds")]  # files keep 16 digits at most
    names = ("Error", "Contact", "Verdict", "Components", "Genus", "Triangles", "Report", "Certificate")
    return ([tuple(p) for p in points], list(facets), str(obj.Placement), numbers, [str(getattr(obj, name)) for name in names])
