"""Long runs: what a progress callback sees, and how a run is stopped by it, by an exception, and by Ctrl-C."""
import os
import signal
import threading
import time
import unittest

import starcell as sc

from models import rotation, sphere_mesh

BALL = sc.Polyhedron(*sphere_mesh(5))  # 8,192 triangles
SMALL = sc.Box((0, 0, 0), (1, 1, 1)) | sc.Box((0.5, 0.5, 0.5), (2, 2, 2))


def long_work():
    """Seconds of work at an error far below what is asked of real parts."""
    return BALL - sc.union([BALL.transformed(rotation((1, 2, k), 0.1 * k)) for k in range(1, 4)])


class Progress(unittest.TestCase):
    def test_fractions_rise_within_the_unit_interval(self):
        seen = []
        sc.evaluate(SMALL, error=0.01, progress=lambda fraction, stage: seen.append((fraction, stage)))
        self.assertTrue(seen)
        self.assertTrue(all(0 <= fraction <= 1 and stage and isinstance(stage, str) for fraction, stage in seen))
        self.assertEqual([f for f, _ in seen], sorted(f for f, _ in seen))

    def test_is_called_on_the_thread_that_asked(self):
        threads = set()
        sc.evaluate(SMALL, error=0.01, progress=lambda *_: threads.add(threading.get_ident()))
        self.assertEqual(threads, {threading.get_ident()})

    def test_does_not_change_the_result(self):
        plain, watched = sc.evaluate(SMALL, error=0.01), sc.evaluate(SMALL, error=0.01, progress=lambda *_: True)
        self.assertEqual(plain.vertices.tobytes(), watched.vertices.tobytes())

    def test_false_cancels_even_the_shortest_run(self):
        with self.assertRaises(sc.CancelledError):
            sc.evaluate(SMALL, error=0.05, progress=lambda *_: False)

    def test_false_stops_a_long_run_within_a_second(self):
        stopped = []

        def stop(fraction, stage):
            if time.monotonic() - start < 0.3:
                return True
            stopped.append(time.monotonic())
            return False

        start = time.monotonic()
        with self.assertRaises(sc.CancelledError):
            sc.evaluate(long_work(), error=2e-4, progress=stop)
        self.assertLess(time.monotonic() - stopped[0], 1)

    def test_an_exception_of_the_callback_comes_out(self):
        def fail(fraction, stage):
            raise KeyError("mine")
        with self.assertRaisesRegex(KeyError, "mine"):
            sc.evaluate(SMALL, error=0.05, progress=fail)

    def test_an_exception_later_in_the_run_comes_out(self):
        def fail(fraction, stage):
            if stage != "start":
                raise LookupError(stage)
        with self.assertRaises(LookupError):
            sc.evaluate(SMALL, error=0.01, progress=fail)

    def test_python_runs_meanwhile(self):
        ticks, done = [], threading.Event()

        def tick():
            while not done.wait(0.01):
                ticks.append(time.monotonic())
        ticker = threading.Thread(target=tick)
        ticker.start()
        start = time.monotonic()
        try:
            sc.evaluate(long_work(), error=1e-3, budget=sc.Budget(max_seconds=1))
        finally:
            took = time.monotonic() - start
            done.set()
            ticker.join()
        self.assertGreater(len(ticks), took / 0.01 / 10)  # a tenth of the rate that an idle interpreter gives


class ControlC(unittest.TestCase):
    def test_stops_a_run_without_callback_within_a_second(self):
        sent = []

        def interrupt():
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)
        # FreeCAD and test runners may have another handler: this is Python's own.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        timer = threading.Timer(0.3, interrupt)
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                sc.evaluate(long_work(), error=2e-4)
            self.assertLess(time.monotonic() - sent[0], 1)
        finally:
            timer.cancel()
            signal.signal(signal.SIGINT, before)


if __name__ == "__main__":
    unittest.main()
