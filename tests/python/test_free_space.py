"""free_space(): the bindings and their errors; what it proves is tested in the core."""
import math
import unittest

import numpy as np
import starcell as sc

SQUARE = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
TRIANGLE = np.array([(-0.4, -0.3), (0.5, -0.2), (0.0, 0.5)])
BOUNDS = ((-3, -3), (3, 3))


class FreeSpace(unittest.TestCase):
    def test_a_triangle_about_a_square(self):
        r = sc.free_space(sc.PlanarRobot(TRIANGLE), [SQUARE], BOUNDS, error=0.2)
        self.assertIsInstance(r, sc.Result)
        self.assertEqual((r.certificate.verdict, r.certificate.components, list(r.certificate.genus), r.free_components), ("exact", 1, [1], 1))
        self.assertLessEqual(r.certificate.error_bound, 0.2)
        self.assertEqual((r.facet_kind.shape, set(r.facet_kind)), ((len(r.triangles),), {0, 1}))
        low, high = r.vertices.min(axis=0), r.vertices.max(axis=0)
        self.assertTrue(np.allclose(low, (-3, -3, 0), atol=0.2) and np.allclose(high, (3, 3, 2 * math.pi), atol=0.2), (low, high))

    def test_one_polygon_or_several_in_either_sense(self):
        one = sc.free_space(sc.PlanarRobot(TRIANGLE[::-1]), SQUARE, BOUNDS, error=0.5)
        self.assertEqual(one.certificate.genus[0], 1)
        two = sc.free_space(sc.PlanarRobot([TRIANGLE, TRIANGLE + 0.1]), [SQUARE, np.array(SQUARE) + 0.2], BOUNDS, error=0.5)
        self.assertEqual(two.free_components, 1)

    def test_a_translating_solid(self):
        r = sc.free_space(sc.TranslatingRobot(sc.Box((-0.5,) * 3, (0.5,) * 3)), sc.Box((-1,) * 3, (1,) * 3), ((-4,) * 3, (4,) * 3), error=0.1)
        self.assertEqual((r.free_components, len(r.triangles)), (1, 24))

    def test_an_arm(self):
        r = sc.free_space(sc.PlanarArm((1, 1, 1), self_collision=False), [], None, error=0.2)
        self.assertEqual((r.free_components, len(r.triangles)), (1, 12))

    def test_a_hole_is_a_room_of_its_own(self):
        frame = [[(-3, -3), (3, -3), (3, 3), (-3, 3)], [(-2, -2), (2, -2), (2, 2), (-2, 2)]]
        r = sc.free_space(sc.PlanarRobot(TRIANGLE), [frame], ((-5, -5), (5, 5)), error=0.5)
        self.assertEqual(r.free_components, 2)

    def test_an_arm_with_limits_and_shapes(self):
        bar = [(-0.1, -0.1), (1.1, -0.1), (1.1, 0.1), (-0.1, 0.1)]
        r = sc.free_space(sc.PlanarArm((1, 1, 1), joint_limits=[None, (-1, 1), (-1, 1)], link_shapes=[bar, bar, bar]), [], None, error=0.2)
        self.assertEqual((r.free_components, len(r.triangles)), (1, 12))
        self.assertAlmostEqual(float(np.prod(np.ptp(r.vertices, axis=0))), 8 * np.pi)
        with self.assertRaisesRegex(ValueError, "joint_limits"):
            sc.PlanarArm((1, 1, 1), joint_limits=[(1, -1), None, None])
        with self.assertRaisesRegex(TypeError, "joint_limits"):
            sc.PlanarArm((1, 1, 1), joint_limits=(-1, 1))

    def test_errors(self):
        robot = sc.PlanarRobot(TRIANGLE)
        with self.assertRaisesRegex(sc.InvalidSolidError, "polygon 0 crosses"):
            sc.PlanarRobot([(0, 0), (1, 1), (1, 0), (0, 1)])
        with self.assertRaisesRegex(TypeError, "robot"):
            sc.free_space(TRIANGLE, [SQUARE], BOUNDS)
        with self.assertRaisesRegex(ValueError, "bounds"):
            sc.free_space(robot, [SQUARE], ((0, 0), (0, 1)))
        with self.assertRaisesRegex(TypeError, "bounds"):
            sc.free_space(robot, [SQUARE], None)
        with self.assertRaisesRegex(TypeError, "obstacles"):
            sc.free_space(sc.TranslatingRobot(sc.Sphere((0, 0, 0), 1)), [SQUARE], BOUNDS)
        with self.assertRaisesRegex(TypeError, "bounds"):
            sc.free_space(sc.PlanarArm((1, 1, 1)), [SQUARE], BOUNDS)
        with self.assertRaisesRegex(ValueError, "obstacles"):
            sc.free_space(robot, [[(0, 0, 0), (1, 0, 0), (0, 1, 0)]], BOUNDS)
        with self.assertRaisesRegex(ValueError, "link_lengths"):
            sc.PlanarArm((1, -1, 1))

    def test_can_be_cancelled(self):
        with self.assertRaises(sc.CancelledError):
            sc.free_space(sc.PlanarRobot(TRIANGLE), [SQUARE], BOUNDS, error=0.01, progress=lambda done, stage: done < 0.05)


if __name__ == "__main__":
    unittest.main()
