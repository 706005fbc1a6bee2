"""Solids from Python: what goes in as an array or a sequence, what comes out, what is refused and how it is said."""
import unittest

import numpy as np
import starcell as sc

from models import BOX_TRIANGLES, box_mesh, rotation, translation, volume


class Polyhedron(unittest.TestCase):
    def test_takes_numpy_arrays(self):
        solid = sc.Polyhedron(*box_mesh())
        self.assertEqual(solid.vertices.shape, (8, 3))
        self.assertEqual(solid.vertices.dtype, np.float64)
        self.assertEqual(solid.triangles.shape, (12, 3))
        self.assertEqual(solid.triangles.dtype, np.int32)
        self.assertAlmostEqual(volume(solid), 1.0, places=12)

    def test_takes_nested_sequences(self):
        vertices, triangles = box_mesh()
        solid = sc.Polyhedron([tuple(v) for v in vertices.tolist()], tuple(map(list, triangles.tolist())))
        np.testing.assert_array_equal(solid.vertices, vertices)

    def test_takes_any_number_type_and_memory_order(self):
        vertices, triangles = box_mesh()
        for points in (vertices.astype(np.float32), vertices.astype(int), np.asfortranarray(vertices), vertices[::1]):
            for corners in (triangles.astype(np.uint8), triangles.astype(np.uint64), np.asfortranarray(triangles)):
                self.assertEqual(len(sc.Polyhedron(points, corners).triangles), 12)

    def test_owns_its_data(self):
        vertices, triangles = box_mesh()
        solid = sc.Polyhedron(vertices, triangles)
        vertices[:] = 7
        self.assertAlmostEqual(volume(solid), 1.0, places=12)

    def test_arrays_are_read_only_and_outlive_the_solid(self):
        vertices = sc.Polyhedron(*box_mesh()).vertices
        with self.assertRaises(ValueError):
            vertices[0, 0] = 1
        self.assertEqual(vertices.sum(), 12)  # eight corners, each coordinate 1 at four of them

    def test_welds_bit_identical_vertices(self):
        vertices, triangles = box_mesh()
        soup = vertices[triangles].reshape(-1, 3)
        self.assertEqual(len(sc.Polyhedron(soup, np.arange(36).reshape(-1, 3)).vertices), 8)

    def test_inside_out_is_turned(self):
        vertices, triangles = box_mesh()
        self.assertAlmostEqual(volume(sc.Polyhedron(vertices, triangles[:, ::-1])), 1.0, places=12)

    def test_wrong_shapes_name_the_argument(self):
        vertices, triangles = box_mesh()
        for points, corners, name in ((vertices[:, :2], triangles, "vertices"), (vertices.ravel(), triangles, "vertices"),
                                      (vertices, triangles[:, :2], "triangles"), (vertices, triangles.ravel(), "triangles"),
                                      ([(0, 0, 0), (1, 0)], triangles, "vertices"), (vertices, [(0, 1, 2), (3,)], "triangles")):
            with self.assertRaisesRegex(ValueError, name):
                sc.Polyhedron(points, corners)

    def test_indices_are_checked_before_they_are_narrowed(self):
        vertices, triangles = box_mesh()
        for bad in (-1, 8, 2**31, 2**32, 2**32 + 1, 2**63 - 1, -2**63):
            corners = triangles.astype(np.int64)
            corners[5, 1] = bad
            with self.assertRaisesRegex(ValueError, "triangles: row 5"):
                sc.Polyhedron(vertices, corners)
        with self.assertRaisesRegex(ValueError, "triangles"):
            sc.Polyhedron(vertices, np.full((12, 3), 2**64 - 1, dtype=np.uint64))

    def test_indices_must_be_integers(self):
        vertices, triangles = box_mesh()
        with self.assertRaisesRegex(TypeError, "triangles"):
            sc.Polyhedron(vertices, triangles + 0.5)

    def test_what_is_no_number_names_the_argument(self):
        vertices, triangles = box_mesh()
        with self.assertRaisesRegex(TypeError, "vertices"):
            sc.Polyhedron([["a", "b", "c"]], triangles)
        with self.assertRaisesRegex(TypeError, "vertices"):
            sc.Polyhedron(vertices.astype(complex), triangles)
        with self.assertRaisesRegex(TypeError, "triangles"):
            sc.Polyhedron(vertices, None)

    def test_defects_are_counted(self):
        vertices, triangles = box_mesh()
        with self.assertRaisesRegex(sc.InvalidSolidError, "(?i)open"):
            sc.Polyhedron(vertices, triangles[:-1])
        with self.assertRaisesRegex(sc.InvalidSolidError, "(?i)manifold"):
            sc.Polyhedron(vertices, np.vstack([triangles, triangles[:1]]))
        broken = vertices.copy()
        broken[0, 0] = np.nan
        with self.assertRaisesRegex(sc.InvalidSolidError, "(?i)finite"):
            sc.Polyhedron(broken, triangles)
        crossing = np.vstack([vertices, vertices + 0.5]), np.vstack([triangles, triangles + 8])
        with self.assertRaisesRegex(sc.InvalidSolidError, "(?i)intersect"):
            sc.Polyhedron(*crossing)

    def test_an_empty_mesh_is_answered_not_crashed_on(self):
        try:
            self.assertEqual(len(sc.Polyhedron([], []).triangles), 0)
        except (sc.InvalidSolidError, ValueError) as error:
            self.assertTrue(str(error))


