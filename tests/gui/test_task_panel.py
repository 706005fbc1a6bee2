"""The task panel: values in and out, operands, failure, and what Cancel takes back."""
import FreeCADGui
import window
from PySide import QtGui

import starcell_workbench as scw

OK, CANCEL = QtGui.QDialogButtonBox.Ok, QtGui.QDialogButtonBox.Cancel


class TaskPanel(window.WindowTest):
    def setUp(self):
        super().setUp()
        self.doc, self.plate, self.rib, self.bore = window.block_with_bore()

    def open(self, obj):
        self.assertTrue(FreeCADGui.getDocument(self.doc.Name).setEdit(obj.Name))
        window.pump()
        self.assertTrue(self.is_open())
        return obj.ViewObject.Proxy.task.form

    def is_open(self):
        return bool(FreeCADGui.Control.activeDialog())

    def rows(self, form):
        return [form.operands.item(index).text() for index in range(form.operands.count())]

    def test_shows_the_object(self):
        cut = scw.make_cut(self.plate, self.bore, error="0.5 mm")
        window.look(self.doc)
        form = self.open(cut)
        self.assertEqual(self.rows(form), ["Plate   (Base)", "Bore   (Tools)"])
        self.assertEqual((form.error.text(), form.contact.text()), ("0.5 mm", ""))
        self.assertEqual((form.verdict.text(), form.genus.text(), form.triangles.text()), (cut.Verdict, "1", str(cut.Triangles)))
        window.shot("task-panel", self.doc)

    def test_double_click_opens_it(self):
        cut = scw.make_cut(self.plate, self.bore)
        cut.ViewObject.Proxy.doubleClicked(cut.ViewObject)
        window.pump()
        self.assertTrue(self.is_open())

    def test_apply_stays_and_cancel_keeps_what_was_applied(self):
        cut = scw.make_cut(self.plate, self.bore, error="0.5 mm")
        coarse = cut.Triangles
        form = self.open(cut)
        form.error.setText("20 um")
        window.click(form.apply)
        self.assertTrue(self.is_open())
        self.assertGreater(cut.Triangles, coarse)
        self.assertLessEqual(cut.ErrorBound.Value, 0.02)
        self.assertEqual(form.triangles.text(), str(cut.Triangles))
        fine = cut.Triangles

        form.error.setText("1 mm")
        window.click_panel(CANCEL)
        self.assertFalse(self.is_open())
        self.assertEqual((cut.Error.Value, cut.Triangles), (0.02, fine))

    def test_an_estimate_follows_what_is_typed(self):
        obj = scw.make_offset(self.plate, 1, error="2 mm")
        form = self.open(obj)
        seen = self.wait_for_estimate(form)
        self.assertIn("triangles", seen)
        form.error.setText("20 um")
        window.pump(0.1)
        self.assertEqual(form.estimate.text(), "")
        finer = self.wait_for_estimate(form)
        self.assertIn("20.00 µm" if "µm" in finer else "0.02", finer)
        self.assertNotEqual(finer, seen)
        window.shot("estimate", self.doc)
        form.error.setText("much")
        window.pump(1.0)
        self.assertEqual(form.estimate.text(), "")
        window.click_panel(CANCEL)
        self.assertEqual(obj.Error.Value, 2)

    def wait_for_estimate(self, form):
        for _ in range(150):
            window.pump(0.1)
            if form.estimate.text() and "…" not in form.estimate.text():
                return form.estimate.text()
        return ""

    def test_what_is_no_length_is_refused(self):
        cut = scw.make_cut(self.plate, self.bore, error="0.5 mm")
        form = self.open(cut)
        for text in ("a bit", "3 s", "-1 mm", "0"):
            form.error.setText(text)
            window.click_panel(OK)
            self.assertTrue(self.is_open())
            self.assertIn("Error: ", form.problem.text())
            self.assertEqual(cut.Error.Value, 0.5)

    def test_empty_is_automatic(self):
        cut = scw.make_cut(self.plate, self.bore, error="0.5 mm")
        form = self.open(cut)
        form.error.setText("")
        window.click_panel(OK)
        self.assertEqual((self.is_open(), cut.Error.Value, cut.isValid()), (False, 0, True))

    def test_operands_are_added(self):
        union = scw.make_union([self.plate, self.rib])
        form = self.open(union)
        window.select(self.bore, union)
        window.click(form.addOperands)
        self.assertEqual(self.rows(form), ["Plate", "Rib", "Bore"])
        self.assertIn("'Union' cannot be an operand", form.problem.text())
        window.click_panel(OK)
        self.assertFalse(self.is_open())
        self.assertEqual((union.Operands, union.isValid()), ([self.plate, self.rib, self.bore], True))

    def test_reordered_and_removed_operands(self):
        cut = scw.make_cut(self.plate, [self.rib, self.bore])
        form = self.open(cut)
        form.operands.insertItem(0, form.operands.takeItem(1))  # what a drag does
        window.pump()
        self.assertEqual(self.rows(form), ["Rib   (Base)", "Plate   (Tools)", "Bore   (Tools)"])
        window.click(form.apply)
        self.assertEqual((cut.Base, cut.Tools, cut.isValid()), (self.rib, [self.plate, self.bore], True))

        form.operands.item(2).setSelected(True)
        window.click(form.removeOperands)
        window.click_panel(OK)
        self.assertEqual((cut.Tools, cut.isValid()), ([self.plate], True))
        self.assertAlmostEqual(cut.Volume.Value, 20 * 20 * 30 - 20 * 20 * 7, delta=0.1)
        self.doc.undo()
        self.assertEqual(cut.Tools, [self.plate, self.bore])

    def test_failure_keeps_mesh_and_panel_and_says_why(self):
        union = scw.make_union([self.plate, self.rib])
        before = (union.Triangles, union.Mesh.CountFacets)
        sheet = self.doc.addObject("Part::Plane", "Sheet")
        self.doc.recompute()
        form = self.open(union)
        window.select(sheet)
        window.click(form.addOperands)
        window.click_panel(OK)
        self.assertTrue(self.is_open())
        self.assertTrue(form.problem.isVisible())
        self.assertIn("Sheet", form.problem.text())
        self.assertFalse(union.isValid())
        self.assertEqual((union.Triangles, union.Mesh.CountFacets), before)
        window.look(self.doc)
        window.shot("failed", self.doc)
        window.click_panel(CANCEL)
        self.assertFalse(self.is_open())
        self.assertEqual(union.Operands, [self.plate, self.rib])
