"""Simplified meshes and solids of the document."""
import math

import Mesh
from support import DocumentTest

import starcell_workbench as scw


class Simplified(DocumentTest):
    def scan(self, radius=10.0):
        """A finely meshed ball, as from a scanner."""
        obj = self.doc.addObject("Mesh::Feature", "Scan")
        obj.Mesh = Mesh.createSphere(radius, 80)
        return obj

    def test_a_mesh_gets_fewer_triangles_within_the_error(self):
        scan = self.scan()
        obj = scw.make_simplified(scan, error="0.2 mm")
        self.assertSolid(obj, 4 / 3 * math.pi * 1000, relative=0.06)
        self.assertEqual(obj.TrianglesBefore, scan.Mesh.CountFacets)
        self.assertLess(obj.Triangles, scan.Mesh.CountFacets / 10)
        self.assertLessEqual(obj.ErrorBound.Value, 0.2)
        for point in obj.Mesh.Topology[0]:
            self.assertAlmostEqual(point.Length, 10, delta=0.2)

    def test_a_smaller_error_leaves_more(self):
        obj = scw.make_simplified(self.scan(), error="0.4 mm")
        few = obj.Triangles
        obj.Error = 0.05
        self.doc.recompute()
        self.assertGreater(obj.Triangles, few)

    def test_of_a_union_with_many_triangles_on_its_sides(self):
        made = scw.make_union([self.box((10, 8, 6)), self.box((10, 8, 6), (10, 0, 0))])
        obj = scw.make_simplified(made, error="0.1 mm")
        self.assertSolid(obj, 20 * 8 * 6)
        self.assertEqual(obj.Triangles, 12)

    def test_curved_solids_and_placements(self):
        obj = scw.make_simplified(self.sphere(5, (20, 0, 0)), error="0.3 mm")
        self.assertSolid(obj, 4 / 3 * math.pi * 125, relative=0.15)
        self.assertBox(obj, (15, -5, -5), (25, 5, 5), delta=0.3)

    def test_survives_saving(self):
        before = scw.make_simplified(self.scan(), error="0.2 mm", label="Simple").TrianglesBefore
        doc = self.reopened()
        obj = doc.getObjectsByLabel("Simple")[0]
        self.assertEqual(obj.TrianglesBefore, before)
        doc.Scan.touch()
        doc.recompute()
        self.assertTrue(obj.isValid())

    def test_refuses_open_meshes(self):
        scan = self.scan()
        mesh = scan.Mesh.copy()
        mesh.removeFacets([0])
        scan.Mesh = mesh
        obj = scw.make_simplified(scan)
        self.assertFalse(obj.isValid())
