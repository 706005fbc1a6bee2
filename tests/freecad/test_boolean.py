"""Union, cut and intersection of Part solids, headless, against closed forms."""
import json
import math

import FreeCAD
from support import DocumentTest

import starcell_workbench as scw


class PlanarSolids(DocumentTest):
    # Two cubes of side 10 that overlap in a cube of side 5, in general position: volumes 1000, 1000 and 125.

    def setUp(self):
        super().setUp()
        self.a = self.box(name="A")
        self.b = self.box(at=(5, 5, 5), name="B")

    def test_union(self):
        self.assertSolid(scw.make_union([self.a, self.b]), 1875)

    def test_cut(self):
        self.assertSolid(scw.make_cut(self.a, self.b), 875)

    def test_cut_is_not_symmetric(self):
        obj = scw.make_cut(self.b, self.a)
        self.assertSolid(obj, 875)
        self.assertBox(obj, (5, 5, 5), (15, 15, 15))

    def test_intersection(self):
        obj = scw.make_intersection([self.a, self.b])
        self.assertSolid(obj, 125)
        self.assertBox(obj, (5, 5, 5), (10, 10, 10))

    def test_cut_by_several_tools(self):
        # A second tool takes a cube of side 4 from the opposite corner: 1000 - 125 - 64.
        self.assertSolid(scw.make_cut(self.a, [self.b, self.box(at=(-6, -6, -6))]), 811)

    def test_through_hole_has_genus_one(self):
        # A square hole of side 2 right through: 1000 - 2 * 2 * 10.
        hole = self.box((2, 2, 12), (4, 4, -1))
        self.assertSolid(scw.make_cut(self.a, hole), 960, genus=(1,))

    def test_disjoint_operands_are_two_components(self):
        far = self.box((1, 2, 3), (20, 0, 0))
        self.assertSolid(scw.make_union([self.a, far]), 1006, components=2, genus=(0, 0))

    def test_flush_boxes_become_one(self):
        # Stacked cubes share a face: contact, one component, no wall.
        self.assertSolid(scw.make_union([self.a, self.box(at=(0, 0, 10))]), 2000, verdicts=("exact", "contact"))

    def test_nothing_left_is_no_error(self):
        obj = scw.make_cut(self.a, self.box((12, 12, 12), (-1, -1, -1)))
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertEqual((obj.Components, list(obj.Genus), obj.Triangles, obj.Mesh.CountFacets), (0, [], 0, 0))
        self.assertEqual(obj.Volume.Value, 0)


class CurvedSolids(DocumentTest):
    def test_box_and_sphere(self):
        # A ball of radius 6 at a corner of the cube: an eighth of it is inside.
        obj = scw.make_union([self.box(), self.sphere()], error="0.1 mm")
        ball = 4 / 3 * math.pi * 6 ** 3
        area = 4 * math.pi * 36 * 7 / 8  # only curved faces deviate
        # The ball's equators lie in the cube's sides, so the verdict may only speak of a slightly moved input.
        self.assertSolid(obj, 1000 + 7 / 8 * ball, relative=0.1 * area / (1000 + 7 / 8 * ball), verdicts=("exact", "contact"))
        self.assertLessEqual(obj.ErrorBound.Value, 0.1)
        self.assertGreater(obj.ErrorBound.Value, 0)
        self.assertNotIn("approximated", obj.Report)

    def test_curved_faces_of_other_shapes_are_approximated(self):
        # A block with rounded edges: 1000 less four times the square outside a quarter circle of radius 2, over a height of 10.
        block = self.doc.addObject("Part::Feature", "Rounded")
        upright = self.box(name="Plain").Shape
        block.Shape = upright.makeFillet(2, [edge for edge in upright.Edges if edge.BoundBox.ZLength > 9])
        volume = 1000 - 4 * (4 - math.pi) * 10
        obj = scw.make_union([block, self.box((2, 2, 2), (4, 4, 9))], error=0.05)
        self.assertSolid(obj, volume + 4, relative=0.05 * 4 * math.pi * 10 / volume)
        self.assertIn("approximated", obj.Report)

    def test_bored_block_is_within_the_bound(self):
        # A bore of radius 3 through a cube of 10: every point of the bore's wall is that far from the axis.
        cylinder = self.doc.addObject("Part::Cylinder", "Bore")
        cylinder.Radius, cylinder.Height = 3, 12
        cylinder.Placement.Base = FreeCAD.Vector(5, 5, -1)
        obj = scw.make_cut(self.box(), cylinder, error=0.05)
        self.assertSolid(obj, 1000 - 90 * math.pi, genus=(1,), relative=0.05 * 60 * math.pi / (1000 - 90 * math.pi))
        walls = [math.hypot(p.x - 5, p.y - 5) for p in obj.Mesh.Topology[0] if 1e-3 < min(*p, 10 - p.x, 10 - p.y, 10 - p.z)]
        self.assertTrue(walls)
        self.assertLessEqual(max(abs(r - 3) for r in walls), obj.ErrorBound.Value)


