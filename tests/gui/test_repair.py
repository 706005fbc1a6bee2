"""Repair from the toolbar: boxes about what was wrong, until they are hidden."""
import FreeCADGui
import Mesh
import MeshPart
import window

from starcell_workbench.task_operation import OperationTask


class Repairing(window.WindowTest):
    def test_of_parts_in_one_file_with_turned_triangles(self):
        doc, plate, rib, bore = window.block_with_bore()
        triangles = [list(facet.Points) for part in (plate, rib, bore) for facet in MeshPart.meshFromShape(Shape=part.Shape, LinearDeflection=0.1).Facets]
        for number in (1, 14, 30):
            triangles[number].reverse()
        for part in (plate, rib, bore):
            part.Visibility = False
        scan = doc.addObject("Mesh::Feature", "Scan")
        scan.Mesh = Mesh.Mesh(triangles)
        window.select(scan)
        FreeCADGui.runCommand("StarCell_Repair")
        window.pump()
        whole = doc.ActiveObject
        self.assertTrue(whole.isValid(), whole.getStatusString())
        self.assertIn(whole.Verdict, ("exact", "contact"))
        self.assertEqual((whole.Meshes, whole.Components, list(whole.Genus)), ([scan], 1, [0]))
        self.assertEqual([flaw.split(" near")[0] for flaw in whole.Flaws], 3 * ["turned triangle"])
        highlight = whole.ViewObject.Proxy.highlight
        self.assertEqual(highlight.boxes.points.point.getNum(), 24 * 3)
        self.assertTrue(highlight.is_shown())
        window.look(doc)
        window.shot("repair", doc)
        panel = OperationTask(whole)
        self.assertEqual(panel.form.showPlaces.text(), "Show what was wrong")
        panel.form.showPlaces.setChecked(False)
        self.assertFalse(highlight.is_shown())
        panel.reject()
