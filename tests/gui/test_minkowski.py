"""Minkowski sums and penetration depth from the toolbar, with pictures of what they show."""
import FreeCADGui
import window
from FreeCAD import Vector
from pivy import coin
from PySide import QtCore, QtGui

import starcell_workbench as scw
from starcell_workbench import depth_view


class MinkowskiSums(window.WindowTest):
    def setUp(self):
        super().setUp()
        self.doc, self.plate, self.rib, self.bore = window.block_with_bore()
        self.tip = self.doc.addObject("Part::Box", "Tip")
        self.tip.Length, self.tip.Width, self.tip.Height, self.tip.Placement.Base = 4, 4, 4, Vector(-2, -2, -2)
        self.doc.recompute()

    def test_of_a_part_and_a_tool(self):
        part = scw.make_cut(self.plate, self.bore, error=0.2)
        self.rib.Visibility = False
        window.select(part, self.tip)
        FreeCADGui.runCommand("StarCell_MinkowskiSum")
        window.pump()
        swept = self.doc.ActiveObject
        self.assertTrue(swept.isValid(), swept.getStatusString())
        self.assertEqual((swept.Source, swept.Element, list(swept.Genus)), (part, self.tip, [1]))
        self.assertIn(swept.Verdict, ("exact", "contact"))
        window.look(self.doc)
        window.shot("minkowski", self.doc)

    def test_the_panel_names_both_roles_and_the_element_can_be_removed(self):
        eroded = scw.make_erode(self.plate, self.tip)
        FreeCADGui.getDocument(self.doc.Name).setEdit(eroded)
        window.pump()
        rows = FreeCADGui.getMainWindow().findChild(QtGui.QListWidget, "operands")
        self.assertEqual([rows.item(k).text() for k in range(rows.count())], ["Plate   (Source)", "Tip   (Element)"])
        window.shot("erode-panel", self.doc)
        rows.setCurrentRow(1)
        window.click(FreeCADGui.getMainWindow().findChild(QtGui.QAbstractButton, "removeOperands"))
        window.click_panel(QtGui.QDialogButtonBox.Ok)
        self.assertTrue(eroded.isValid(), eroded.getStatusString())
        self.assertEqual((eroded.Element, eroded.Radius.Value), (None, 1))
        self.assertAlmostEqual(eroded.Mesh.Volume, 58 * 38 * 8, delta=1)


class PenetrationDepths(window.WindowTest):
    def setUp(self):
        super().setUp()
        self.doc, self.plate, self.rib, self.bore = window.block_with_bore()

    def measured(self, *picked):
        window.select(*picked)
        FreeCADGui.runCommand("StarCell_PenetrationDepth")
        window.pump()
        depth = self.doc.ActiveObject
        self.assertTrue(depth.isValid(), depth.getStatusString())
        return depth

    def arrow(self, depth):
        """(colour, ends of its line, label, number of heads) as drawn."""
        def every(type_):
            search = coin.SoSearchAction()
            search.setType(type_.getClassTypeId())
            search.setInterest(coin.SoSearchAction.ALL)
            search.setSearchingAll(True)
            search.apply(depth.ViewObject.RootNode)
            return [search.getPaths()[k].getTail() for k in range(search.getPaths().getLength())]

        points = every(coin.SoCoordinate3)[-1].point.getValues()
        color = next(node for node in every(coin.SoBaseColor)).rgb.getValues()[0].getValue()
        return color, [Vector(*point.getValue()) for point in points], every(coin.SoText2)[-1].string.getValues()[0], len(every(coin.SoCone))

    def assertColor(self, color, wanted):
        for one, other in zip(color, wanted):
            self.assertAlmostEqual(one, other, places=3)

    def test_an_arrow_along_the_way_out(self):
        window.select(self.plate)
        self.assertFalse(FreeCADGui.Command.get("StarCell_PenetrationDepth").isActive())
        depth = self.measured(self.plate, self.rib)
        color, (start, end), label, heads = self.arrow(depth)
        self.assertColor(color, depth_view.OVERLAP_COLOR)
        self.assertAlmostEqual((end - start).Length, depth.DepthUpper.Value, places=3)
        self.assertAlmostEqual(depth.DepthUpper.Value, 7, delta=0.2)   # up, out of the plate
        self.assertLess((end - start).normalize().getAngle(Vector(0, 0, 1)), 0.1)
        self.assertIn("mm", label)
        self.assertEqual(heads, 1)
        self.plate.ViewObject.Transparency = 60
        window.look(self.doc)
        window.shot("penetration", self.doc)

    def test_a_line_across_the_clearance(self):
        self.rib.Placement.Base = Vector(31, 11, 16)
        self.doc.recompute()
        depth = self.measured(self.plate, self.rib)
        color, (start, end), label, heads = self.arrow(depth)
        self.assertColor(color, depth_view.CLEARANCE_COLOR)
        self.assertAlmostEqual((end - start).Length, 6, places=4)
        self.assertEqual((label.strip(), heads), ("6 mm", 2))
        window.look(self.doc)
        window.shot("clearance", self.doc)
        self.rib.Placement.Base = Vector(31, 11, 5)
        self.doc.recompute()
        window.pump()
        self.assertColor(self.arrow(depth)[0], depth_view.OVERLAP_COLOR)

    def test_is_one_step_to_undo(self):
        depth = self.measured(self.plate, self.rib)
        name = depth.Name
        self.doc.undo()
        self.assertIsNone(self.doc.getObject(name))