class Options(DocumentTest):
    def setUp(self):
        super().setUp()
        self.a, self.b = self.box(name="A"), self.box(at=(5, 5, 5), name="B")

    def test_error_as_number_text_and_quantity(self):
        for error in (0.2, "0.2 mm", "200 um", FreeCAD.Units.Quantity("0.2 mm")):
            obj = scw.make_union([self.a, self.b], error=error)
            self.assertAlmostEqual(obj.Error.Value, 0.2)
            self.assertAlmostEqual(json.loads(obj.Certificate)["requested_error"], 0.2)

    def test_automatic_error_is_longest_side_over_128(self):
        # The union's box is 15 wide, the intersection's 5, the cut's 10.
        for make, side in ((lambda: scw.make_union([self.a, self.b]), 15), (lambda: scw.make_intersection([self.a, self.b]), 5),
                           (lambda: scw.make_cut(self.a, self.b), 10)):
            self.assertAlmostEqual(json.loads(make().Certificate)["requested_error"], side / 128)

    def test_contact_tolerance_is_passed_on(self):
        obj = scw.make_union([self.a, self.b], contact="0.0001 mm")
        self.assertAlmostEqual(json.loads(obj.Certificate)["contact_tolerance"], 0.0001)

    def test_shown_lengths_are_rounded_up(self):
        from starcell_workbench import lengths

        for value, text in ((0.1, "0.1 mm"), (0.12341, "0.1235 mm"), (2.10001e-10, "2.101e-10 mm"), (15, "15 mm"), (0, "0 mm")):
            self.assertEqual(lengths.show(value), text)

    def test_label_and_document(self):
        obj = scw.make_union([self.a, self.b], label="Sum", document=self.doc)
        self.assertEqual(obj.Label, "Sum")
        self.assertIs(obj.Document, self.doc)

    def test_operands_are_hidden(self):
        scw.make_union([self.a, self.b])
        self.assertFalse(self.a.Visibility or self.b.Visibility)

    def test_operands_of_a_failed_result_stay_visible(self):
        scw.make_union([self.a, self.doc.addObject("App::FeaturePython", "Note")])
        self.assertTrue(self.a.Visibility)

    def test_outputs_are_read_only(self):
        obj = scw.make_union([self.a, self.b])
        for name in ("Verdict", "ErrorBound", "Components", "Genus", "Certificate", "Report", "Triangles", "Volume", "Seconds"):
            self.assertIn("ReadOnly", obj.getTypeOfProperty(name))

    def test_wrong_arguments_raise_and_leave_the_document_alone(self):
        other = FreeCAD.newDocument("Other").addObject("Part::Box", "Far")
        before = len(self.doc.Objects)
        for call in (lambda: scw.make_union([self.a]), lambda: scw.make_union([]), lambda: scw.make_cut(self.a, []),
                     lambda: scw.make_union([self.a, self.b], error=0), lambda: scw.make_union([self.a, self.b], error=-1),
                     lambda: scw.make_union([self.a, self.b], error=math.inf), lambda: scw.make_union([self.a, self.b], error=math.nan),
                     lambda: scw.make_union([self.a, self.b], error="3 s"), lambda: scw.make_union([self.a, self.b], error="thin"),
                     lambda: scw.make_union([self.a, self.b], contact=0), lambda: scw.make_union([self.a, other])):
            self.assertRaises(ValueError, call)
        for call in (lambda: scw.make_union("Box"), lambda: scw.make_union(7), lambda: scw.make_union([self.a, "B"]),
                     lambda: scw.make_cut(None, self.b), lambda: scw.make_union([self.a, self.b], error=[1])):
            self.assertRaises(TypeError, call)
        self.assertEqual(len(self.doc.Objects), before)
