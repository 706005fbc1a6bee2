"""Broken meshes of the document, made into solids."""
import FreeCAD
import Mesh
import MeshPart
from support import DocumentTest

import starcell_workbench as scw


class Repaired(DocumentTest):
    def mesh(self, *shapes, without=(), turned=(), name="Scan"):
        """The triangles of shapes in one mesh; some, by number, left out or turned."""
        triangles = [list(facet.Points) for shape in shapes for facet in MeshPart.meshFromShape(Shape=shape, LinearDeflection=0.1).Facets]
        for number in turned:
            triangles[number].reverse()
        obj = self.doc.addObject("Mesh::Feature", name)
        obj.Mesh = Mesh.Mesh([triangle for number, triangle in enumerate(triangles) if number not in without])
        return obj

    def test_two_parts_in_one_file_become_their_union(self):
        scan = self.mesh(self.box().Shape, self.box(at=(5, 5, 5)).Shape)
        obj = scw.make_repaired(scan, error="0.1 mm")
        self.assertSolid(obj, 2 * 1000 - 125)
        self.assertEqual((obj.Flaws, obj.FlawPlaces), ([], []))
        self.assertFalse(scan.Visibility)

    def test_several_meshes_are_taken_together(self):
        obj = scw.make_repaired([self.mesh(self.box().Shape), self.mesh(self.box(at=(0, 0, 10)).Shape)], error=0.1)
        self.assertSolid(obj, 2000, verdicts=("exact", "contact"))

    def test_says_what_was_wrong_and_where(self):
        scan = self.mesh(self.box().Shape, without=(3,), turned=(7,))
        obj = scw.make_repaired(scan, error=2)
        self.assertSolid(obj, 1000)
        self.assertEqual(sorted(flaw.split(" near")[0] for flaw in obj.Flaws), ["hole", "turned triangle"])
        self.assertEqual(len(obj.FlawPlaces), 4)
        self.assertIn("turned triangle (1)", obj.Report)

    def test_a_hole_too_wide_is_refused_and_the_document_stays(self):
        scan = self.mesh(self.box().Shape, without=(3,))
        obj = scw.make_repaired(scan, error=0.1)
        self.assertFalse(obj.isValid())
        self.assertIn("wider than 1", obj.getStatusString())
        self.assertTrue(scan.Visibility)
        obj.Error = 2
        self.doc.recompute()
        self.assertSolid(obj, 1000)

    def test_placements_and_mirror_images_count(self):
        scan = self.mesh(self.box().Shape)
        scan.Placement.Base = FreeCAD.Vector(100, 0, 0)
        link = self.doc.addObject("App::Link", "Mirrored")
        link.LinkedObject = scan
        link.ScaleVector = FreeCAD.Vector(-1, 1, 1)
        self.doc.recompute()
        obj = scw.make_repaired(link, error=0.1)
        self.assertSolid(obj, 1000)
        self.assertEqual(obj.Flaws, [])

    def test_shapes_are_refused_by_name(self):
        obj = scw.make_repaired(self.box(name="Plate"))
        self.assertFalse(obj.isValid())
        self.assertIn("'Plate' is no mesh", obj.getStatusString())
        with self.assertRaises(ValueError):
            scw.make_repaired([])

    def test_survives_saving(self):
        scw.make_repaired(self.mesh(self.box().Shape, turned=(2,)), error=0.5, label="Whole")
        doc = self.reopened()
        obj = doc.getObjectsByLabel("Whole")[0]
        self.assertEqual(len(obj.Flaws), 1)
        doc.recompute(None, True)
        self.assertSolid(obj, 1000)
