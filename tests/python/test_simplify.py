"""simplify(): the bindings, arguments and errors; what it proves is tested in the core."""
import math
import os
import tempfile
import unittest

import starcell as sc
from models import volume


def ball(error):
    return sc.evaluate(sc.Sphere((0, 0, 0), 1), error=error).as_solid()


class Simplify(unittest.TestCase):
    def test_takes_triangles_away_and_says_how_far_it_moved(self):
        fine = ball(0.002)
        result = sc.simplify(fine, error=0.05)
        self.assertEqual(result.certificate.verdict, "exact")
        self.assertLessEqual(result.certificate.error_bound, 0.05)
        self.assertEqual((result.certificate.components, result.certificate.genus), (1, [0]))
        self.assertEqual(result.certificate.statistics["triangles.before"], len(fine.triangles))
        self.assertLess(len(result.triangles), len(fine.triangles) / 5)
        self.assertAlmostEqual(volume(result), 4 / 3 * math.pi, delta=0.05 * 4 * math.pi)

    def test_an_error_of_none_is_the_longest_side_by_128(self):
        result = sc.simplify(sc.Box((0, 0, 0), (64, 1, 1)))
        self.assertAlmostEqual(result.certificate.requested_error, 0.5)
        self.assertEqual(len(result.triangles), 12)

    def test_its_certificate_is_checked_by_other_code(self):
        result = sc.simplify(ball(0.01), error=0.05)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "simple.json")
            result.certificate.save(path)
            report = sc.check_certificate(path)
        self.assertTrue(report.ok, report)

    def test_arguments(self):
        for error in (0, -1, math.nan):
            with self.assertRaises(ValueError):
                sc.simplify(ball(0.05), error=error)
        with self.assertRaises(sc.CancelledError):
            sc.simplify(ball(0.02), error=0.05, progress=lambda done, stage: False)
        for solid in (ball(0.02), sc.Sphere((0, 0, 0), 1)):  # a mesh; what has to be meshed first
            seen = []
            sc.simplify(solid, error=0.05, progress=lambda done, stage: seen.append(done))
            self.assertEqual(seen, sorted(seen))
            self.assertEqual(seen[-1], 1)


if __name__ == "__main__":
    unittest.main()
