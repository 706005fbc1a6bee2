"""The GUI's test cases, in order. Each gets the folder for its pictures and raises if something is not as it should be."""
import os
import re
import tempfile
import time

import FreeCAD
import FreeCADGui
import window
from FreeCAD import Vector
from PySide import QtCore, QtGui

import starcell_workbench as scw
from starcell_workbench.boolean_feature import Union
from starcell_workbench.operation_feature import OperationFeature, Role

Key = QtCore.Qt


def collect():
    cases = [(name, value) for name, value in globals().items() if name.startswith("test_")]
    only = re.compile(os.environ.get("STARCELL_TEST_FILTER", ""))
    return [each for each in cases if only.search(each[0])]


def set_up():
    FreeCADGui.activateWorkbench("StarCellWorkbench")
    window.pump()


clean_up = window.close_all


def block_with_bores():
    """Two boxes that overlap, and a cylinder through both."""
    doc = FreeCAD.newDocument("Block")
    doc.UndoMode = 1
    a, b, c = doc.addObject("Part::Box", "Plate"), doc.addObject("Part::Box", "Rib"), doc.addObject("Part::Cylinder", "Bore")
    a.Length, a.Width, a.Height = 60, 40, 10
    b.Length, b.Width, b.Height, b.Placement.Base = 20, 20, 30, Vector(31, 11, 3)
    c.Radius, c.Height, c.Placement.Base = 8, 60, Vector(41, 21, -10)
    doc.recompute()
    window.pump()
    return doc, a, b, c


def test_workbench_is_there(folder):
    commands = FreeCADGui.listCommands()
    for name in ("StarCell_Union", "StarCell_Cut", "StarCell_Intersection"):
        assert name in commands, name
        action = FreeCADGui.Command.get(name).getAction()[0]
        assert not action.icon().isNull() and action.toolTip(), name
    bar = FreeCADGui.getMainWindow().findChild(QtGui.QToolBar, "StarCell")
    assert bar and bar.isVisible() and len([each for each in bar.actions() if each.text()]) == 3
    assert not FreeCADGui.Command.get("StarCell_Cut").isActive()


def test_command_needs_two_objects(folder):
    doc, a, b, c = block_with_bores()
    command = FreeCADGui.Command.get("StarCell_Cut")
    for objects, wanted in (([], False), ([a], False), ([a, b], True), ([a, b, c], True)):
        window.select(*objects)
        assert command.isActive() == wanted, objects


def test_cut_of_a_union(folder):
    doc, a, b, c = block_with_bores()
    window.select(a, b)
    FreeCADGui.runCommand("StarCell_Union")
    window.pump()
    union = doc.ActiveObject
    assert union.isValid() and union.Verdict == "exact", union.getStatusString()
    # 60*40*10 + 20*20*30 - 20*20*7
    assert abs(union.Volume.Value - 33200) < 0.1, union.Volume
    assert not a.ViewObject.Visibility and union.ViewObject.Visibility
    assert union.ViewObject.claimChildren() == [a, b] if hasattr(union.ViewObject, "claimChildren") else True
    window.select(union, c)
    FreeCADGui.runCommand("StarCell_Cut")
    window.pump()
    cut = doc.ActiveObject
    assert cut.isValid() and cut.Base is union and cut.Tools == [c], cut.getStatusString()
    assert list(cut.Genus) == [1] and cut.Components == 1
    window.look(doc)
    window.shot(folder, "cut", doc)
    window.select(cut)
    window.shot(folder, "properties")
    doc.undo()
    assert doc.getObject("Cut") is None and union.ViewObject.Visibility and c.ViewObject.Visibility
    doc.redo()
    assert doc.getObject("Cut").isValid()


def test_selection_order_is_operand_order(folder):
    doc, a, b, c = block_with_bores()
    window.select(c, a)
    FreeCADGui.runCommand("StarCell_Cut")
    assert doc.ActiveObject.Base is c and doc.ActiveObject.Tools == [a]


