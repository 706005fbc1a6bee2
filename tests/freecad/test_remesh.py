"""Remeshed meshes and solids of the document."""
from support import DocumentTest

import starcell_workbench as scw


class Remeshed(DocumentTest):
    def test_a_part_gets_well_shaped_triangles(self):
        made = scw.make_cut(self.box((20, 16, 6)), self.box((4, 4, 10), (8, 6, -2)), error="0.1 mm")
        obj = scw.make_remeshed(made, edge_length="2 mm", error="0.1 mm")
        self.assertSolid(obj, 20 * 16 * 6 - 4 * 4 * 6, genus=[1])
        self.assertEqual(obj.TrianglesBefore, made.Triangles)
        self.assertGreater(obj.LeastAngle.Value, 25)
        self.assertLess(obj.AspectRatio, obj.AspectRatioBefore)
        corners = {tuple(round(x, 5) for x in point.Vector) for point in obj.Mesh.Points}
        for x in (8, 12):
            for y in (6, 10):
                for z in (0, 6):
                    self.assertIn((x, y, z), corners)

    def test_shorter_edges_make_more_triangles(self):
        obj = scw.make_remeshed(self.sphere(5), edge_length="2 mm", error="0.3 mm")
        few = obj.Triangles
        obj.EdgeLength = 1.0
        self.doc.recompute()
        self.assertGreater(obj.Triangles, 2 * few)

    def test_a_length_of_none_follows_the_error(self):
        obj = scw.make_remeshed(self.box((10, 8, 6)), error="0.4 mm")
        self.assertEqual(obj.EdgeLength.Value, 0)
        few = obj.Triangles
        obj.Error = 0.2
        self.doc.recompute()
        self.assertGreater(obj.Triangles, 2 * few)
        self.assertSolid(obj, 10 * 8 * 6)

    def test_survives_saving(self):
        scw.make_remeshed(self.box((10, 8, 6)), edge_length=3.0, label="Even")
        doc = self.reopened()
        obj = doc.getObjectsByLabel("Even")[0]
        self.assertEqual(obj.EdgeLength.Value, 3)
        doc.recompute(None, True)
        self.assertTrue(obj.isValid())

    def test_wrong_lengths_are_named(self):
        with self.assertRaisesRegex(ValueError, "edge_length"):
            scw.make_remeshed(self.box((10, 8, 6)), edge_length="-1 mm")
        for angle in ("40 mm", "wide", "", 0, 180, float("nan")):
            with self.assertRaisesRegex(ValueError, "feature_angle"):
                scw.make_remeshed(self.box((10, 8, 6)), feature_angle=angle)
        self.assertEqual(scw.make_remeshed(self.box((10, 8, 6)), feature_angle="60 deg").FeatureAngle.Value, 60)
