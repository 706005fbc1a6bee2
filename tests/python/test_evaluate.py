"""evaluate(): options, result and certificate, on boxes whose Booleans are known in closed form."""
import math
import unittest

import numpy as np
import starcell as sc

from models import euler_characteristic, is_closed_oriented, rotation, volume

UNIT = sc.Box((0, 0, 0), (1, 1, 1))
CORNER = sc.Box((0.5, 0.25, 0.125), (2, 2, 2))
OVERLAP = 0.5 * 0.75 * 0.875
CORNER_VOLUME = 1.5 * 1.75 * 1.875
THROUGH = sc.Box((0.25, 0.25, -1), (0.75, 0.75, 2))  # drills UNIT from below to above


class Booleans(unittest.TestCase):
    def check(self, solid, volume_is, genus, error=0.05):
        result = sc.evaluate(solid, error=error)
        certificate = result.certificate
        self.assertEqual(certificate.verdict, "exact")
        self.assertLessEqual(certificate.error_bound, error)
        self.assertEqual(certificate.genus, genus)
        self.assertEqual(certificate.components, len(genus))
        self.assertTrue(is_closed_oriented(result))
        self.assertEqual(euler_characteristic(result), sum(2 - 2 * g for g in genus))
        self.assertEqual(certificate.euler_characteristic, euler_characteristic(result))
        self.assertAlmostEqual(volume(result), volume_is, places=7)
        return result

    def test_union(self):
        self.check(UNIT | CORNER, 1 + CORNER_VOLUME - OVERLAP, [0])

    def test_intersection(self):
        self.check(UNIT & CORNER, OVERLAP, [0])

    def test_difference(self):
        self.check(UNIT - CORNER, 1 - OVERLAP, [0])

    def test_a_drilled_box_has_a_handle(self):
        self.check(UNIT - THROUGH, 0.75, [1])

    def test_apart_is_two_components_the_larger_first(self):
        drilled = UNIT - THROUGH
        self.check(drilled | sc.Box((3, 0, 0), (5, 2, 2)), 0.75 + 8, [0, 1])

    def test_rotation_changes_neither_topology_nor_volume(self):
        for angle in (0.3, 1.1, 2.9):
            turn = rotation((1, 2, 3), angle)
            self.check((UNIT - THROUGH).transformed(turn), 0.75, [1])

    def test_a_half_space_cuts(self):
        self.check(UNIT & sc.HalfSpace((0, 0, 0.25), (0, 0, 1)), 0.25, [0])

    def test_nothing_is_an_empty_mesh(self):
        result = sc.evaluate(UNIT & sc.Box((3, 3, 3), (4, 4, 4)), error=0.05)
        self.assertEqual(result.vertices.shape, (0, 3))
        self.assertEqual(result.triangles.shape, (0, 3))
        self.assertEqual((result.certificate.components, result.certificate.genus), (0, []))


class Options(unittest.TestCase):
    def test_default_error_is_a_128th_of_the_longest_side(self):
        certificate = sc.evaluate(UNIT | CORNER).certificate
        self.assertAlmostEqual(certificate.requested_error, 2 / 128)
        self.assertAlmostEqual(certificate.contact_tolerance, 2 / 12800)

    def test_infinite_error_asks_for_topology_only(self):
        certificate = sc.evaluate(UNIT - THROUGH, error=math.inf).certificate
        self.assertEqual((certificate.verdict, certificate.genus), ("exact", [1]))

    def test_the_thesis_criterion_can_be_chosen(self):
        self.assertEqual(sc.evaluate(UNIT - CORNER, error=0.05, criterion="complex-cell").certificate.genus, [0])

    def test_the_number_of_threads_changes_no_byte(self):
        turn = rotation((3, 1, 2), 0.8)
        one, two = (sc.evaluate((UNIT - THROUGH).transformed(turn), error=0.05, threads=n) for n in (1, 2))
        self.assertEqual(one.vertices.tobytes(), two.vertices.tobytes())
        self.assertEqual(one.triangles.tobytes(), two.triangles.tobytes())

    def test_bad_options_name_the_argument(self):
        for options, name in (({"error": 0}, "error"), ({"error": -1}, "error"), ({"error": math.nan}, "error"),
                              ({"contact": 0}, "contact"), ({"contact": math.inf}, "contact"),
                              ({"error": 0.1, "contact": 0.1}, "contact"), ({"criterion": "best"}, "criterion"),
                              ({"threads": -1}, "threads"), ({"on_unresolved": "ignore"}, "on_unresolved")):
            with self.assertRaisesRegex(ValueError, name, msg=str(options)):
                sc.evaluate(UNIT, **options)
        for options in ({"error": "small"}, {"budget": 5}, {"progress": 5}, {"threads": 1.5}):
            with self.assertRaisesRegex(TypeError, next(iter(options)), msg=str(options)):
                sc.evaluate(UNIT, **options)
        with self.assertRaisesRegex(TypeError, "expression"):
            sc.evaluate("box")

    def test_unbounded_expressions_are_refused(self):
        for solid in (~UNIT, sc.HalfSpace((0, 0, 0), (0, 0, 1)), UNIT | sc.HalfSpace((0, 0, 0), (0, 0, 1))):
            with self.assertRaises(sc.UnboundedError):
                sc.evaluate(solid, error=0.1)


