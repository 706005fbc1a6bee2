"""Remeshing from the toolbar, and in its panel, with a picture of the triangles."""
import FreeCADGui
import window
from PySide import QtGui

import starcell_workbench as scw


class Remeshing(window.WindowTest):
    def test_of_a_part_and_in_the_panel(self):
        doc, plate, rib, bore = window.block_with_bore()
        part = scw.make_cut(scw.make_union([plate, rib], error=0.2), bore, error=0.2)
        window.select(part)
        FreeCADGui.runCommand("StarCell_Remesh")
        window.pump()
        even = doc.ActiveObject
        self.assertTrue(even.isValid(), even.getStatusString())
        self.assertIn(even.Verdict, ("exact", "contact"))
        self.assertEqual((even.Source, list(even.Genus)), (part, [1]))
        self.assertLess(even.AspectRatio, 1.5)
        FreeCADGui.getDocument(doc.Name).setEdit(even)
        window.pump()
        fields = {field.toolTip(): field for field in FreeCADGui.getMainWindow().findChildren(QtGui.QLineEdit)}
        angle, length = (next(field for tip, field in fields.items() if tip.startswith(start)) for start in ("Edges at which", "Length of most"))
        self.assertEqual(angle.text(), "40.0 deg")
        angle.setText("50 deg")
        length.setText("4 mm")
        window.shot("remesh-panel", doc)
        window.click_panel(QtGui.QDialogButtonBox.Ok)
        self.assertTrue(even.isValid(), even.getStatusString())
        self.assertIn(even.Verdict, ("exact", "contact"))
        self.assertEqual((even.FeatureAngle.Value, even.EdgeLength.Value), (50, 4))
        even.ViewObject.DisplayMode = "Flat Lines"
        window.look(doc)
        window.shot("remesh", doc)
