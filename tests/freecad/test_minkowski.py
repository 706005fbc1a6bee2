"""Minkowski sums, morphology with a solid, and penetration depth of document objects: closed forms, placements, refusals."""
import math

import FreeCAD
from support import DocumentTest

import starcell_workbench as scw


class MinkowskiSums(DocumentTest):
    def plate(self):
        """20 x 20 x 4 with a square hole of 8."""
        return scw.make_cut(self.box((20, 20, 4), name="Plate"), self.box((8, 8, 10), (6, 6, -3), "Hole"))

    def test_of_boxes_is_a_box_where_both_stand(self):
        obj = scw.make_minkowski_sum(self.box((10, 8, 6)), self.box((1, 2, 3), (100, 0, 0)))
        self.assertSolid(obj, 11 * 10 * 9)
        self.assertBox(obj, (100, 0, 0), (111, 10, 9))

    def test_a_hole_closes_when_the_element_grows_past_it(self):
        plate, element = self.plate(), self.box((3, 3, 3), name="Element")
        obj = scw.make_minkowski_sum(plate, element)
        self.assertSolid(obj, (23 * 23 - 5 * 5) * 7, genus=[1])
        element.Length = element.Width = 8.001
        self.doc.recompute()
        self.assertSolid(obj, 28.001 ** 2 * 7)
        element.Length = element.Width = 7.999
        self.doc.recompute()
        self.assertSolid(obj, (27.999 ** 2 - 0.001 ** 2) * 7, genus=[1])

    def test_containers_count(self):
        element = self.box((1, 1, 1), (5, 0, 0), "Element")
        holder = self.part([element], at=(0, 0, 7))
        obj = scw.make_minkowski_sum(self.box((10, 10, 10)), element)
        self.assertBox(obj, (5, 0, 7), (16, 11, 18))
        holder.Placement.Base = (0, 0, 9)
        self.doc.recompute()
        self.assertBox(obj, (5, 0, 9), (16, 11, 20))

    def test_of_a_ball_is_an_offset(self):
        obj = scw.make_minkowski_sum(self.box((10, 8, 6)), self.sphere(1, (3, 0, 0)), error=0.1)
        self.assertSolid(obj, 480 + 2 * (80 + 48 + 60) + math.pi * 24 + 4 * math.pi / 3, relative=0.01)
        self.assertBox(obj, (2, -1, -1), (14, 9, 7), delta=0.1)

    def test_morphology_with_a_solid(self):
        plate, cube = self.plate(), self.box((2, 2, 2), (-1, -1, -1), "Cube")
        self.assertSolid(scw.make_erode(plate, cube), (18 * 18 - 10 * 10) * 2, genus=[1])
        self.assertSolid(scw.make_opening(plate, cube), (20 * 20 - 8 * 8) * 4, genus=[1], relative=1e-3)
        cube.Length, cube.Width, cube.Placement.Base = 9, 9, (0, 0, 0)
        self.doc.recompute()
        self.assertSolid(scw.make_closing(plate, cube), 20 * 20 * 4, relative=1e-3)

    def test_the_element_can_be_taken_away_and_the_radius_counts_again(self):
        obj = scw.make_erode(self.box((10, 8, 6)), self.box((1, 1, 1), name="Element"))
        self.assertSolid(obj, 9 * 7 * 5)
        obj.Element, obj.Radius = None, 1
        self.doc.recompute()
        self.assertSolid(obj, 8 * 6 * 4)

    def test_survives_saving(self):
        scw.make_minkowski_sum(self.box((10, 8, 6)), self.box((1, 1, 1), name="Element"), label="Swept")
        doc = self.reopened()
        obj = doc.getObjectsByLabel("Swept")[0]
        doc.Element.Length = 2
        doc.recompute()
        self.assertSolid(obj, 12 * 9 * 7)

    def test_refusals_leave_the_document_as_it_was(self):
        box = self.box()
        before = len(self.doc.Objects)
        self.assertRaises(TypeError, scw.make_minkowski_sum, box, None)
        self.assertRaises(TypeError, scw.make_minkowski_sum, box, "Box")
        self.assertRaises(TypeError, scw.make_erode, box, [box])
        self.assertEqual(len(self.doc.Objects), before)

    def test_a_missing_element_is_named(self):
        obj = scw.make_minkowski_sum(self.box(), self.box((1, 1, 1), name="Element"))
        triangles = obj.Triangles
        self.doc.removeObject("Element")
        self.doc.recompute()
        self.assertFalse(obj.isValid())
        self.assertIn("Element", obj.getStatusString())
        self.assertEqual((obj.Triangles, obj.Mesh.CountFacets), (triangles, triangles))