def test_member_of_a_container_is_taken_where_it_is(folder):
    doc, a, b, c = block_with_bores()
    part = doc.addObject("App::Part", "Part")
    part.addObject(c)
    part.Placement.Base = Vector(-30, 0, 0)
    doc.recompute()
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(doc.Name, a.Name, "Face6")
    FreeCADGui.Selection.addSelection(doc.Name, part.Name, "Bore.Face1")
    FreeCADGui.runCommand("StarCell_Cut")
    cut = doc.ActiveObject
    assert cut.Base is a and cut.Tools == [c], cut.Tools
    assert list(cut.Genus) == [1], cut.getStatusString()


def test_what_is_picked_through_a_link_is_the_link(folder):
    doc, a, b, c = block_with_bores()
    part = doc.addObject("App::Part", "Part")
    part.addObject(c)
    link = doc.addObject("App::Link", "Link")
    link.LinkedObject = part
    link.Placement.Base = Vector(-30, 0, 0)
    doc.recompute()
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.Selection.addSelection(a)
    FreeCADGui.Selection.addSelection(doc.Name, link.Name, "Bore.Face1")
    FreeCADGui.runCommand("StarCell_Cut")
    assert doc.ActiveObject.Tools == [link]
    assert list(doc.ActiveObject.Genus) == [1], doc.ActiveObject.getStatusString()


def test_task_panel(folder):
    doc, a, b, c = block_with_bores()
    cut = scw.make_cut(a, c, error="0.5 mm")
    window.look(doc)
    assert FreeCADGui.getDocument(doc.Name).setEdit(cut.Name)
    window.pump()
    task = current_task(cut)
    assert task.form.operands.count() == 2 and "Base" in task.form.operands.item(0).text()
    assert task.form.verdict.text() == cut.Verdict
    assert (task.form.error.text(), task.form.contact.text()) == ("0.5 mm", "")
    window.shot(folder, "task-panel", doc)

    coarse = cut.Triangles
    task.form.error.setText("20 um")
    window.click(task.form.apply)
    window.pump()
    assert FreeCADGui.Control.activeDialog() and cut.Triangles > coarse and cut.ErrorBound.Value <= 0.02
    assert task.form.triangles.text() == str(cut.Triangles)
    fine = cut.Triangles

    task.form.error.setText("a bit")
    window.click(task.form.apply)
    assert "no length" in task.form.problem.text() and cut.Error.Value == 0.02

    task.form.error.setText("1 mm")
    window.click(window.panel_button(QtGui.QDialogButtonBox.Cancel))
    window.pump()
    assert not FreeCADGui.Control.activeDialog()
    assert cut.Error.Value == 0.02 and cut.Triangles == fine, "Cancel keeps what was applied"


def test_task_panel_adds_and_removes_operands(folder):
    doc, a, b, c = block_with_bores()
    union = scw.make_union([a, b])
    FreeCADGui.getDocument(doc.Name).setEdit(union.Name)
    task = current_task(union)
    window.select(c, union)
    window.click(task.form.addOperands)
    assert task.form.operands.count() == 3 and "depends" in task.form.problem.text()
    window.click(window.panel_button(QtGui.QDialogButtonBox.Ok))
    window.pump()
    assert not FreeCADGui.Control.activeDialog()
    assert union.Operands == [a, b, c] and union.isValid()


def test_reordered_operands_change_roles(folder):
    doc, a, b, c = block_with_bores()
    cut = scw.make_cut(a, [b, c])
    FreeCADGui.getDocument(doc.Name).setEdit(cut.Name)
    task = current_task(cut)
    rows = task.form.operands
    rows.insertItem(0, rows.takeItem(1))  # what a drag does
    window.pump()
    assert [rows.item(i).text() for i in range(3)] == ["Rib   (Base)", "Plate   (Tools)", "Bore   (Tools)"]
    window.click(task.form.apply)
    assert cut.Base is b and cut.Tools == [a, c] and cut.isValid()
    rows.item(2).setSelected(True)
    window.click(task.form.removeOperands)
    window.click(window.panel_button(QtGui.QDialogButtonBox.Ok))
    window.pump()
    assert cut.Tools == [a] and cut.isValid()
    # 20*20*30 - 20*20*7
    assert abs(cut.Volume.Value - 9200) < 0.1
    doc.undo()
    assert cut.Tools == [a, c]


