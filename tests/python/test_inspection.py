"""Thin places, and what an offset makes of each part of a solid."""
import unittest

import numpy
import starcell as sc

DUMBBELL = sc.Box((0, 0, 0), (4, 4, 4)) | sc.Box((3, 0, 1), (9, 4, 1.5)) | sc.Box((8, 0, 0), (12, 4, 4))


class ThinPlaces(unittest.TestCase):
    def test_a_plate_between_blocks(self):
        found = sc.thin_places(DUMBBELL, 1.0)
        self.assertEqual(len(found), 1)
        self.assertAlmostEqual(found.thicknesses[0], 0.5)
        lower, upper = found.boxes[0]
        numpy.testing.assert_allclose(lower, (4, 0, 1), atol=found.spacing)
        numpy.testing.assert_allclose(upper, (8, 4, 1.5), atol=found.spacing)
        spokes = found.spokes[0]
        self.assertEqual(spokes.shape[1:], (2, 3))
        numpy.testing.assert_allclose(numpy.linalg.norm(spokes[:, 1] - spokes[:, 0], axis=1), 0.5)

    def test_gaps(self):
        slotted = sc.Box((0, 0, 0), (10, 10, 10)) - sc.Box((4, -1, 3), (4.8, 11, 11))
        self.assertAlmostEqual(sc.thin_places(slotted, 1, gaps=True).thicknesses[0], 0.8)
        self.assertEqual(len(sc.thin_places(slotted, 1)), 0)

    def test_what_is_curved_is_meshed(self):
        tube = sc.Cylinder((0, 0, 0), (0, 0, 1), 5, 8) - sc.Cylinder((0, 0, -1), (0, 0, 1), 4.4, 10)
        found = sc.thin_places(tube, 1.0, error=0.02)
        self.assertAlmostEqual(found.thicknesses[0], 0.6, delta=0.04)
        self.assertEqual(len(sc.thin_places(tube, 0.5, error=0.02)), 0)
        self.assertIsInstance(found.solid, sc.Polyhedron)

    def test_progress_and_cancelling(self):
        stages = []
        sc.thin_places(DUMBBELL, 1.0, progress=lambda done, stage: stages.append(stage))
        self.assertTrue(stages)
        with self.assertRaises(sc.CancelledError):
            sc.thin_places(DUMBBELL, 0.1, progress=lambda done, stage: stage != "looking for thin places")

    def test_refusals(self):
        for bad in (0, -1, float("nan"), float("inf")):
            with self.assertRaisesRegex(ValueError, "thickness"):
                sc.thin_places(DUMBBELL, bad)
        with self.assertRaisesRegex(ValueError, "error"):
            sc.thin_places(DUMBBELL, 1, error=-1)
        with self.assertRaisesRegex(TypeError, "progress"):
            sc.thin_places(DUMBBELL, 1, progress=1)
        with self.assertRaises(sc.UnboundedError):
            sc.thin_places(~DUMBBELL, 1)


class Pieces(unittest.TestCase):
    def test_an_erosion_splits_and_loses(self):
        whole = sc.evaluate(DUMBBELL | sc.Box((0, 8, 0), (10, 8.6, 0.6)), error=0.1).as_solid()
        self.assertEqual(sc.count_pieces(whole, sc.erode(whole, 0.2, error=0.1).as_solid()), [1, 1])
        self.assertEqual(sc.count_pieces(whole, sc.erode(whole, 0.28, error=0.1).as_solid()), [2, 1])
        self.assertEqual(sc.count_pieces(whole, sc.erode(whole, 0.35, error=0.1).as_solid()), [2, 0])

    def test_nothing_is_no_piece(self):
        whole = sc.Box((0, 0, 0), (1, 1, 1))
        self.assertEqual(sc.count_pieces(whole, sc.erode(whole, 1).as_solid()), [0])

    def test_only_polyhedra(self):
        with self.assertRaises(TypeError):
            sc.count_pieces(sc.Sphere((0, 0, 0), 1), sc.Box((0, 0, 0), (1, 1, 1)))


if __name__ == "__main__":
    unittest.main()
