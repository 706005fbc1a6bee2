"""remesh(): the bindings, arguments and errors; what it proves is tested in the core."""
import math
import unittest

import starcell as sc


class Remesh(unittest.TestCase):
    def test_well_shaped_triangles_within_the_error(self):
        block = sc.evaluate(sc.Box((0, 0, 0), (8, 6, 4)) - sc.Cylinder((4, 3, -1), (0, 0, 1), 1.5, 6), error=0.02).as_solid()
        result = sc.remesh(block, error=0.1, edge_length=0.8)
        certificate = result.certificate
        self.assertEqual((certificate.verdict, certificate.components, certificate.genus), ("exact", 1, [1]))
        self.assertLessEqual(certificate.error_bound, 0.1)
        statistics = certificate.statistics
        self.assertEqual(statistics["triangles.before"], len(block.triangles))
        self.assertEqual(statistics["triangles"], len(result.triangles))
        self.assertLess(statistics["aspect_ratio.mean"], 1.4)
        self.assertLess(statistics["aspect_ratio.mean"], statistics["aspect_ratio.mean.before"])

    def test_without_a_length_it_is_five_errors(self):
        result = sc.remesh(sc.Box((0, 0, 0), (4, 4, 4)), error=0.2)
        self.assertEqual(result.certificate.statistics["edge_length"], 1.0)
        self.assertGreater(result.certificate.statistics["angle.least"], 25)

    def test_a_feature_angle_above_all_keeps_nothing_sharp(self):
        box = sc.Box((0, 0, 0), (4, 4, 4))
        self.assertEqual(sc.remesh(box, error=0.2).certificate.statistics["features.corners"], 8)
        self.assertEqual(sc.remesh(box, error=0.2, feature_angle=100).certificate.statistics["features.corners"], 0)

    def test_arguments(self):
        box = sc.Box((0, 0, 0), (4, 4, 4))
        for wrong in ({"error": 0}, {"edge_length": 0}, {"edge_length": -1}, {"edge_length": math.nan}, {"feature_angle": 0}, {"feature_angle": 180}):
            with self.assertRaises(ValueError, msg=wrong):
                sc.remesh(box, **wrong)
        with self.assertRaises(sc.CancelledError):
            sc.remesh(box, error=0.05, progress=lambda done, stage: False)
        seen = []
        sc.remesh(box, error=0.05, progress=lambda done, stage: seen.append(done))
        self.assertEqual(seen, sorted(seen))
        self.assertEqual(seen[-1], 1)


if __name__ == "__main__":
    unittest.main()
