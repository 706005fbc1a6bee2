"""Mesh files: what write() leaves, read_mesh() reads, bit for bit where the format can hold it."""
import os
import tempfile
import unittest
from pathlib import Path

import numpy as np
import starcell as sc

from models import box_mesh, rotation, volume


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # Turned, so that coordinates need all their digits.
        solid = (sc.Box((0, 0, 0), (1, 1, 1)) - sc.Box((0.5, 0.5, -1), (2, 2, 2))).transformed(rotation((1, 2, 3), 0.5))
        cls.result = sc.evaluate(solid, error=0.05)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_double_formats_return_the_same_mesh(self):
        for extension in ("off", "obj", "ply", "OFF"):
            path = self.folder / ("part." + extension)
            self.result.write(path)
            solid = sc.read_mesh(path)
            np.testing.assert_array_equal(solid.vertices[solid.triangles], self.result.vertices[self.result.triangles])

    def test_stl_rounds_to_float32(self):
        path = self.folder / "part.stl"
        self.result.write(str(path))
        self.assertEqual(path.stat().st_size, 84 + 50 * len(self.result.triangles))
        solid = sc.read_mesh(path)
        np.testing.assert_array_equal(solid.vertices[solid.triangles],
                                      self.result.vertices.astype(np.float32)[self.result.triangles])

    def test_text_formats_are_text_that_others_read(self):
        path = self.folder / "part.off"
        self.result.write(path)
        words = path.read_text().split()
        self.assertEqual(words[:4], ["OFF", str(len(self.result.vertices)), str(len(self.result.triangles)), "0"])

    def test_ply_in_text(self):
        vertices, triangles = box_mesh()
        lines = ["ply", "format ascii 1.0", "element vertex 8", "property float x", "property float y", "property float z",
                 "element face 12", "property list uchar int vertex_indices", "end_header"]
        lines += ["%g %g %g" % tuple(v) for v in vertices] + ["3 %d %d %d" % tuple(t) for t in triangles]
        path = self.folder / "box.ply"
        path.write_text("\n".join(lines) + "\n")
        self.assertAlmostEqual(volume(sc.read_mesh(path)), 1.0, places=12)

    def test_unknown_extensions_are_named(self):
        with self.assertRaisesRegex(ValueError, "step"):
            self.result.write(self.folder / "part.step")

    def test_a_folder_that_is_not_there(self):
        with self.assertRaisesRegex(sc.FileError, "nowhere"):
            self.result.write(self.folder / "nowhere" / "part.stl")
        with self.assertRaisesRegex(sc.FileError, "nowhere"):
            sc.read_mesh(self.folder / "nowhere" / "part.stl")

    def test_a_failed_write_leaves_the_old_file(self):
        path = self.folder / "part.off"
        path.mkdir()
        with self.assertRaises(sc.FileError):
            self.result.write(path)
        self.assertEqual(os.listdir(self.folder), ["part.off"])

    def test_damaged_files_are_refused(self):
        self.result.write(self.folder / "part.ply")
        whole = (self.folder / "part.ply").read_bytes()
        for end in (0, 3, 40, len(whole) // 2, len(whole) - 1):
            path = self.folder / "cut.ply"
            path.write_bytes(whole[:end])
            with self.assertRaises(sc.FileError, msg=str(end)):
                sc.read_mesh(path)

    def test_an_open_mesh_in_a_file_is_refused(self):
        path = self.folder / "open.obj"
        path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        with self.assertRaises(sc.InvalidSolidError):
            sc.read_mesh(path)

    def test_a_missing_cad_file(self):
        with self.assertRaises(sc.Error):
            sc.from_brep(self.folder / "missing.step", error=0.1)


if __name__ == "__main__":
    unittest.main()
