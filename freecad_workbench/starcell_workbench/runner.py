"""Runs the engine so that FreeCAD stays alive: a worker thread, a progress dialog, ESC.

The engine releases the GIL and asks `progress` often whether to go on. If it does not answer a cancel in time (a CAD import
has no such question), the worker is left to end by itself and its result is thrown away: ESC always takes less than a second.
Without a GUI, or outside its thread, the work runs directly.
"""
import threading

import FreeCAD

from .translation import translate

QUIET_SECONDS = 0.3   # a run shorter than this shows no dialog
PATIENCE_SECONDS = 0.6  # how long a cancelled worker may take to stop


class Cancelled(RuntimeError):
    """The user stopped the run."""


class Busy(RuntimeError):
    """A run was started from within another one's dialog."""


class _Job(threading.Thread):
    """The work, its progress as the dialog reads it, and its outcome."""

    def __init__(self, work):
        super().__init__(name="StarCell", daemon=True)
        self.work = work
        self.fraction, self.stage = 0.0, ""
        self.cancelled = threading.Event()
        self.result = self.problem = None

    def run(self):
        try:
            self.result = self.work(self.progress)
        except BaseException as problem:
            self.problem = problem

    def progress(self, fraction, stage):
        self.fraction, self.stage = fraction, stage
        return not self.cancelled.is_set()

    def outcome(self):
        if self.cancelled.is_set():
            raise Cancelled(translate("StarCell", "The run was cancelled; the previous result is kept."))
        if self.problem:
            raise self.problem
        return self.result


_current = None
last_was_cancelled = False  # by the user; of the last run that began


def run(work, title):
    """work(progress) -> result, with progress(fraction, stage) -> bool: False means stop. Raises what work raises, or Cancelled."""
    global _current, last_was_cancelled
    if not FreeCAD.GuiUp or threading.current_thread() is not threading.main_thread():
        return work(lambda fraction, stage: True)
    if _current:
        raise Busy(translate("StarCell", "StarCell is already computing; wait for it, or cancel it."))
    _current, last_was_cancelled = _Job(work), False
    try:
        _current.start()
        _current.join(QUIET_SECONDS)
        if _current.is_alive():
            from . import progress_dialog

            progress_dialog.wait(_current, title, PATIENCE_SECONDS)
        last_was_cancelled = _current.cancelled.is_set()
        return _current.outcome()
    finally:
        _current = None
