"""repair(): the bindings, findings, and refusals; what it proves is tested in the core."""
import unittest

import numpy as np
import starcell as sc
from models import volume

BOX = sc.Box((0, 0, 0), (1, 1, 1))
VERTICES, TRIANGLES = np.asarray(BOX.vertices), np.asarray(BOX.triangles)


class Repair(unittest.TestCase):
    def test_a_union_by_concatenation(self):
        result = sc.repair(np.concatenate([VERTICES, VERTICES + 0.5]), np.concatenate([TRIANGLES, TRIANGLES + 8]), error=0.05)
        self.assertAlmostEqual(volume(result), 2 - 0.125)
        self.assertEqual((result.certificate.verdict, result.certificate.components), ("exact", 1))
        self.assertEqual(result.findings, [])

    def test_says_what_was_wrong_and_where(self):
        triangles = TRIANGLES.copy()
        triangles[4] = triangles[4][::-1]
        result = sc.repair(VERTICES, np.delete(triangles, 7, axis=0), error=0.2)
        self.assertAlmostEqual(volume(result), 1)
        self.assertEqual(sorted(what for what, place in result.findings), ["hole", "turned triangle"])
        for what, (lower, upper) in result.findings:
            self.assertTrue((np.asarray(lower) >= 0).all() and (np.asarray(upper) <= 1).all(), what)
        self.assertEqual(result.certificate.statistics["repair.hole"], 1)

    def test_nothing_and_what_is_not_finite_are_refused_by_name(self):
        for vertices, triangles in ((np.zeros((0, 3)), np.zeros((0, 3), int)), (np.full((3, 3), np.nan), [(0, 1, 2)]), (np.zeros((3, 3)), [(0, 1, 2)])):
            with self.assertRaises(sc.InvalidSolidError):
                sc.repair(vertices, triangles)

    def test_other_results_have_no_findings(self):
        self.assertEqual(sc.evaluate(BOX).findings, [])

    def test_refusals(self):
        with self.assertRaisesRegex(sc.InvalidSolidError, "wider than 0.1"):
            sc.repair(VERTICES, TRIANGLES[1:], error=0.01)
        with self.assertRaisesRegex(sc.InvalidSolidError, "not finite"):
            sc.repair(VERTICES * np.nan, TRIANGLES, error=0.1)
        with self.assertRaises(ValueError):
            sc.repair(VERTICES, TRIANGLES, error=0)
        with self.assertRaises(ValueError):
            sc.repair(VERTICES, TRIANGLES + 5, error=0.1)
        with self.assertRaises(sc.CancelledError):
            sc.repair(VERTICES, TRIANGLES, error=0.1, progress=lambda done, stage: False)


if __name__ == "__main__":
    unittest.main()
