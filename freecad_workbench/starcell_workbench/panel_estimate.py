"""The panel's line that says what a run would cost: follows what is typed, never in the way of the window or of a run."""
from PySide import QtCore

from . import estimate
from .translation import translate

SETTLE_MS = 500  # how long nothing has to change before trials start
POLL_MS = 100


class PanelEstimate:
    def __init__(self, panel):
        self.panel, self.estimator = panel, None
        self.settle = QtCore.QTimer(panel.form, singleShot=True, interval=SETTLE_MS)
        self.settle.timeout.connect(self.start)
        self.poll = QtCore.QTimer(panel.form, interval=POLL_MS)
        self.poll.timeout.connect(self.look)
        for field in panel.fields.values():
            field.textChanged.connect(self.changed)
        rows = panel.form.operands.model()
        for signal in (rows.rowsInserted, rows.rowsRemoved, rows.rowsMoved):
            signal.connect(self.changed)
        self.changed()

    def changed(self, *_):
        self.stop()
        self.settle.start()

    def start(self):
        """The trials for what the panel says now; what is wrong with it is said by Apply."""
        self.show(translate("StarCell", "Estimate: …"))
        try:
            self.estimator = estimate.start(self.panel.feature, self.panel.obj, self.panel.links(), self.panel.values())
        except Exception:
            self.show("")
            return
        self.poll.start()

    def look(self):
        if self.estimator and not self.estimator.is_alive():
            self.show(self.estimator.words)
            self.poll.stop()

    def stop(self):
        """Without waiting: trials end within a second, but for a CAD import, which is left to end by itself."""
        self.settle.stop()
        self.poll.stop()
        if self.estimator:
            self.estimator.stop()
            self.estimator = None
        self.show("")

    def show(self, words):
        self.panel.form.estimate.setText(words)