class PenetrationDepths(DocumentTest):
    def test_of_overlapping_boxes(self):
        obj = scw.make_penetration_depth(self.box((10, 10, 10)), self.box((10, 10, 10), (8.5, 2, 1)), error=0.01)
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertLessEqual(obj.DepthLower.Value, 1.5 + 1e-9)
        self.assertGreaterEqual(obj.DepthUpper.Value, 1.5 - 1e-9)
        self.assertLessEqual(obj.DepthUpper.Value - obj.DepthLower.Value, 0.01)
        self.assertLess((obj.Direction - FreeCAD.Vector(1, 0, 0)).Length, 1e-2)
        self.assertEqual((obj.ClearanceLower.Value, obj.ClearanceUpper.Value), (0, 0))
        self.assertIn("overlap", obj.Report)

    def test_is_the_clearance_of_what_is_apart_and_follows_moves(self):
        first, second = self.box((10, 10, 10)), self.box((10, 10, 10), (13, 14, 0))
        obj = scw.make_penetration_depth(first, second)
        self.assertAlmostEqual(obj.ClearanceLower.Value, 5, places=6)
        self.assertAlmostEqual(obj.ClearanceUpper.Value, 5, places=6)
        self.assertEqual(obj.DepthUpper.Value, 0)
        self.assertAlmostEqual((obj.PointOfFirst - obj.PointOfSecond).Length, 5, places=6)
        self.assertIn("apart", obj.Report)
        second.Placement.Base = (9, 3, 0)
        self.doc.recompute()
        self.assertAlmostEqual(obj.DepthUpper.Value, 1, delta=0.1)

    def test_of_a_pin_in_a_bore(self):
        """A pin of 5 in the middle of a bore of 6: 1 of clearance all round, both curved."""
        bore, pin = self.doc.addObject("Part::Cylinder", "Bore"), self.doc.addObject("Part::Cylinder", "Pin")
        bore.Radius, bore.Height, bore.Placement.Base = 6, 30, (0, 0, -5)
        pin.Radius, pin.Height = 5, 20
        self.doc.recompute()
        block = scw.make_cut(self.box((30, 30, 20), (-15, -15, 0), "Block"), bore, error=0.02)
        obj = scw.make_penetration_depth(block, pin, error=0.1)
        self.assertLessEqual(obj.ClearanceLower.Value, 1 + 0.02)
        self.assertGreaterEqual(obj.ClearanceUpper.Value, 1 - 0.02)
        self.assertLessEqual(obj.ClearanceUpper.Value - obj.ClearanceLower.Value, 0.1)

    def test_containers_count(self):
        inside = self.box((10, 10, 10), name="Inside")
        holder = self.part([inside], at=(12, 0, 0))
        obj = scw.make_penetration_depth(self.box((10, 10, 10)), inside)
        self.assertAlmostEqual(obj.ClearanceLower.Value, 2, places=6)
        holder.Placement.Base = (15, 0, 0)
        self.doc.recompute()
        self.assertAlmostEqual(obj.ClearanceLower.Value, 5, places=6)

    def test_survives_saving(self):
        scw.make_penetration_depth(self.box(), self.box(at=(12, 0, 0), name="Other"), label="Gap")
        doc = self.reopened()
        doc.Other.Placement.Base = (14, 0, 0)
        doc.recompute()
        self.assertAlmostEqual(doc.getObjectsByLabel("Gap")[0].ClearanceLower.Value, 4, places=6)

    def test_refusals(self):
        box = self.box()
        before = len(self.doc.Objects)
        self.assertRaises(TypeError, scw.make_penetration_depth, box, 3)
        self.assertRaises(ValueError, scw.make_penetration_depth, box, box)
        self.assertRaises(ValueError, scw.make_penetration_depth, box, self.sphere(), error=-1)
        self.assertEqual(len(self.doc.Objects), before + 1)

    def test_what_fails_keeps_the_last_result(self):
        sketch = self.doc.addObject("Part::Feature", "Nothing")
        obj = scw.make_penetration_depth(self.box(), self.box(at=(12, 0, 0), name="Other"))
        obj.Second = sketch
        self.doc.recompute()
        self.assertFalse(obj.isValid())
        self.assertIn("Nothing", obj.getStatusString())
        self.assertAlmostEqual(obj.ClearanceLower.Value, 2, places=6)
