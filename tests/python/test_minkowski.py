"""Minkowski sums, morphology with solids, penetration depth: closed forms, certificates and their files, and what is refused."""
import math
import os
import tempfile
import unittest

import starcell as sc

from models import volume


UNIT = sc.Box((0, 0, 0), (1, 1, 1))
PLATE = sc.evaluate(sc.Box((0, 0, 0), (3, 3, 1)) - sc.Box((1, 1, -1), (2, 2, 2)), error=0.01).as_solid()


class Sums(unittest.TestCase):
    def test_closed_forms(self):
        for r, expected in ((sc.minkowski_sum(UNIT, sc.Box((10, 0, 0), (11, 1, 1)), error=0.05), 8),
                            (sc.dilate(UNIT, sc.Box((10, 0, 0), (11, 2, 3)), error=0.05), 24),
                            (sc.erode(sc.Box((0, 0, 0), (10, 10, 10)), sc.Box((5, 3, -2), (6, 4, -1)), error=0.05), 729)):
            self.assertEqual((r.certificate.verdict, r.certificate.genus), ("exact", [0]))
            self.assertAlmostEqual(volume(r), expected, places=6)

    def test_topology(self):
        for side, genus in ((0.9, [1]), (1.1, [0])):
            self.assertEqual(sc.minkowski_sum(PLATE, sc.Box((0, 0, 0), (side,) * 3), error=0.1).certificate.genus, genus)

    def test_a_ball_is_a_ball_whether_number_or_solid(self):
        a, b = sc.dilate(UNIT, 0.25, error=0.02), sc.dilate(UNIT, sc.Sphere((0, 0, 0), 0.25), error=0.02)
        self.assertEqual(a.certificate.tessellated, [])
        self.assertEqual(b.certificate.tessellated, [])
        self.assertAlmostEqual(volume(a), volume(b), places=9)
        moved = sc.erode(UNIT, sc.Sphere((5, 0, 0), 0.25), error=0.02)
        self.assertAlmostEqual(float(moved.vertices[:, 0].min()), 0.25 - 5, places=3)

    def test_curved_operands_are_named(self):
        r = sc.minkowski_sum(sc.Cylinder((0, 0, 0), (0, 0, 1), 1, 2), UNIT, error=0.1)
        self.assertEqual([name for name, _ in r.certificate.tessellated], ["mesh of the first solid"])
        self.assertLessEqual(r.certificate.error_bound, 0.1)
        expected = 3 * (math.pi + 4 + 1)   # disc and square: area, half the perimeters' product, area
        self.assertAlmostEqual(volume(r), expected, delta=0.1 * 40)

    def test_default_error_follows_the_result(self):
        self.assertEqual(len(sc.minkowski_sum(UNIT, UNIT).triangles), 12)

    def test_opening_and_closing(self):
        part = sc.Box((0, 0, 0), (2, 2, 2)) | sc.Box((2, 0.9, 0.9), (3, 1.1, 1.1))
        self.assertAlmostEqual(volume(sc.opening(part, sc.Box((0, 0, 0), (0.5, 0.5, 0.5)), error=0.05)), 8, delta=0.05 * 24)
        self.assertAlmostEqual(volume(sc.closing(part, sc.Box((0, 0, 0), (0.1, 0.1, 0.1)), error=0.05)), 8.04, delta=0.05 * 25)

    def test_the_certificate_comes_back(self):
        for r in (sc.minkowski_sum(UNIT, PLATE, error=0.1), sc.erode(PLATE, sc.Box((0, 0, 0), (0.2, 0.2, 0.2)), error=0.1)):
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "sum.json")
                r.certificate.save(path)
                report = sc.check_certificate(path)
            self.assertTrue(report.ok, str(report))

    def test_what_is_refused(self):
        for wrong in (0, -1, math.inf, math.nan):
            with self.assertRaisesRegex(ValueError, "element"):
                sc.dilate(UNIT, wrong)
        with self.assertRaises(TypeError):
            sc.minkowski_sum(UNIT, 1.0)
        with self.assertRaises(sc.UnboundedError):
            sc.minkowski_sum(UNIT, sc.HalfSpace((0, 0, 0), (0, 0, 1)))

    def test_nothing_stays_nothing(self):
        r = sc.minkowski_sum(sc.evaluate(UNIT & sc.Box((3, 3, 3), (4, 4, 4)), error=0.1).as_solid(), UNIT, error=0.1)
        self.assertEqual((len(r.triangles), r.certificate.verdict), (0, "exact"))

    def test_cancel(self):
        with self.assertRaises(sc.CancelledError):
            sc.minkowski_sum(PLATE, PLATE, error=0.1, progress=lambda done, stage: False)


class Depth(unittest.TestCase):
    def test_overlap(self):
        d = sc.penetration_depth(UNIT, sc.Box((0.8, 0.1, 0.1), (1.8, 0.9, 0.9)), error=0.01)
        self.assertLessEqual(d.lower, 0.2 + 1e-9)
        self.assertGreaterEqual(d.upper, 0.2 - 1e-9)
        self.assertLessEqual(d.upper - d.lower, 0.01)
        self.assertEqual(d.depth, d.upper)
        self.assertAlmostEqual(d.direction[0], 1, places=6)

    def test_clearance(self):
        d = sc.penetration_depth(UNIT, sc.Box((4, 5, 0), (6, 6, 1)), error=0.01)
        self.assertEqual((d.lower, d.upper, d.direction), (0, 0, (0, 0, 0)))
        self.assertLessEqual(d.separation_lower, 5)
        self.assertGreaterEqual(d.separation_upper, 5)
        self.assertAlmostEqual(d.separation_lower, 5, places=9)

    def test_what_is_refused(self):
        with self.assertRaisesRegex(ValueError, "error"):
            sc.penetration_depth(UNIT, UNIT, error=0)
        with self.assertRaises(TypeError):
            sc.penetration_depth(UNIT, 1)


if __name__ == "__main__":
    unittest.main()