def test_failed_apply_keeps_mesh_and_says_why(folder):
    doc, a, b, c = block_with_bores()
    union = scw.make_union([a, b])
    before = (union.Triangles, union.Mesh.CountFacets)
    sketch = doc.addObject("Part::Plane", "Sheet")
    doc.recompute()
    FreeCADGui.getDocument(doc.Name).setEdit(union.Name)
    task = current_task(union)
    window.select(sketch)
    window.click(task.form.addOperands)
    window.click(window.panel_button(QtGui.QDialogButtonBox.Ok))
    window.pump()
    assert FreeCADGui.Control.activeDialog(), "a panel whose OK failed stays open"
    assert "Sheet" in task.form.problem.text() and task.form.problem.isVisible()
    assert not union.isValid() and (union.Triangles, union.Mesh.CountFacets) == before
    window.look(doc)
    window.shot(folder, "failed", doc)
    window.click(window.panel_button(QtGui.QDialogButtonBox.Cancel))
    window.pump()
    assert union.Operands == [a, b] and not FreeCADGui.Control.activeDialog()


class Patient(OperationFeature):
    """Computes for a minute unless it is told to stop; or does not even listen."""
    command = "StarCell_Union"
    roles = (Role("Operands", "", least=1),)
    deaf = False

    def compute(self, starcell, solids, values, options):
        start = time.monotonic()
        while time.monotonic() - start < 60:
            time.sleep(0.02)
            if not options["progress"]((time.monotonic() - start) / 60, "waiting") and not self.deaf:
                raise RuntimeError("stopped")
        return starcell.evaluate(starcell.union(solids["Operands"]), error=options["error"])


class Deaf(Patient):
    deaf = True


def cancel_after(press, doc, folder=None):
    """Recomputes; `press` acts on the dialog after a second. Returns seconds from there to the end of the recompute."""
    pressed = []

    def act():
        dialog = window.progress_dialog()
        if not dialog:
            return
        if folder:
            window.shot(folder, "progress")
        pressed.append(time.monotonic())
        press(dialog)

    window.later(1200, act)
    doc.recompute()
    ended = time.monotonic()
    assert pressed, "the dialog never came up"
    window.pump()
    assert window.progress_dialog() is None
    return ended - pressed[0]


def patient(kind):
    doc, a, b, c = block_with_bores()
    obj = scw.make_union([a, b])
    kind(obj)
    obj.touch()
    return doc, obj, obj.Mesh.CountFacets


def test_escape_stops_within_a_second(folder):
    doc, obj, facets = patient(Patient)
    seconds = cancel_after(lambda dialog: window.press(dialog, Key.Key_Escape), doc, folder)
    assert seconds < 1, seconds
    assert not obj.isValid() and "cancelled" in obj.getStatusString() and obj.Mesh.CountFacets == facets


def test_escape_in_the_main_window_counts_too(folder):
    doc, obj, facets = patient(Patient)
    assert cancel_after(lambda dialog: window.press(FreeCADGui.getMainWindow(), Key.Key_Escape), doc) < 1
    assert not obj.isValid() and obj.Mesh.CountFacets == facets


def test_cancel_button_stops(folder):
    doc, obj, facets = patient(Patient)
    assert cancel_after(lambda dialog: window.click(dialog.findChild(QtGui.QPushButton)), doc) < 1
    assert not obj.isValid() and obj.Mesh.CountFacets == facets


def test_work_that_does_not_listen_is_left_behind(folder):
    doc, obj, facets = patient(Deaf)
    assert cancel_after(lambda dialog: window.press(dialog, Key.Key_Escape), doc) < 1
    assert not obj.isValid() and obj.Mesh.CountFacets == facets


def test_no_second_run_inside_a_run(folder):
    doc, obj, facets = patient(Patient)
    second = FreeCAD.newDocument("Second")
    x, y = second.addObject("Part::Box", "X"), second.addObject("Part::Box", "Y")
    y.Placement.Base = Vector(5, 5, 5)
    made = []
    window.later(700, lambda: made.append(scw.make_union([x, y])))
    cancel_after(lambda dialog: window.press(dialog, Key.Key_Escape), doc)
    assert made and not made[0].isValid() and "already" in made[0].getStatusString()
    second.recompute()
    assert made[0].isValid()


