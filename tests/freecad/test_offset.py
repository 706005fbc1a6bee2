"""Offsets, shells, openings and closings of document objects: closed forms, what follows a change, and what is refused."""
import math

from support import DocumentTest

import starcell_workbench as scw


def steiner(a, b, c, r):
    """Volume of a box grown by a ball of radius r (Steiner 1840)."""
    return a * b * c + 2 * (a * b + b * c + c * a) * r + math.pi * (a + b + c) * r * r + 4 * math.pi / 3 * r ** 3


class Offsets(DocumentTest):
    def setUp(self):
        super().setUp()
        self.a = self.doc.addObject("Part::Box", "A")
        self.a.Length, self.a.Width, self.a.Height = 10, 8, 6
        self.doc.recompute()

    def assertResult(self, obj, volume, genus, relative=0.02):
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertIn(obj.Verdict, ("exact", "contact"))
        self.assertEqual(list(obj.Genus), genus)
        self.assertAlmostEqual(obj.Mesh.Volume, volume, delta=relative * volume)

    def test_outward_is_rounded(self):
        self.assertResult(scw.make_offset(self.a, 1, error=0.1), steiner(10, 8, 6, 1), [0])

    def test_inward_is_sharp_and_follows_its_source(self):
        obj = scw.make_offset(self.a, "-0.5 mm")
        self.assertResult(obj, 9 * 7 * 5, [0], relative=1e-6)
        self.a.Length = 12
        self.doc.recompute()
        self.assertResult(obj, 11 * 7 * 5, [0], relative=1e-6)
        obj.Distance = -1
        self.doc.recompute()
        self.assertResult(obj, 10 * 6 * 4, [0], relative=1e-6)

    def test_what_vanishes_is_empty_and_says_so(self):
        obj = scw.make_offset(self.a, -3.5)
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertEqual((obj.Components, obj.Mesh.CountFacets), (0, 0))
        self.assertIn("Nothing is left", obj.Report)

    def dumbbell(self):
        """Two cubes of 10, joined by a plate 20 x 10 x 1, as one compound's worth of solids fused by StarCell."""
        ends = []
        for name, size, at in (("Left", (10, 10, 10), (0, 0, 0)), ("Plate", (22, 10, 1), (9, 0, 4)), ("Right", (10, 10, 10), (30, 0, 0))):
            box = self.doc.addObject("Part::Box", name)
            box.Length, box.Width, box.Height = size
            box.Placement.Base = at
            ends.append(box)
        self.doc.recompute()
        return scw.make_union(ends, error=0.1)

    def test_a_thin_wall_is_named_where_the_part_falls_apart(self):
        obj = scw.make_offset(self.dumbbell(), -0.6, error=0.2)
        self.assertResult(obj, 2 * 8.8 ** 3, [0, 0], relative=2e-3)  # and a little that reaches towards the plate
        self.assertEqual(len(obj.ThinPlaces), 2)
        low, high = obj.ThinPlaces
        for got, wanted in zip((*low, *high), (10, 0, 4, 30, 10, 5)):
            self.assertAlmostEqual(got, wanted, delta=0.5)
        self.assertAlmostEqual(obj.Thicknesses[0], 1, places=4)
        self.assertIn("1 of 1 parts fall(s) apart, into 2 pieces.", obj.Report)
        self.assertIn("Walls thinner than 1.2 mm: 1 place(s).", obj.Report)
        obj.Distance = -0.4
        self.doc.recompute()
        self.assertEqual((obj.Components, list(obj.ThinPlaces), list(obj.ThinSpokes)), (1, [], []))
        self.assertNotIn("thinner", obj.Report)

    def test_gaps_that_close_are_named(self):
        bar = self.doc.addObject("Part::Box", "Bar")
        bar.Length, bar.Width, bar.Height, bar.Placement.Base = 10, 8, 6, (12, 0, 0)
        self.doc.recompute()
        both = scw.make_union([self.a, bar], error=0.2)
        obj = scw.make_offset(both, 1.1, error=0.2)
        self.assertEqual(obj.Components, 1)
        self.assertIn("2 parts grow together into 1.", obj.Report)
        self.assertAlmostEqual(obj.Thicknesses[0], 2, places=4)
        closed = scw.make_closing(both, 1.1, error=0.4)
        self.assertIn("Gaps narrower than 2.2 mm: 1 place(s).", closed.Report)

    def test_an_opening_names_what_it_loses(self):
        obj = scw.make_opening(self.dumbbell(), 0.6, error=0.3)
        self.assertEqual((obj.Components, len(obj.ThinPlaces)), (2, 2))

    def test_thin_walls_of_what_is_curved(self):
        ball, hollow = self.doc.addObject("Part::Sphere", "Ball"), self.doc.addObject("Part::Sphere", "Hollow")
        ball.Radius, hollow.Radius = 5, 4.5
        hollow.Placement.Base = (0, 0, 0.2)
        self.doc.recompute()
        obj = scw.make_erode(scw.make_cut(ball, hollow), 0.4, error=0.1)
        self.assertAlmostEqual(obj.Thicknesses[0], 0.3, delta=0.1)

    def test_findings_stay_in_the_document(self):
        import os
        import tempfile

        import FreeCAD

        obj = scw.make_offset(self.dumbbell(), -0.6, error=0.2)
        spokes = list(obj.ThinSpokes)
        self.assertTrue(spokes)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "thin.FCStd")
            self.doc.saveAs(path)
            again = FreeCAD.openDocument(path)
            try:
                self.assertEqual(list(again.getObject(obj.Name).ThinSpokes), spokes)
            finally:
                FreeCAD.closeDocument(again.Name)

    def test_curved_primitives_stay_exact_where_there_is_a_closed_form(self):
        ball = self.doc.addObject("Part::Sphere", "Ball")
        ball.Radius = 5
        self.doc.recompute()
        self.assertResult(scw.make_offset(ball, 1, error=0.1), 4 / 3 * math.pi * 216, [0], relative=0.03)

    def test_shells(self):
        self.assertResult(scw.make_shell(self.a, -1, error=0.2), 480 - 8 * 6 * 4, [0, 0], relative=1e-6)
        self.assertResult(scw.make_shell(self.a, 1, error=0.2), steiner(10, 8, 6, 1) - 480, [0, 0])

    def test_shells_with_open_faces(self):
        top = next("Face{}".format(k + 1) for k, face in enumerate(self.a.Shape.Faces) if abs(face.CenterOfMass.z - 6) < 1e-9)
        tray = scw.make_shell(self.a, -1, error=0.1, open_faces=[top])
        self.assertResult(tray, 480 - 8 * 6 * 5, [0], relative=1e-3)
        front = next("Face{}".format(k + 1) for k, face in enumerate(self.a.Shape.Faces) if abs(face.CenterOfMass.y) < 1e-9)
        tray.OpenFaces = [top, front]
        self.doc.recompute()
        self.assertResult(tray, 480 - 8 * 7 * 5, [0], relative=1e-3)
        tray.OpenFaces = ["Face7"]
        self.doc.recompute()
        self.assertFalse(tray.isValid())
        self.assertRaises(TypeError, scw.make_shell, self.a, -1, open_faces="Face6")

    def test_a_cup(self):
        """A cylinder is tessellated to have faces: its wall and bottom stay."""
        can = self.doc.addObject("Part::Cylinder", "Can")
        can.Radius, can.Height = 5, 12
        can.Placement.Base = (1, 2, 3)
        self.doc.recompute()
        top = next("Face{}".format(k + 1) for k, face in enumerate(can.Shape.Faces) if abs(face.CenterOfMass.z - 15) < 1e-9)
        cup = scw.make_shell(can, -1, error=0.1, open_faces=[top])
        self.assertResult(cup, math.pi * (25 * 12 - 16 * 11), [0], relative=0.03)
        self.assertIn("tessellated", cup.Certificate)

    def test_erode_and_opening(self):
        self.assertResult(scw.make_erode(self.a, 1), 8 * 6 * 4, [0], relative=1e-6)
        self.assertResult(scw.make_opening(self.a, 1, error=0.2), steiner(8, 6, 4, 1), [0])

    def test_closing_leaves_a_convex_solid_alone(self):
        self.assertResult(scw.make_closing(self.a, 1, error=0.5), 480, [0], relative=0.05)

    def test_refusals_leave_the_document_as_it_was(self):
        before = len(self.doc.Objects)
        for call in (lambda: scw.make_offset(self.a, 0), lambda: scw.make_offset(self.a, "3 kg"), lambda: scw.make_opening(self.a, -1)):
            with self.assertRaises(ValueError):
                call()
        with self.assertRaises(TypeError):
            scw.make_offset(self.a, None)
        self.assertEqual(len(self.doc.Objects), before)
