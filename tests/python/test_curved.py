"""Curved solids as Python sees them: constructors, errors, boxes, results near what the formulas say, certificates as files."""
import math
import os
import tempfile
import unittest

import models
import numpy as np
import starcell as sc

TURN = models.rotation((1, 2, 3), 0.7)

# Signed functions in coordinates of their own, negative inside; written out again, nothing of the engine's.
SOLIDS = {
    "Sphere": (lambda: sc.Sphere((0.1, 0.2, 0.3), 0.8), lambda p: np.linalg.norm(p - (0.1, 0.2, 0.3), axis=1) - 0.8),
    "Ellipsoid": (lambda: sc.Ellipsoid((0, 0, 0), (1, 0.6, 0.8)), lambda p: np.linalg.norm(p / (1, 0.6, 0.8), axis=1) - 1),
    "Cylinder": (lambda: sc.Cylinder((0, 0, -1), (0, 0, 3), 0.7, 2),
                 lambda p: np.maximum(np.hypot(p[:, 0], p[:, 1]) - 0.7, np.abs(p[:, 2]) - 1)),
    "Cone": (lambda: sc.Cone((0, 0, 0), (0, 0, 1), 0.9, 0.3, 1.2),
             lambda p: np.maximum(np.hypot(p[:, 0], p[:, 1]) - (0.9 - 0.5 * p[:, 2]), np.abs(p[:, 2] - 0.6) - 0.6)),
    "Torus": (lambda: sc.Torus((0, 0, 0), (0, 0, 1), 1, 0.35), lambda p: np.hypot(np.hypot(p[:, 0], p[:, 1]) - 1, p[:, 2]) - 0.35),
    "Quadric": (lambda: sc.Quadric(np.diag([1, 2, 3, -1])), lambda p: p[:, 0] ** 2 + 2 * p[:, 1] ** 2 + 3 * p[:, 2] ** 2 - 1),
}


def moved(points):
    """Points of the turned solid, back in its own coordinates."""
    return points @ TURN[:3, :3]


class Constructors(unittest.TestCase):
    def test_classes_and_reprs(self):
        for name, (make, _) in SOLIDS.items():
            solid = make()
            self.assertIs(type(solid), getattr(sc, name))
            self.assertIsInstance(solid, sc.Solid)
            self.assertIn(name.lower(), repr(solid))
            self.assertIs(type(solid.transformed(TURN)), getattr(sc, name))

    def test_wrong_arguments_are_named(self):
        for make, name in ((lambda: sc.Sphere((0, 0, 0), -1), "radius"), (lambda: sc.Sphere((0, 0, math.nan), 1), "center"),
                           (lambda: sc.Cylinder((0, 0, 0), (0, 0, 0), 1, 1), "axis"), (lambda: sc.Cone((0, 0, 0), (0, 0, 1), -1, 1, 1), "radius1"),
                           (lambda: sc.Torus((0, 0, 0), (0, 0, 1), 1, 2), "minor"), (lambda: sc.Ellipsoid((0, 0, 0), (1, 0, 1)), "semi_axes"),
                           (lambda: sc.Ellipsoid((0, 0, 0), (1, 1, 1), np.eye(4)), "rotation"),
                           (lambda: sc.Quadric(np.triu(np.ones((4, 4)))), "matrix4x4"), (lambda: sc.Sphere((0, 0), 1), "center")):
            with self.assertRaisesRegex(ValueError, name):
                make()
        with self.assertRaises(TypeError):
            sc.Sphere((0, 0, 0), "wide")

    def test_boxes(self):
        lower, upper = sc.Torus((1, 2, 3), (0, 0, 5), 2, 0.5).bounding_box
        np.testing.assert_allclose(lower, (-1.5, -0.5, 2.5), atol=1e-9)
        np.testing.assert_allclose(upper, (3.5, 4.5, 3.5), atol=1e-9)
        with self.assertRaises(sc.UnboundedError):
            sc.Quadric(np.diag([1, 1, -1, -1])).bounding_box


class Results(unittest.TestCase):
    """The definition of the bound, at the triangles' middles: a point inside and one outside within it."""

    def near(self, solid, function, error):
        result = sc.evaluate(solid, error=error)
        certificate = result.certificate
        self.assertEqual(certificate.verdict, "exact")
        self.assertEqual(certificate.tessellated, [])
        self.assertLessEqual(certificate.error_bound, error)
        self.assertTrue(models.is_closed_oriented(result))
        a, b, c = (result.vertices[result.triangles[:, k]] for k in range(3))
        inside, outside = np.zeros(len(a), bool), np.zeros(len(a), bool)
        middles = (a + b + c) / 3
        steps = np.random.default_rng(1).normal(size=(600, 3))
        steps *= (np.linspace(0, 1, 600) ** (1 / 3) / np.linalg.norm(steps, axis=1))[:, None]   # all over the ball
        for step in certificate.error_bound * steps:
            open_ = ~(inside & outside)
            values = function(middles[open_] + step)
            inside[open_] |= values <= 1e-9
            outside[open_] |= values >= -1e-9
        self.assertEqual(np.count_nonzero(~(inside & outside)), 0)
        return result

    def test_every_kind_turned(self):
        for name, (make, function) in SOLIDS.items():
            for error in (0.1, 0.02):
                with self.subTest(name, error=error):
                    self.near(make().transformed(TURN), lambda p: function(moved(p)), error)

    def test_all_pairs(self):
        for first, (make_a, f) in SOLIDS.items():
            for second, (make_b, g) in SOLIDS.items():
                shift = np.eye(4)
                shift[:3, 3] = 0.41, 0.33, 0.27
                with self.subTest(first, second=second):
                    a, b = make_a(), make_b().transformed(shift)
                    self.near(a - b, lambda p: np.maximum(f(p), -g(p - shift[:3, 3])), 0.05)

    def test_without_an_error_the_topology_is_right(self):
        result = sc.evaluate(SOLIDS["Torus"][0]() - sc.Sphere((1, 0, 0), 0.6), error=math.inf)
        self.assertEqual((result.certificate.verdict, result.certificate.genus), ("exact", [0]))

    def test_cancelling(self):
        spheres = sc.union([sc.Sphere((k % 7, k // 7 % 7, k / 49), 0.6) for k in range(200)])
        with self.assertRaises(sc.CancelledError):
            sc.evaluate(spheres, error=0.01, progress=lambda fraction, stage: False)

    def test_a_budget_ends_as_unresolved(self):
        result = sc.evaluate(sc.Sphere((0, 0, 0), 1), error=0.001, budget=sc.Budget(max_cells=200))
        self.assertEqual(result.certificate.verdict, "unresolved")
        self.assertTrue(result.certificate.unresolved)


class Certificates(unittest.TestCase):
    def test_saved_and_checked(self):
        result = sc.evaluate(sc.Cylinder((0, 0, -2), (0, 0, 1), 0.4, 4).transformed(TURN) | sc.Sphere((0, 0, 0), 1) - sc.HalfSpace((0, 0, -0.5), (0, 0, 1)),
                             error=0.05)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "curved.json")
            result.certificate.save(path)
            report = sc.check_certificate(path)
            self.assertTrue(report.ok)
            # What CGAL cannot judge of curved operands is said to be unknown, not right.
            self.assertFalse(report.complete)
            with open(path) as file:
                text = file.read()
            self.assertIn('"cylinder"', text)
            with open(path, "w") as file:
                file.write(text.replace('"cylinder"', '"cylindre"'))
            with self.assertRaisesRegex(sc.FileError, "cylindre"):
                sc.check_certificate(path)


if __name__ == "__main__":
    unittest.main()
