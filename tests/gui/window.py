"""Hands and eyes of the GUI tests: let the window live, press keys, take pictures."""
import os
import time

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui


def pump(seconds=0.2):
    """Lets the window live for a while."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        QtGui.QApplication.processEvents(QtCore.QEventLoop.AllEvents, 20)
        time.sleep(0.005)


def shot(folder, name, doc=None):
    """window-<name>.png of the whole window, and view-<name>.png of the 3D view if a document is given."""
    pump(0.5)
    screen = QtGui.QApplication.primaryScreen().grabWindow(0)
    assert screen.save(os.path.join(folder, "window-{}.png".format(name)))
    if doc:
        view = FreeCADGui.getDocument(doc.Name).ActiveView
        view.saveImage(os.path.join(folder, "view-{}.png".format(name)), 1000, 800, "White")


def look(doc):
    """From a corner that lights every side differently, everything in view, nothing selected."""
    FreeCADGui.Selection.clearSelection()
    view = FreeCADGui.getDocument(doc.Name).ActiveView
    view.setAnimationEnabled(False)
    view.setCameraOrientation(FreeCAD.Rotation(28, 0, 58))
    view.fitAll()
    pump()


def select(*objects):
    FreeCADGui.Selection.clearSelection()
    for each in objects:
        FreeCADGui.Selection.addSelection(each)
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


def progress_dialog():
    return next((each for each in QtGui.QApplication.topLevelWidgets() if each.objectName() == "StarCellProgress" and each.isVisible()), None)


def later(milliseconds, action):
    QtCore.QTimer.singleShot(milliseconds, action)


def panel_button(which):
    """A button of the task panel's box: Ok, Apply, Cancel."""
    box = FreeCADGui.getMainWindow().findChild(QtGui.QDialogButtonBox)
    return box.button(which)


def report_text():
    return FreeCADGui.getMainWindow().findChild(QtGui.QTextEdit, "Report view").toPlainText()


def close_all():
    while FreeCADGui.Control.activeDialog():
        FreeCADGui.Control.closeDialog()
    for name in list(FreeCAD.listDocuments()):
        FreeCAD.closeDocument(name)
    pump(0.1)
