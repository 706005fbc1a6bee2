"""The offset commands: offered for one solid, a parameter in the panel, and what the picture shows."""
import FreeCADGui
import window

import starcell_workbench as scw
from starcell_workbench.task_operation import OperationTask


class Offset(window.WindowTest):
    def setUp(self):
        super().setUp()
        self.doc, self.plate, self.rib, self.bore = window.block_with_bore()

    def test_needs_one_object(self):
        # Of two objects the second one takes the ball's place.
        for name, takes_two in (("StarCell_Offset", False), ("StarCell_Shell", False), ("StarCell_Erode", True), ("StarCell_Opening", True),
                                ("StarCell_Closing", True)):
            command = FreeCADGui.Command.get(name)
            for picked, wanted in (((), False), ((self.plate,), True), ((self.plate, self.rib), takes_two), ((self.plate, self.rib, self.bore), False)):
                window.select(*picked)
                self.assertEqual(command.isActive(), wanted, name)

    def test_a_fattened_part(self):
        part = scw.make_union([self.plate, self.rib])
        window.select(part)
        FreeCADGui.runCommand("StarCell_Offset")
        window.pump()
        fat = self.doc.ActiveObject
        self.assertTrue(fat.isValid(), fat.getStatusString())
        self.assertEqual((fat.Verdict, list(fat.Genus), fat.Distance.Value), ("exact", [0], 1.0))
        self.assertGreater(fat.Mesh.Volume, part.Mesh.Volume)
        window.look(self.doc)
        window.shot("offset", self.doc)

    def test_a_tray_open_where_a_face_was_picked(self):
        FreeCADGui.Selection.clearSelection()
        top = next("Face{}".format(k + 1) for k, face in enumerate(self.plate.Shape.Faces)
                   if abs(face.CenterOfMass.z - self.plate.Shape.BoundBox.ZMax) < 1e-9)
        FreeCADGui.Selection.addSelection(self.doc.Name, self.plate.Name, top)
        FreeCADGui.runCommand("StarCell_Shell")
        window.pump()
        tray = self.doc.ActiveObject
        self.assertTrue(tray.isValid(), tray.getStatusString())
        self.assertEqual((tray.OpenFaces, list(tray.Genus)), ([top], [0]))
        tray.Thickness = -1
        panel = OperationTask(tray)
        self.assertEqual(panel.fields["OpenFaces"].text(), top)
        panel.fields["OpenFaces"].setText("")
        self.assertTrue(panel.apply())
        self.assertEqual(list(tray.Genus), [0, 0])
        panel.fields["OpenFaces"].setText(" {} ".format(top))
        self.assertTrue(panel.apply())
        self.assertEqual(list(tray.Genus), [0])
        self.assertIn(tray.Verdict, ("exact", "contact"))
        self.assertAlmostEqual(tray.Mesh.Volume, 60 * 40 * 10 - 58 * 38 * 9, delta=20)
        panel.reject()
        window.look(self.doc)
        window.shot("tray", self.doc)

    def test_thin_walls_are_drawn_until_they_are_hidden(self):
        self.rib.Visibility = False
        ring = scw.make_cut(self.plate, self.bore)
        shelf = self.doc.addObject("Part::Box", "Shelf")
        shelf.Length, shelf.Width, shelf.Height = 60, 3, 40
        shelf.Placement.Base = (0, 37, 0)
        self.doc.recompute()
        part = scw.make_union([ring, shelf])
        thin = scw.make_offset(part, -2)
        self.assertIn("Walls thinner than 4 mm", thin.Report)
        highlight = thin.ViewObject.Proxy.highlight
        self.assertEqual(highlight.spokes.points.point.getNum(), len(thin.ThinSpokes))
        self.assertEqual(highlight.boxes.points.point.getNum(), 24 * (len(thin.ThinPlaces) // 2))
        self.assertTrue(highlight.is_shown())
        window.look(self.doc)
        FreeCADGui.Selection.clearSelection()
        window.shot("thin-places", self.doc)
        panel = OperationTask(thin)
        self.assertTrue(panel.form.showPlaces.isChecked())
        panel.form.showPlaces.setChecked(False)
        self.assertFalse(highlight.is_shown())
        panel.reject()
        thin.Distance = -0.5
        self.doc.recompute()
        self.assertEqual(highlight.spokes.points.point.getNum(), 0)

    def test_the_panel_takes_a_distance_of_either_sign(self):
        obj = scw.make_offset(self.plate, 1)
        panel = OperationTask(obj)
        panel.fields["Distance"].setText("-1 mm")
        self.assertTrue(panel.apply())
        self.assertEqual(obj.Distance.Value, -1)
        self.assertLess(obj.Mesh.Volume, self.plate.Shape.Volume)
        panel.fields["Distance"].setText("one")
        self.assertFalse(panel.apply())
        self.assertIn("Distance", panel.form.problem.text())
        panel.reject()