class BoxAndHalfSpace(unittest.TestCase):
    def test_a_box_is_a_polyhedron(self):
        box = sc.Box((-1, -2, -3), [1, 2, 3])
        self.assertIsInstance(box, sc.Polyhedron)
        self.assertIsInstance(box, sc.Solid)
        self.assertEqual(len(box.triangles), 12)
        self.assertAlmostEqual(volume(box), 48.0, places=12)

    def test_a_box_needs_lower_below_upper(self):
        for lower, upper in (((0, 0, 0), (1, 0, 1)), ((0, 0, 2), (1, 1, 1)), ((0, 0, 0), (1, 1, np.inf)), ((np.nan, 0, 0), (1, 1, 1))):
            with self.assertRaises(ValueError):
                sc.Box(lower, upper)
        with self.assertRaisesRegex(ValueError, "upper"):
            sc.Box((0, 0, 0), (1, 1))

    def test_a_half_space_is_unbounded(self):
        half = sc.HalfSpace((0, 0, 0), (0, 0, 5))
        with self.assertRaises(sc.UnboundedError):
            half.bounding_box
        for normal in ((0, 0, 0), (np.inf, 0, 0)):
            with self.assertRaises(ValueError):
                sc.HalfSpace((0, 0, 0), normal)

    def test_the_base_class_makes_nothing(self):
        with self.assertRaises(TypeError):
            sc.Solid()


class Transformed(unittest.TestCase):
    def test_rigid_motion_keeps_class_and_volume(self):
        moved = sc.Box((0, 0, 0), (1, 2, 3)).transformed(translation((10, 0, 0)) @ rotation((1, 2, 3), 0.7))
        self.assertIsInstance(moved, sc.Polyhedron)
        self.assertAlmostEqual(volume(moved), 6.0, places=12)

    def test_a_mirror_image_stays_outward(self):
        self.assertAlmostEqual(volume(sc.Box((0, 0, 0), (1, 2, 3)).transformed(np.diag([-1, 1, 1, 1.0]))), 6.0, places=12)

    def test_takes_nested_sequences(self):
        lower, upper = sc.Box((0, 0, 0), (1, 1, 1)).transformed([[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]]).bounding_box
        np.testing.assert_array_equal(lower, (5, 6, 7))
        np.testing.assert_array_equal(upper, (6, 7, 8))

    def test_refuses_other_matrices(self):
        box = sc.Box((0, 0, 0), (1, 1, 1))
        projective = np.eye(4)
        projective[3, 0] = 1
        for matrix in (np.eye(3), np.eye(4)[:3], np.zeros((4, 4)), projective, np.full((4, 4), np.nan)):
            with self.assertRaises(ValueError):
                box.transformed(matrix)

    def test_moves_every_leaf_of_an_expression(self):
        both = (sc.Box((0, 0, 0), (1, 1, 1)) | sc.Box((2, 0, 0), (3, 1, 1))).transformed(translation((0, 0, 4)))
        lower, upper = both.bounding_box
        np.testing.assert_allclose(lower, (0, 0, 4))
        np.testing.assert_allclose(upper, (3, 1, 5))


class Provenance(unittest.TestCase):
    def test_a_mesh_is_its_own_truth(self):
        solid = sc.Polyhedron(*box_mesh())
        self.assertEqual(solid.deflection, 0)
        self.assertEqual(solid.cad_faces.shape, (0,))
        self.assertEqual(len(BOX_TRIANGLES), len(solid.triangles))


if __name__ == "__main__":
    unittest.main()
