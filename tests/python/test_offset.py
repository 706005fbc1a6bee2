"""Offsets and morphology with a ball: closed forms, certificates and their files, and what is refused."""
import math
import os
import tempfile
import unittest

import starcell as sc

from models import volume


BOX = sc.Box((0, 0, 0), (3, 2, 1))
STEINER = 6 + 22 * 0.3 + math.pi * 6 * 0.09 + 4 / 3 * math.pi * 0.027  # of BOX, grown by 0.3


class Offset(unittest.TestCase):
    def test_closed_forms(self):
        for r, expected in ((sc.offset(BOX, 0.3, error=0.02), STEINER), (sc.dilate(BOX, 0.3, error=0.02), STEINER),
                            (sc.shell(BOX, 0.3, error=0.02), STEINER - 6), (sc.offset(BOX, -0.3, error=0.02), 2.4 * 1.4 * 0.4),
                            (sc.erode(BOX, 0.3, error=0.02), 2.4 * 1.4 * 0.4), (sc.shell(BOX, -0.3, error=0.02), 6 - 2.4 * 1.4 * 0.4)):
            self.assertIn(r.certificate.verdict, ("exact", "contact"))
            self.assertLessEqual(r.certificate.error_bound, 0.02)
            self.assertAlmostEqual(volume(r), expected, delta=0.01 * expected)

    def test_inward_of_what_is_thin_is_nothing(self):
        r = sc.offset(BOX, -0.6)
        self.assertEqual((len(r.triangles), r.certificate.components, r.certificate.verdict), (0, 0, "exact"))

    def test_default_error_follows_the_result(self):
        self.assertAlmostEqual(sc.offset(BOX, 1.0).certificate.statistics["triangles"], len(sc.offset(BOX, 1.0, error=5 / 128).triangles))

    def test_expressions(self):
        slotted = BOX - sc.Box((1, 0.7, -1), (2, 1.3, 2))
        self.assertEqual(sc.offset(slotted, 0.28, error=0.1).certificate.genus, [1])
        self.assertEqual(sc.offset(slotted, 0.32, error=0.1).certificate.genus, [0])
        balls = sc.Sphere((0, 0, 0), 1) | sc.Sphere((4, 0, 0), 1)
        self.assertEqual(sc.offset(balls, 0.9, error=0.1).certificate.components, 2)
        self.assertEqual(sc.offset(balls, 1.1, error=0.1).certificate.components, 1)

    def test_opening_and_closing_of_a_box(self):
        r = sc.opening(BOX, 0.3, error=0.1)
        grown = 2.4 * 1.4 * 0.4 + 2 * (2.4 * 1.4 + 1.4 * 0.4 + 0.4 * 2.4) * 0.3 + math.pi * 4.2 * 0.09 + 4 / 3 * math.pi * 0.027
        self.assertAlmostEqual(volume(r), grown, delta=0.05 * grown)

    def test_shells_with_open_faces(self):
        box = sc.Box((0, 0, 0), (4, 3, 2))
        top = [t for t, z in enumerate(box.vertices[box.triangles][:, :, 2].min(axis=1)) if z == 2]
        tray = sc.shell(box, -0.3, error=0.05, open_faces=top)
        self.assertEqual((tray.certificate.verdict, tray.certificate.genus), ("exact", [0]))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "tray.json")
            tray.certificate.save(path)
            report = sc.check_certificate(path)
        self.assertTrue(report.ok, str(report))
        for solid, faces in ((box, [12]), (box, range(12)), (sc.Sphere((0, 0, 0), 1), [0])):
            with self.assertRaisesRegex(ValueError, "open_faces"):
                sc.shell(solid, -0.3, open_faces=list(faces))

    def test_certificates_go_through_files(self):
        r = sc.shell(BOX, 0.3, error=0.1)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "shell.json")
            r.certificate.save(path)
            report = sc.check_certificate(path)
        self.assertTrue(report.ok, str(report))
        self.assertTrue({claim.name: claim.holds for claim in report.claims}["embedded"], str(report))

    def test_refusals_name_the_argument(self):
        for call, name in ((lambda: sc.offset(BOX, 0), "distance"), (lambda: sc.offset(BOX, math.nan), "distance"),
                           (lambda: sc.shell(BOX, 0), "thickness"), (lambda: sc.erode(BOX, -1), "element"),
                           (lambda: sc.opening(BOX, -1), "radius"), (lambda: sc.offset(BOX, 1, error=0), "error")):
            with self.assertRaisesRegex(ValueError, name):
                call()
        with self.assertRaises(TypeError):
            sc.offset("box", 1)

    def test_progress_never_goes_back(self):
        seen = []
        sc.opening(BOX, 0.3, error=0.1, progress=lambda fraction, stage: seen.append(fraction) or True)
        self.assertEqual(seen, sorted(seen))
        self.assertEqual(seen[-1], 1.0)

    def test_cancelling(self):
        with self.assertRaises(sc.CancelledError):
            sc.offset(BOX, 0.3, error=0.002, progress=lambda fraction, stage: False)


if __name__ == "__main__":
    unittest.main()
