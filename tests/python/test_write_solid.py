"""Meshes to CAD files: what write_solid leaves, from_brep reads, and what it refuses.

The shapes themselves are tested in C++ (tests/cad) and in FreeCAD (tests/freecad)."""
import inspect
import pathlib
import tempfile
import unittest

import numpy as np
import starcell as sc

from models import box_mesh, rotation, volume

try:
    import starcell_cad
except ImportError:
    starcell_cad = None


@unittest.skipUnless(starcell_cad, "built without OpenCASCADE")
class WriteSolid(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_binary_returns_the_very_same_coordinates(self):
        part = sc.Box((0, 0, 0), (3, 4, 5)) - sc.Box((1, 1, -1), (2, 2, 6))
        result = sc.evaluate(part.transformed(rotation((1, 2, 3), 0.5)), error=0.1)
        faces = starcell_cad.write_solid(result.vertices, result.triangles, self.folder / "part.bin")
        self.assertEqual(faces, 10)
        solid = sc.from_brep(self.folder / "part.bin", error=0.1)
        self.assertEqual(set(map(tuple, solid.vertices)), set(map(tuple, result.vertices)))
        self.assertEqual(solid.deflection, 0)
        self.assertAlmostEqual(volume(solid), 60 - 5, places=9)

    def test_text_holds_fifteen_digits(self):
        vertices, triangles = box_mesh((0, 0, 0), (1 / 3, 1, 2))
        for name in ("box.brep", "BOX.BRP"):
            self.assertEqual(starcell_cad.write_solid(vertices, triangles, str(self.folder / name)), 6)
            self.assertAlmostEqual(volume(sc.from_brep(self.folder / name, 0.1)), 2 / 3, places=14)

    def test_normals_are_turned_outward(self):
        vertices, triangles = box_mesh()
        starcell_cad.write_solid(vertices, triangles[:, ::-1], self.folder / "box.bin")
        self.assertEqual(volume(sc.from_brep(self.folder / "box.bin", 0.1)), 1)

    def test_tolerance_says_what_is_flat(self):
        vertices, triangles = box_mesh()
        vertices[7] += 1e-4
        self.assertEqual(starcell_cad.write_solid(vertices, triangles, self.folder / "box.bin"), 9)
        self.assertEqual(starcell_cad.write_solid(vertices, triangles, self.folder / "box.bin", tolerance=1e-3), 6)

    def test_open_mesh_is_refused_with_its_edges(self):
        vertices, triangles = box_mesh()
        with self.assertRaisesRegex(sc.InvalidSolidError, "3 open edges"):
            starcell_cad.write_solid(vertices, triangles[1:], self.folder / "box.bin")
        self.assertFalse((self.folder / "box.bin").exists())

    def test_empty_mesh_is_refused(self):
        with self.assertRaises(sc.InvalidSolidError):
            starcell_cad.write_solid(np.zeros((0, 3)), np.zeros((0, 3), int), self.folder / "empty.bin")

    def test_wrong_arguments_are_named(self):
        vertices, triangles = box_mesh()
        for name, call in (("path", lambda: starcell_cad.write_solid(vertices, triangles, "box.stl")),
                           ("tolerance", lambda: starcell_cad.write_solid(vertices, triangles, "box.bin", -1)),
                           ("tolerance", lambda: starcell_cad.write_solid(vertices, triangles, "box.bin", float("nan"))),
                           ("vertices", lambda: starcell_cad.write_solid(vertices[:, :2], triangles, "box.bin")),
                           ("triangles", lambda: starcell_cad.write_solid(vertices, triangles + 1, "box.bin"))):
            with self.assertRaisesRegex(ValueError, name):
                call()

    def test_file_that_cannot_be_written(self):
        with self.assertRaisesRegex(sc.FileError, "missing"):
            starcell_cad.write_solid(*box_mesh(), self.folder / "missing" / "box.bin")

    def test_every_function_is_documented(self):
        for name in ("read", "write_solid"):
            self.assertRegex(inspect.getdoc(getattr(starcell_cad, name)), "model units")


if __name__ == "__main__":
    unittest.main()