class Budgets(unittest.TestCase):
    # Six boxes turned against one another: in each of eight cells there are more planes than one cell is looked at for.
    HARD = sc.union([(UNIT - THROUGH).transformed(rotation((1, 1, 0.2), 0.4 + 0.3 * k)) for k in range(5)] + [sc.Box((0.1, 0.2, 0.3), (1.3, 0.6, 1.7))])

    def test_a_spent_budget_is_unresolved_and_says_where(self):
        result = sc.evaluate(self.HARD, error=0.01, budget=sc.Budget(max_depth=1))
        certificate = result.certificate
        self.assertEqual(certificate.verdict, "unresolved")
        self.assertTrue(certificate.unresolved)
        for lower, upper in certificate.unresolved:
            self.assertEqual((lower.shape, upper.shape), ((3,), (3,)))
            self.assertTrue((lower < upper).all())
        self.assertTrue(is_closed_oriented(result))

    def test_unresolved_can_raise_and_carries_the_result(self):
        with self.assertRaises(sc.UnresolvedError) as caught:
            sc.evaluate(self.HARD, error=0.01, budget=sc.Budget(max_depth=1), on_unresolved="raise")
        self.assertIsInstance(caught.exception.result, sc.Result)
        self.assertEqual(caught.exception.result.certificate.verdict, "unresolved")

    def test_budgets_are_positive(self):
        for name in ("max_depth", "max_cells", "max_seconds", "max_bytes"):
            for value in (0, -1):
                with self.assertRaisesRegex(ValueError, name):
                    sc.Budget(**{name: value})
        with self.assertRaises(TypeError):
            sc.Budget(3)
        self.assertEqual(sc.Budget(max_depth=5, max_seconds=1.5).max_depth, 5)


class ResultAndCertificate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.result = sc.evaluate(UNIT - THROUGH, error=0.05)

    def test_arrays(self):
        self.assertEqual(self.result.vertices.dtype, np.float64)
        self.assertEqual(self.result.triangles.dtype, np.int32)
        self.assertLess(self.result.triangles.max(), len(self.result.vertices))

    def test_statistics_are_plain_numbers(self):
        statistics = self.result.certificate.statistics
        self.assertIsInstance(statistics["leaves"], int)
        self.assertGreater(statistics["leaves"], 0)
        self.assertTrue(all(isinstance(v, (int, float)) for v in statistics.values()))
        self.assertTrue(any(name.startswith("seconds") for name in statistics))

    def test_exact_operands_are_not_named_as_tessellated(self):
        self.assertEqual(self.result.certificate.tessellated, [])
        self.assertEqual(self.result.certificate.contacts, [])
        self.assertEqual(self.result.certificate.unresolved, [])

    def test_a_result_is_a_solid_again(self):
        solid = self.result.as_solid()
        self.assertIsInstance(solid, sc.Polyhedron)
        again = sc.evaluate(solid & sc.Box((-1, -1, -1), (2, 2, 0.5)), error=0.05)
        self.assertEqual(again.certificate.genus, [1])
        self.assertAlmostEqual(volume(again), 0.375, places=7)

    def test_arrays_outlive_the_result(self):
        vertices = sc.evaluate(UNIT | CORNER, error=0.05).vertices
        self.assertTrue(np.isfinite(vertices).all())


    def test_nothing_has_any_error(self):
        apart = sc.Sphere((0, 0, 0), 1) & sc.Sphere((5, 0, 0), 1)
        for result in (sc.evaluate(apart), sc.simplify(apart)):
            self.assertEqual((len(result.triangles), result.certificate.verdict), (0, "exact"))

    def test_results_are_decimated_unless_told_not_to(self):
        less = sc.Sphere((0, 0, 0), 1) - sc.Cylinder((0, 0, -2), (0, 0, 1), 0.4, 4)
        few, many = sc.evaluate(less, error=0.02), sc.evaluate(less, error=0.02, decimate=False)
        self.assertLess(len(few.triangles), 0.8 * len(many.triangles))
        self.assertGreater(few.certificate.statistics["triangles.contoured"], len(few.triangles))
        for result in (few, many):
            self.assertEqual((result.certificate.verdict, list(result.certificate.genus)), ("exact", [1]))
            self.assertLessEqual(result.certificate.error_bound, 0.02)
        self.assertLess(len(sc.offset(less, 0.1, error=0.05).triangles), len(sc.offset(less, 0.1, error=0.05, decimate=False).triangles))


if __name__ == "__main__":
    unittest.main()
