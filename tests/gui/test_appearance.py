"""How results look: the warning of an unresolved one, a reopened document, the preferences."""
import os
import tempfile
import zipfile
from types import SimpleNamespace

import FreeCAD
import FreeCADGui
import window
from PySide import QtGui

import starcell_workbench as scw
from starcell_workbench import operation_view
from starcell_workbench.boolean_feature import Union

FIELDS = ("error_bound", "requested_error", "contact_tolerance", "components", "genus", "euler_characteristic", "tessellated", "contacts",
          "statistics")


class Unresolved(Union):
    """The real mesh, with a certificate that says that something is open."""

    def compute(self, starcell, solids, values, options):
        result = super().compute(starcell, solids, values, options)
        certificate = SimpleNamespace(verdict="unresolved", unresolved=[((0, 0, 0), (1, 1, 1))] * 5,
                                      **{name: getattr(result.certificate, name) for name in FIELDS})
        return SimpleNamespace(vertices=result.vertices, triangles=result.triangles, certificate=certificate)


class Appearance(window.WindowTest):
    def setUp(self):
        super().setUp()
        self.doc, self.plate, self.rib, self.bore = window.block_with_bore()

    def assertColor(self, got, wanted):
        for a, b in zip(got, wanted):
            self.assertAlmostEqual(a, b, delta=0.01)

    def test_unresolved_is_flagged_until_it_is_resolved(self):
        obj = scw.make_union([self.plate, self.rib])
        plain = obj.ViewObject.ShapeColor
        Unresolved(obj)
        obj.touch()
        self.doc.recompute()
        self.assertEqual((obj.isValid(), obj.Verdict), (True, "unresolved"))
        self.assertIn("(5)", obj.Report)
        self.assertIn("unresolved places: 5", window.report_text())
        self.assertColor(obj.ViewObject.ShapeColor, operation_view.WARNING_COLOR)
        self.assertIn("Unresolved", obj.ViewObject.Proxy.getIcon())
        window.look(self.doc)
        window.shot("unresolved", self.doc)

        Union(obj)
        obj.touch()
        self.doc.recompute()
        self.assertEqual(obj.Verdict, "exact")
        self.assertColor(obj.ViewObject.ShapeColor, plain)

    def test_creases_are_drawn(self):
        # The union's edges: 12 of the plate, 8 of the rib's part above it, 4 where it stands.
        obj = scw.make_union([self.plate, self.rib])
        corners = [tuple(round(value, 3) for value in point) for point in obj.ViewObject.Proxy.creases.segments()]
        length = sum(sum(abs(a - b) for a, b in zip(corners[k], corners[k + 1])) for k in range(0, len(corners), 2))  # all parallel to an axis
        self.assertAlmostEqual(length, 4 * (60 + 40 + 10) + 4 * (20 + 23) + 4 * 20, delta=0.01)

    def test_saved_document_opens_as_it_was(self):
        scw.make_cut(scw.make_union([self.plate, self.rib]), self.bore)
        volume = self.doc.Cut.Volume.Value
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "block.FCStd")
            self.doc.saveAs(path)
            FreeCAD.closeDocument(self.doc.Name)
            doc = FreeCAD.openDocument(path)
        self.assertTrue(doc.Cut.isValid())
        self.assertAlmostEqual(doc.Cut.Volume.Value, volume, delta=1e-9 * volume)
        self.assertIsInstance(doc.Cut.ViewObject.Proxy, operation_view.OperationView)
        self.assertFalse(doc.Union.ViewObject.Visibility)
        doc.Bore.Radius = 5
        doc.recompute()
        self.assertTrue(doc.Cut.isValid())
        self.assertGreater(doc.Cut.Volume.Value, volume)
        self.assertTrue(FreeCADGui.getDocument(doc.Name).setEdit("Cut"))
        window.look(doc)
        window.shot("reopened", doc)

    def test_document_made_without_a_window_gets_its_looks(self):
        scw.make_union([self.plate, self.rib])
        with tempfile.TemporaryDirectory() as folder:
            path, bare = os.path.join(folder, "seen.FCStd"), os.path.join(folder, "bare.FCStd")
            self.doc.saveAs(path)
            FreeCAD.closeDocument(self.doc.Name)
            with zipfile.ZipFile(path) as whole, zipfile.ZipFile(bare, "w") as without:
                for name in whole.namelist():
                    if name != "GuiDocument.xml":  # what a headless session does not write
                        without.writestr(name, whole.read(name))
            doc = FreeCAD.openDocument(bare)
        window.pump()
        proxy = doc.Union.ViewObject.Proxy
        self.assertIsInstance(proxy, operation_view.OperationView)
        self.assertEqual(proxy.claimChildren(), [doc.Plate, doc.Rib])
        self.assertTrue(proxy.creases.segments())

    def test_preferences_page(self):
        found = []

        def look():
            dialog = QtGui.QApplication.activeModalWidget()
            window.shot("preferences")
            found.extend(dialog.findChild(QtGui.QSpinBox, name).value() for name in ("divisor", "threads"))
            dialog.reject()

        window.later(1500, look)
        FreeCADGui.showPreferences("StarCell", 0)
        self.assertEqual(found, [128, 0])