def test_engine_stops_within_a_second(folder):
    """A real run that takes long: balls at an error far below what a screen shows."""
    doc = FreeCAD.newDocument("Long")
    balls = []
    for index in range(4):
        ball = doc.addObject("Part::Sphere", "Ball")
        ball.Radius, ball.Placement.Base = 10, Vector(7 * index, 3 * (index % 2), 0)
        balls.append(ball)
    doc.recompute()
    obj = scw.make_union(balls, error=1)
    assert obj.isValid(), obj.getStatusString()
    facets = obj.Mesh.CountFacets
    obj.Error = 0.0005
    seconds = cancel_after(lambda dialog: window.press(dialog, Key.Key_Escape), doc)
    assert seconds < 1, seconds
    assert not obj.isValid() and obj.Mesh.CountFacets == facets


def test_unresolved_is_flagged(folder):
    class Unresolved(Union):
        """The real mesh, with a certificate that says that something is open."""

        def compute(self, starcell, solids, values, options):
            from types import SimpleNamespace

            result = super().compute(starcell, solids, values, options)
            names = ("error_bound", "requested_error", "contact_tolerance", "components", "genus", "euler_characteristic", "tessellated",
                     "contacts", "statistics")
            fields = {name: getattr(result.certificate, name) for name in names}
            certificate = SimpleNamespace(verdict="unresolved", unresolved=[((0, 0, 0), (1, 1, 1))] * 5, **fields)
            return SimpleNamespace(vertices=result.vertices, triangles=result.triangles, certificate=certificate)

    doc, a, b, c = block_with_bores()
    obj = scw.make_union([a, b])
    plain = obj.ViewObject.ShapeColor
    Unresolved(obj)
    obj.touch()
    doc.recompute()
    assert obj.isValid() and obj.Verdict == "unresolved" and "(5)" in obj.Report
    window.pump()
    assert "unresolved places: 5" in window.report_text(), window.report_text()
    assert obj.ViewObject.ShapeColor[:2] == (1.0, 0.6000000238418579), obj.ViewObject.ShapeColor
    assert obj.ViewObject.Proxy.getIcon().endswith("Unresolved.svg")
    window.look(doc)
    window.shot(folder, "unresolved", doc)
    Union(obj)
    obj.touch()
    doc.recompute()
    assert obj.Verdict == "exact" and obj.ViewObject.ShapeColor == plain


def test_deleting_shows_the_operands_again(folder):
    doc, a, b, c = block_with_bores()
    union = scw.make_union([a, b])
    window.select(union)
    FreeCADGui.runCommand("Std_Delete")
    window.pump()
    assert doc.getObject(union.Name) is None if union in doc.Objects else True
    assert a.ViewObject.Visibility and b.ViewObject.Visibility


def test_saved_document_opens_as_it_was(folder):
    doc, a, b, c = block_with_bores()
    scw.make_cut(scw.make_union([a, b]), c)
    volume = doc.Cut.Volume.Value
    with tempfile.TemporaryDirectory() as place:
        path = os.path.join(place, "block.FCStd")
        doc.saveAs(path)
        FreeCAD.closeDocument(doc.Name)
        doc = FreeCAD.openDocument(path)
    assert doc.Cut.Volume.Value == volume and doc.Cut.isValid()
    assert type(doc.Cut.ViewObject.Proxy).__name__ == "OperationView"
    assert not doc.Union.ViewObject.Visibility
    doc.Bore.Radius = 5
    doc.recompute()
    assert doc.Cut.isValid() and doc.Cut.Volume.Value > volume
    assert FreeCADGui.getDocument(doc.Name).setEdit("Cut")
    window.look(doc)
    window.shot(folder, "reopened", doc)


def test_preferences_page(folder):
    window.later(1500, lambda: shoot_preferences(folder))
    FreeCADGui.showPreferences("StarCell", 0)


def shoot_preferences(folder):
    dialog = QtGui.QApplication.activeModalWidget()
    window.shot(folder, "preferences")
    found = dialog.findChild(QtGui.QSpinBox, "divisor")
    dialog.reject()
    assert found and found.value() == 128


def current_task(obj):
    """The open panel of `obj`."""
    task = obj.ViewObject.Proxy.task
    assert task and task.obj is obj
    return task
