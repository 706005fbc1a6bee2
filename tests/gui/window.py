"""Hands and eyes of the tests in FreeCAD's window: let it live, press keys, click, take pictures.

Pictures go to the folder in STARCELL_SHOTS, or to build/shots in the checkout.
"""
import os
import sys
import time
import unittest

import FreeCAD
import FreeCADGui
from FreeCAD import Vector
from PySide import QtCore, QtGui

# FreeCAD's own commands run Python text in __main__ and expect these names there; a runner may have put another module in its place.
vars(sys.modules["__main__"]).update(FreeCAD=FreeCAD, App=FreeCAD, FreeCADGui=FreeCADGui, Gui=FreeCADGui)

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SHOTS = os.environ.get("STARCELL_SHOTS") or os.path.join(ROOT, "build", "shots")


class WindowTest(unittest.TestCase):
    """The workbench is active and no document is open; both hold again afterwards."""

    def setUp(self):
        FreeCADGui.activateWorkbench("StarCellWorkbench")
        pump()

    def tearDown(self):
        while FreeCADGui.Control.activeDialog():
            FreeCADGui.Control.closeDialog()
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)
        pump(0.1)


def block_with_bore():
    """A document with a plate, a rib that stands in it, and a bore through both."""
    doc = FreeCAD.newDocument("Block")
    doc.UndoMode = 1
    plate, rib, bore = doc.addObject("Part::Box", "Plate"), doc.addObject("Part::Box", "Rib"), doc.addObject("Part::Cylinder", "Bore")
    plate.Length, plate.Width, plate.Height = 60, 40, 10
    rib.Length, rib.Width, rib.Height, rib.Placement.Base = 20, 20, 30, Vector(31, 11, 3)
    bore.Radius, bore.Height, bore.Placement.Base = 8, 60, Vector(41, 21, -10)
    doc.recompute()
    pump()
    return doc, plate, rib, bore


def pump(seconds=0.2):
    """Lets the window live for a while."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        QtGui.QApplication.processEvents(QtCore.QEventLoop.AllEvents, 20)
        time.sleep(0.005)


def later(milliseconds, action):
    QtCore.QTimer.singleShot(milliseconds, action)


def shot(name, doc=None):
    """window-<name>.png of the whole window, and view-<name>.png of the 3D view if a document is given."""
    os.makedirs(SHOTS, exist_ok=True)
    pump(0.5)
    screen = QtGui.QApplication.primaryScreen().grabWindow(0)
    if not screen.save(os.path.join(SHOTS, "window-{}.png".format(name))):
        raise OSError("cannot save a picture in {}".format(SHOTS))
    if doc:
        view = FreeCADGui.getDocument(doc.Name).ActiveView
        view.saveImage(os.path.join(SHOTS, "view-{}.png".format(name)), 1000, 800, "White")


def look(doc):
    """From a corner that lights every side differently, everything in view, nothing selected."""
    FreeCADGui.Selection.clearSelection()
    view = FreeCADGui.getDocument(doc.Name).ActiveView
    view.setAnimationEnabled(False)
    view.setCameraOrientation(FreeCAD.Rotation(28, 0, 58))
    view.fitAll()
    pump()


def select(*objects):
    """Objects, or (object, sub-object path) as a pick in the 3D view gives them."""
    FreeCADGui.Selection.clearSelection()
    for each in objects:
        obj, path = each if isinstance(each, tuple) else (each, "")
        FreeCADGui.Selection.addSelection(obj.Document.Name, obj.Name, path)
    pump()


def press(widget, key):
    """A key as the application sees it: through every event filter."""
    for kind in (QtCore.QEvent.KeyPress, QtCore.QEvent.KeyRelease):
        QtGui.QApplication.sendEvent(widget, QtGui.QKeyEvent(kind, key, QtCore.Qt.NoModifier))


def click(widget):
    """A click in the middle of a widget, likewise."""
    centre = QtCore.QPointF(widget.rect().center())
    for kind, buttons in ((QtCore.QEvent.MouseButtonPress, QtCore.Qt.LeftButton), (QtCore.QEvent.MouseButtonRelease, QtCore.Qt.NoButton)):
        event = QtGui.QMouseEvent(kind, centre, QtCore.QPointF(widget.mapToGlobal(centre.toPoint())), QtCore.Qt.LeftButton, buttons,
                                  QtCore.Qt.NoModifier)
        QtGui.QApplication.sendEvent(widget, event)


def click_panel(which):
    """A button of the task panel's own box: QDialogButtonBox.Ok or Cancel."""
    click(FreeCADGui.getMainWindow().findChild(QtGui.QDialogButtonBox).button(which))
    pump()


def progress_dialog():
    return next((each for each in QtGui.QApplication.topLevelWidgets() if each.objectName() == "StarCellProgress" and each.isVisible()), None)


def report_text():
    pump()
    return FreeCADGui.getMainWindow().findChild(QtGui.QTextEdit, "Report view").toPlainText()
