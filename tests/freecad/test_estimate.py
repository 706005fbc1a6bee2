"""Estimates of what a run costs: the arithmetic, and how near they come."""
import threading
import time

from support import DocumentTest

import starcell_workbench as scw
from starcell_workbench import estimate
from starcell_workbench.estimate import Trial, extrapolate


class Arithmetic(DocumentTest):
    def test_a_square_root_is_continued(self):
        guess = extrapolate([Trial(64, 0.25, 100), Trial(16, 0.5, 200)], 0.1)
        self.assertAlmostEqual(guess.seconds, 2)
        self.assertAlmostEqual(guess.triangles, 800)

    def test_what_stays_as_it_is_stays(self):
        guess = extrapolate([Trial(16, 0.1, 12), Trial(8, 0.1, 12)], 0.1)
        self.assertEqual((guess.seconds, guess.triangles), (0.1, 12))
        self.assertIn("less than a second", guess.in_words())

    def test_a_jump_is_not_continued(self):
        guess = extrapolate([Trial(16, 0.001, 10), Trial(8, 1, 10000)], 0.1)
        self.assertLess(guess.seconds, 8 ** 0.75)

    def test_without_a_trial_there_is_a_least_time(self):
        self.assertIn("more than 10 s", extrapolate([], 0.1).in_words())

    def test_nothing_is_no_trouble(self):
        self.assertIn("0 triangles", extrapolate([Trial(16, 0.01, 0), Trial(8, 0.01, 0)], 0.1).in_words())


class Trials(DocumentTest):
    def estimator(self, obj, **changed):
        links = {role.name: obj.Proxy.linked_by(obj, role) for role in obj.Proxy.roles}
        return estimate.start(obj.Proxy, obj, links, dict(obj.Proxy.chosen(obj), **changed))

    def box(self):
        box = self.doc.addObject("Part::Box", "A")
        box.Length, box.Width, box.Height = 10, 8, 6
        self.doc.recompute()
        return box

    def test_near_the_truth_where_edges_are_rounded(self):
        obj = scw.make_offset(self.box(), 1, error=0.5)
        work = self.estimator(obj, Error=0.01)
        work.join(60)
        guess = extrapolate(work._trials(), 0.01)
        obj.Error = 0.01
        self.doc.recompute()
        self.assertGreater(guess.triangles, obj.Triangles / 3)
        self.assertLess(guess.triangles, obj.Triangles * 3)

    def test_follows_the_values_given_and_leaves_the_object_alone(self):
        obj = scw.make_offset(self.box(), 1, error=0.5)
        before = obj.Triangles
        work = self.estimator(obj, Distance=-1.0)
        work.join(60)
        self.assertIn("about 12 triangles", work.words)
        self.assertEqual((obj.Triangles, obj.Distance.Value), (before, 1))
        self.assertNotIn("Touched", obj.State)

    def test_stops_within_a_second(self):
        obj = scw.make_offset(self.box(), 1, error=0.5)
        work = self.estimator(obj, Error=1e-4)
        time.sleep(0.2)
        start = time.monotonic()
        work.stop()
        work.join(10)
        self.assertLess(time.monotonic() - start, 2)  # alone it takes less than one
        self.assertEqual([each for each in threading.enumerate() if each is work], [])

    def test_says_why_there_is_none(self):
        obj = scw.make_shell(self.box(), -1, error=0.5)
        work = self.estimator(obj, OpenFaces=["Face9"])
        work.join(60)
        self.assertIn("Face9", work.words)
