"""Menu, toolbar and commands: what is selected becomes the operands, in that order, and undo takes it all back."""
import FreeCADGui
import window
from FreeCAD import Vector
from PySide import QtGui

import starcell_workbench as scw

NAMES = ("StarCell_Union", "StarCell_Cut", "StarCell_Intersection", "StarCell_Rescue", "StarCell_Offset",
         "StarCell_Shell", "StarCell_MinkowskiSum", "StarCell_Erode", "StarCell_Opening", "StarCell_Closing", "StarCell_Simplify", "StarCell_Remesh",
         "StarCell_Repair", "StarCell_ConfigurationSpace", "StarCell_FreePositions", "StarCell_PenetrationDepth", "StarCell_ToSolid")


class Commands(window.WindowTest):
    def setUp(self):
        super().setUp()
        self.doc, self.plate, self.rib, self.bore = window.block_with_bore()

    def run_on(self, name, *picked):
        window.select(*picked)
        FreeCADGui.runCommand(name)
        window.pump()
        return self.doc.ActiveObject

    def test_menu_and_toolbar(self):
        self.assertLessEqual(set(NAMES), set(FreeCADGui.listCommands()))
        for name in NAMES:
            action = FreeCADGui.Command.get(name).getAction()[0]
            self.assertFalse(action.icon().isNull())
            self.assertTrue(action.toolTip())
        bar = FreeCADGui.getMainWindow().findChild(QtGui.QToolBar, "StarCell")
        self.assertTrue(bar.isVisible())
        self.assertEqual(len([each for each in bar.actions() if each.text()]), len(NAMES))

    def test_needs_two_objects(self):
        command = FreeCADGui.Command.get("StarCell_Cut")
        for picked, wanted in (((), False), ((self.plate,), False), ((self.plate, self.rib), True), ((self.plate, self.rib, self.bore), True)):
            window.select(*picked)
            self.assertEqual(command.isActive(), wanted)

    def test_rescue_takes_one_object(self):
        fuse = self.doc.addObject("Part::Fuse", "Fuse")
        fuse.Base, fuse.Tool = self.plate, self.rib
        self.doc.recompute()
        command = FreeCADGui.Command.get("StarCell_Rescue")
        for picked, wanted in (((), False), ((fuse,), True), ((fuse, self.bore), False)):
            window.select(*picked)
            self.assertEqual(command.isActive(), wanted)
        rescue = self.run_on("StarCell_Rescue", fuse)
        self.assertEqual((rescue.isValid(), rescue.Source, rescue.Agrees), (True, fuse, True), rescue.getStatusString())
        self.assertFalse(fuse.ViewObject.Visibility)
        self.assertEqual(rescue.ViewObject.Proxy.claimChildren(), [fuse])
        window.select(rescue)
        window.shot("rescue", self.doc)

    def test_rescue_says_where_opencascade_is_wrong(self):
        fuse = self.doc.addObject("Part::Fuse", "Fuse")
        fuse.Base, fuse.Tool = self.plate, self.rib
        self.doc.recompute()
        fuse.Shape = self.plate.Shape
        fuse.purgeTouched()
        self.run_on("StarCell_Rescue", fuse)
        self.assertIn("differs in volume", window.report_text())

    def test_union_then_cut(self):
        union = self.run_on("StarCell_Union", self.plate, self.rib)
        self.assertEqual((union.isValid(), union.Verdict), (True, "exact"), union.getStatusString())
        self.assertAlmostEqual(union.Volume.Value, 60 * 40 * 10 + 20 * 20 * 30 - 20 * 20 * 7, delta=0.1)
        self.assertFalse(self.plate.ViewObject.Visibility or self.rib.ViewObject.Visibility)
        self.assertTrue(union.ViewObject.Visibility)
        self.assertEqual(union.ViewObject.Proxy.claimChildren(), [self.plate, self.rib])

        cut = self.run_on("StarCell_Cut", union, self.bore)
        self.assertEqual((cut.isValid(), cut.Base, cut.Tools), (True, union, [self.bore]), cut.getStatusString())
        self.assertEqual((cut.Components, list(cut.Genus)), (1, [1]))
        window.look(self.doc)
        window.shot("cut", self.doc)
        window.select(cut)
        window.shot("properties")

    def test_undo_and_redo(self):
        self.run_on("StarCell_Union", self.plate, self.rib)
        self.doc.undo()
        self.assertIsNone(self.doc.getObject("Union"))
        self.assertTrue(self.plate.ViewObject.Visibility and self.rib.ViewObject.Visibility)
        self.doc.redo()
        self.assertTrue(self.doc.getObject("Union").isValid())
        self.assertFalse(self.plate.ViewObject.Visibility)

    def test_selection_order_is_operand_order(self):
        cut = self.run_on("StarCell_Cut", self.bore, self.plate, self.rib)
        self.assertEqual((cut.Base, cut.Tools), (self.bore, [self.plate, self.rib]))

    def test_several_faces_of_one_object_are_one_operand(self):
        window.select((self.plate, "Face1"), (self.plate, "Face2"))
        self.assertFalse(FreeCADGui.Command.get("StarCell_Union").isActive())

    def test_member_of_a_container_is_taken_where_it_is(self):
        part = self.doc.addObject("App::Part", "Part")
        part.addObject(self.bore)
        part.Placement.Base = Vector(-30, 0, 0)  # away from the rib: through the plate alone
        self.doc.recompute()
        cut = self.run_on("StarCell_Cut", (self.rib, "Face6"), (part, "Bore.Face1"))
        self.assertEqual(cut.Tools, [self.bore])
        self.assertAlmostEqual(cut.Volume.Value, 20 * 20 * 30, delta=0.1)

    def test_what_is_picked_through_a_link_is_the_link(self):
        part = self.doc.addObject("App::Part", "Part")
        part.addObject(self.bore)
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = part
        link.Placement.Base = Vector(-30, 0, 0)
        self.doc.recompute()
        cut = self.run_on("StarCell_Cut", self.rib, (link, "Bore.Face1"))
        self.assertEqual(cut.Tools, [link])
        self.assertAlmostEqual(cut.Volume.Value, 20 * 20 * 30, delta=0.1)

    def test_what_is_picked_in_a_body_is_the_body(self):
        body = self.doc.addObject("PartDesign::Body", "Body")
        pad = body.newObject("PartDesign::AdditiveBox", "Pad")
        pad.Length = pad.Width = pad.Height = 20
        self.doc.recompute()
        union = self.run_on("StarCell_Union", self.rib, (body, "Pad.Face1"))
        self.assertEqual(union.Operands, [self.rib, body])
        self.assertTrue(union.isValid(), union.getStatusString())

    def test_failure_leaves_an_object_with_its_error(self):
        sheet = self.doc.addObject("Part::Plane", "Sheet")
        self.doc.recompute()
        union = self.run_on("StarCell_Union", self.plate, sheet)
        self.assertFalse(union.isValid())
        self.assertIn("'Sheet' has no solid", union.getStatusString())
        self.assertIn("'Sheet' has no solid", window.report_text())
        self.assertTrue(self.plate.ViewObject.Visibility)

    def test_deleting_shows_the_operands_again(self):
        union = scw.make_union([self.plate, self.rib])
        window.select(union)
        FreeCADGui.runCommand("Std_Delete")
        window.pump()
        self.assertIsNone(self.doc.getObject("Union"))
        self.assertTrue(self.plate.ViewObject.Visibility and self.rib.ViewObject.Visibility)
