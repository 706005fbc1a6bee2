"""The dialog of a long run: progress, and a way out by its button or by ESC."""
import time

import FreeCADGui
from PySide import QtCore, QtGui

from .translation import translate

POLL_MILLISECONDS = 50


class _Keys(QtCore.QObject):
    """Sees every event before FreeCAD's own filters do.

    While a document recomputes, FreeCAD's progress bar swallows keys and clicks; the dialog needs ESC and its button.
    """

    def __init__(self, dialog, cancel):
        super().__init__(dialog)
        self.dialog, self.cancel = dialog, cancel

    def eventFilter(self, receiver, event):
        kind = event.type()
        if kind in (QtCore.QEvent.KeyPress, QtCore.QEvent.ShortcutOverride) and event.key() == QtCore.Qt.Key_Escape:
            self.cancel()
            return True
        if kind == QtCore.QEvent.MouseButtonPress and isinstance(receiver, QtGui.QPushButton) and receiver.window() is self.dialog:
            self.cancel()
            return True
        return False


def wait(job, title, patience):
    """Returns when the job has ended, or `patience` seconds after the user cancelled it."""
    dialog = QtGui.QProgressDialog(title, translate("StarCell", "Cancel"), 0, 1000, FreeCADGui.getMainWindow())
    dialog.setObjectName("StarCellProgress")
    dialog.setWindowTitle("StarCell")
    dialog.setWindowModality(QtCore.Qt.ApplicationModal)
    dialog.setMinimumDuration(0)
    dialog.setMinimumWidth(360)
    dialog.setAutoClose(False)
    dialog.setAutoReset(False)
    dialog.canceled.connect(job.cancelled.set)
    loop = QtCore.QEventLoop()
    deadline = []

    def poll():
        if not job.is_alive():
            loop.quit()
        elif not job.cancelled.is_set():
            dialog.setValue(max(0, min(1000, int(1000 * job.fraction))))
            dialog.setLabelText("{}\n{}".format(title, job.stage))
        elif not deadline:
            deadline.append(time.monotonic() + patience)
        elif time.monotonic() > deadline[0]:
            loop.quit()

    timer = QtCore.QTimer(dialog)
    timer.timeout.connect(poll)
    timer.start(POLL_MILLISECONDS)
    keys = _Keys(dialog, job.cancelled.set)
    application = QtCore.QCoreApplication.instance()
    application.installEventFilter(keys)
    try:
        dialog.show()
        loop.exec_()
    finally:
        application.removeEventFilter(keys)
        timer.stop()
        dialog.canceled.disconnect(job.cancelled.set)
        dialog.close()
        dialog.deleteLater()
