"""What a run will cost: trials at coarser errors, in the background, and what they say of the error asked for.

Seconds and triangles grow like a power of 1 / error: none for flat solids, 1/2 for rounded edges, 1 for what bends both ways. What
the last two trials that ended say is averaged with the 1/2, as coarse meshes jump about; over parts from the tests that came within a
factor of three. A guess, no promise: walls near a critical width cost more at any error than trials show.
"""
import math
import tempfile
import threading
import time
from dataclasses import dataclass

from . import lengths
from .translation import translate

COARSER = (32, 16, 8, 4)   # errors of the trials, as multiples of the one asked for
TRIAL_SECONDS = 2.5        # no trial may take longer
ENOUGH_SECONDS = 0.6       # after one that took this, none that is finer
LARGEST_POWER = 0.7
USUAL_POWER = 0.5


@dataclass
class Trial:
    coarser: float
    seconds: float
    triangles: int


@dataclass
class Estimate:
    seconds: float
    triangles: float
    error: float
    at_least: bool = False  # no trial ended in time

    def in_words(self):
        seconds = translate("StarCell", "less than a second") if self.seconds < 1 else translate("StarCell", "about {} s").format(_rounded(self.seconds))
        if self.at_least:
            return translate("StarCell", "Estimate: more than {} s, at an error of {}.").format(_rounded(self.seconds), lengths.show(self.error))
        return translate("StarCell", "Estimate: {}, about {} triangles, at an error of {}.").format(
            seconds, _rounded(self.triangles), lengths.show(self.error))


def extrapolate(trials, error):
    """The Estimate for trials that ended, coarsest first; none of them: at least what a trial was given."""
    if not trials:
        return Estimate(4 * TRIAL_SECONDS, 0, error, at_least=True)
    last = trials[-1]
    return Estimate(last.seconds * last.coarser ** _power(trials, lambda trial: trial.seconds),
                    last.triangles * last.coarser ** _power(trials, lambda trial: trial.triangles), error)


def _power(trials, measure):
    if len(trials) < 2 or not measure(trials[-2]) or not measure(trials[-1]):
        return USUAL_POWER
    before, last = trials[-2:]
    power = math.log(measure(last) / measure(before)) / math.log(before.coarser / last.coarser)
    return min(0.5 * (power + USUAL_POWER), LARGEST_POWER) if power > 0 else 0.0


def _rounded(value):
    """To two digits: nobody should read more into it."""
    digits = 1 - math.floor(math.log10(value)) if value > 0 else 0
    return "{:,.0f}".format(round(value, digits)) if value >= 10 else "{:.2g}".format(value)


class Estimator(threading.Thread):
    """The trials of one call. Reads nothing of FreeCAD; the panel polls `words`, and calls stop() when it wants another."""

    def __init__(self, starcell, folder, work, error):
        """folder: a TemporaryDirectory that work needs, cleaned up at the end. work, error: what OperationFeature.prepare() returns."""
        super().__init__(name="StarCell estimate", daemon=True)
        self.starcell, self.folder, self.work, self.error = starcell, folder, work, error
        self.stopped = threading.Event()
        self.words = ""

    def stop(self):
        self.stopped.set()

    def run(self):
        with self.folder:
            try:
                trials = self._trials()
            except Exception as problem:  # whatever the run itself would say
                self.words = translate("StarCell", "No estimate: {}").format(problem)
                return
            if not self.stopped.is_set():
                self.words = extrapolate(trials, self.error).in_words()

    def _trials(self):
        trials = []
        for coarser in COARSER:
            start = time.monotonic()
            result = self.work(lambda fraction, stage: not self.stopped.is_set(), coarser=coarser,
                               budget=self.starcell.Budget(max_seconds=TRIAL_SECONDS))
            seconds = time.monotonic() - start
            if result.certificate.verdict == "unresolved":
                break
            trials.append(Trial(coarser, seconds, len(result.triangles)))
            if seconds > ENOUGH_SECONDS:
                break
        return trials


def start(feature, obj, links, chosen):
    """An Estimator at work, for the panel's links and values. Raises what gathering the operands raises."""
    from . import engine

    starcell = engine.load()
    folder = tempfile.TemporaryDirectory(prefix="starcell-estimate-")
    try:
        work, error = feature.prepare(obj, starcell, links, chosen, folder.name)
    except Exception:
        folder.cleanup()
        raise
    estimator = Estimator(starcell, folder, work, error)
    estimator.start()
    return estimator
