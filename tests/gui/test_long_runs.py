"""Long runs: the window lives, and ESC works within a second, whatever the work does."""
import time

import FreeCAD
import FreeCADGui
import window
from FreeCAD import Vector
from PySide import QtCore, QtGui

import starcell_workbench as scw
from starcell_workbench.boolean_feature import Union

ESCAPE = QtCore.Qt.Key_Escape


class Patient(Union):
    """Would compute for a minute, but listens."""
    deaf = False

    def compute(self, starcell, solids, values, options):
        start = time.monotonic()
        while time.monotonic() - start < 60:
            time.sleep(0.02)
            if not options["progress"]((time.monotonic() - start) / 60, "waiting") and not self.deaf:
                raise RuntimeError("stopped")
        return super().compute(starcell, solids, values, options)


class Deaf(Patient):
    """Would compute for a minute, and does not listen."""
    deaf = True


class LongRuns(window.WindowTest):
    def prepare(self, kind):
        """A computed union that will be computed by `kind` from now on."""
        self.doc, plate, rib, bore = window.block_with_bore()
        self.obj = scw.make_union([plate, rib])
        self.facets = self.obj.Mesh.CountFacets
        kind(self.obj)
        self.obj.touch()

    def cancel_by(self, action):
        """Recomputes, lets `action` act on the dialog after a second, and checks how soon it ends and what it leaves."""
        acted = []

        def act():
            dialog = window.progress_dialog()
            if dialog:
                acted.append(time.monotonic())
                action(dialog)

        window.later(1200, act)
        self.doc.recompute()
        ended = time.monotonic()
        self.assertTrue(acted, "the dialog never came up")
        self.assertLess(ended - acted[0], 1)
        window.pump()
        self.assertIsNone(window.progress_dialog())
        self.assertFalse(self.obj.isValid())
        self.assertIn("cancelled", self.obj.getStatusString())
        self.assertEqual(self.obj.Mesh.CountFacets, self.facets)

    def test_escape(self):
        self.prepare(Patient)
        self.cancel_by(lambda dialog: window.press(dialog, ESCAPE))

    def test_escape_in_the_main_window(self):
        self.prepare(Patient)
        self.cancel_by(lambda dialog: window.press(FreeCADGui.getMainWindow(), ESCAPE))

    def test_cancel_button(self):
        self.prepare(Patient)
        self.cancel_by(lambda dialog: window.click(dialog.findChild(QtGui.QPushButton)))

    def test_work_that_does_not_listen_is_left_behind(self):
        self.prepare(Deaf)
        self.cancel_by(lambda dialog: window.press(dialog, ESCAPE))

    def test_the_engine_itself(self):
        # Two balls, at an error far below what a screen shows.
        self.doc = FreeCAD.newDocument("Long")
        balls = []
        for index in range(2):
            ball = self.doc.addObject("Part::Sphere", "Ball")
            ball.Radius, ball.Placement.Base = 10, Vector(7.3 * index, 3.1 * index, 1.7 * index)
            balls.append(ball)
        self.obj = scw.make_union(balls, error=1)
        self.assertTrue(self.obj.isValid(), self.obj.getStatusString())
        self.facets = self.obj.Mesh.CountFacets
        self.obj.Error = 0.003
        self.cancel_by(lambda dialog: window.press(dialog, ESCAPE))

    def test_dialog_shows_progress(self):
        self.prepare(Patient)
        seen = []
        window.later(900, lambda: (window.shot("progress"), seen.append(window.progress_dialog().value())))
        self.cancel_by(lambda dialog: window.later(500, lambda: window.press(dialog, ESCAPE)))
        self.assertGreater(seen[0], 0)

    def test_cancelled_command_leaves_nothing_behind(self):
        doc, plate, rib, bore = window.block_with_bore()
        compute, Union.compute = Union.compute, Patient.compute
        Union.deaf = False
        try:
            window.select(plate, rib)
            window.later(1200, lambda: window.press(window.progress_dialog(), ESCAPE))
            FreeCADGui.runCommand("StarCell_Union")
        finally:
            Union.compute = compute
            del Union.deaf
        window.pump()
        self.assertEqual(doc.Objects, [plate, rib, bore])
        self.assertTrue(plate.ViewObject.Visibility)

    def test_no_second_run_inside_a_run(self):
        self.prepare(Patient)
        second = FreeCAD.newDocument("Second")
        x, y = second.addObject("Part::Box", "X"), second.addObject("Part::Box", "Y")
        y.Placement.Base = Vector(5, 5, 5)
        made = []
        window.later(700, lambda: made.append(scw.make_union([x, y])))
        self.cancel_by(lambda dialog: window.press(dialog, ESCAPE))
        self.assertFalse(made[0].isValid())
        self.assertIn("already", made[0].getStatusString())
        second.recompute()
        self.assertTrue(made[0].isValid())
