"""Operators on solids. Nothing here evaluates: boxes of expressions and refused operands only."""
import unittest

import numpy as np
import starcell as sc

LEFT, RIGHT = sc.Box((0, 0, 0), (2, 1, 1)), sc.Box((1, 0, 0), (3, 1, 1))


class Operators(unittest.TestCase):
    def assert_box(self, solid, lower, upper):
        np.testing.assert_allclose(solid.bounding_box, (lower, upper))

    def test_union_covers_both(self):
        self.assert_box(LEFT | RIGHT, (0, 0, 0), (3, 1, 1))

    def test_intersection_lies_in_the_common_box(self):
        self.assert_box(LEFT & RIGHT, (1, 0, 0), (2, 1, 1))

    def test_difference_lies_in_the_first(self):
        self.assert_box(LEFT - RIGHT, (0, 0, 0), (2, 1, 1))

    def test_complement_is_unbounded_until_it_is_intersected(self):
        with self.assertRaises(sc.UnboundedError):
            (~LEFT).bounding_box
        self.assert_box(RIGHT & ~LEFT, (1, 0, 0), (3, 1, 1))

    def test_a_half_space_is_bounded_by_its_company(self):
        half = sc.HalfSpace((0, 0, 0.5), (0, 0, 1))
        lower, upper = (LEFT & half).bounding_box
        self.assertTrue((lower >= (0, 0, 0)).all() and (upper <= (2, 1, 1)).all())
        with self.assertRaises(sc.UnboundedError):
            (LEFT | half).bounding_box

    def test_functions_take_any_number_of_solids(self):
        self.assert_box(sc.union([LEFT]), (0, 0, 0), (2, 1, 1))
        self.assert_box(sc.union((LEFT, RIGHT, LEFT)), (0, 0, 0), (3, 1, 1))
        self.assert_box(sc.intersection([LEFT, RIGHT, RIGHT]), (1, 0, 0), (2, 1, 1))

    def test_results_are_solids(self):
        for solid in (LEFT | RIGHT, LEFT & RIGHT, LEFT - RIGHT, ~LEFT, sc.union([LEFT, RIGHT])):
            self.assertIsInstance(solid, sc.Solid)

    def test_other_operands_are_a_type_error(self):
        for other in (None, 1, "box", [LEFT]):
            with self.assertRaises(TypeError):
                LEFT | other
            with self.assertRaises(TypeError):
                other - LEFT
        with self.assertRaises(TypeError):
            sc.union([LEFT, 3])
        with self.assertRaises(TypeError):
            sc.union(LEFT)

    def test_no_operand_is_a_value_error(self):
        for function in (sc.union, sc.intersection):
            with self.assertRaises(ValueError):
                function([])


if __name__ == "__main__":
    unittest.main()
