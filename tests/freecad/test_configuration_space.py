"""Configuration spaces of document objects: solids, faces and sketches as robots and obstacles; counts known by construction."""
import math

import FreeCAD
import numpy
import Part
from FreeCAD import Vector
from support import DocumentTest

import starcell_workbench as scw
from starcell_workbench import planar_section


class ConfigurationSpaces(DocumentTest):
    def frame(self, outer=60, inner=40, height=10):
        return scw.make_cut(self.box((outer, outer, height), (-outer / 2, -outer / 2, 0), "Outer"),
                            self.box((inner, inner, 3 * height), (-inner / 2, -inner / 2, -height), "Inner"))

    def test_of_a_key_in_a_room(self):
        key = self.box((12, 3, 10), (100, 50, 0), "Key")
        obj = scw.make_configuration_space(key, self.frame(), error=2)   # z from 0 to 10
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertEqual((obj.FreeComponents, obj.Components), (2, 2))
        self.assertIn(obj.Verdict, ("exact", "contact"))
        self.assertAlmostEqual((obj.Pivot - Vector(106, 51.5, 5)).Length, 0, places=6)
        box = obj.Mesh.BoundBox
        self.assertAlmostEqual(box.ZMin, 5, delta=0.5)   # within the error, as drawn
        self.assertAlmostEqual(box.ZMax, 5 + obj.TurnDrawn.Value, delta=0.5)
        self.assertIn("Free pieces that the robot cannot leave: 2", obj.Report)
        key.Length = 50   # fits into the room along its diagonals only: either way round of two
        self.doc.recompute()
        self.assertEqual(obj.FreeComponents, 5)
        key.Length = 60
        self.doc.recompute()
        self.assertEqual(obj.FreeComponents, 1)

    def test_volume_is_poincares(self):
        """Positions in which two convex outlines meet measure 2 pi (A + B) + L M."""
        obj = scw.make_configuration_space(self.box((4, 2, 1)), self.box((6, 5, 1), (20, 0, 0)), height=0.5, margin=8, turn_height=2 * math.pi, error=0.2)
        self.assertTrue(obj.isValid(), obj.getStatusString())
        whole = (6 + 16) * (5 + 16) * 2 * math.pi
        self.assertAlmostEqual(obj.Mesh.Volume, whole - (2 * math.pi * (8 + 30) + 12 * 22), delta=0.02 * whole)

    def test_sketches_faces_holes_and_circles(self):
        face = self.doc.addObject("Part::Feature", "Face")
        rings = [Part.makePolygon([Vector(*p) for p in ring]) for ring in (
            [(-30, -30, 0), (30, -30, 0), (30, 30, 0), (-30, 30, 0), (-30, -30, 0)], [(-20, -20, 0), (20, -20, 0), (20, 20, 0), (-20, 20, 0), (-20, -20, 0)])]
        face.Shape = Part.makeFace(rings, "Part::FaceMakerBullseye")
        sketch = self.doc.addObject("Sketcher::SketchObject", "Sketch")
        sketch.addGeometry(Part.ArcOfCircle(Part.Circle(Vector(100, 0, 0), Vector(0, 0, 1), 8), 0, math.pi))
        sketch.addGeometry(Part.LineSegment(Vector(92, 0, 0), Vector(108, 0, 0)))
        self.doc.recompute()
        obj = scw.make_configuration_space(sketch, face, error=3)
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertEqual(obj.FreeComponents, 2)
        self.assertIn("chords", obj.Report)
        self.assertTrue(face.Visibility)

    def test_outlines_run_round_whatever_way_their_edges_do(self):
        """A flat triangle, two of whose corners are nearer to each other than to the third; in a container that is turned."""
        prism = self.doc.addObject("Part::Feature", "Prism")
        corners = [Vector(0, 0, 0), Vector(20, 0, 0), Vector(19, 3, 0)]
        for first in range(3):
            for step in (1, 2):
                ring = [corners[(first + step * k) % 3] for k in range(4)]
                prism.Shape = Part.Face(Part.makePolygon(ring)).extrude(Vector(0, 0, 2))
                self.doc.recompute()
                section = planar_section.Section(prism, prism, 1)
                self.assertEqual(sorted(tuple(numpy.round(p, 6) + 0.0) for p in section.polygons[0][0]), [(0, 0), (19, 3), (20, 0)])
        self.part([prism], (5, 0, 0), FreeCAD.Rotation(Vector(0, 0, 1), 90))
        section = planar_section.Section(prism, self.box(), 1)
        self.assertEqual(section.deflection, 0)
        self.assertEqual(sorted(tuple(numpy.round(p, 6) + 0.0) for p in section.polygons[0][0]), [(2, 19), (5, 0), (5, 20)])

    def test_free_positions_in_a_box(self):
        room = scw.make_cut(self.box((40, 40, 40)), self.box((20, 20, 20), (10, 10, 10), "Inner"))
        obj = scw.make_free_positions(self.box((6, 4, 2), (200, 0, 0), "Block"), room, error=0.5)
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertEqual(obj.FreeComponents, 2)
        inside = min(obj.Mesh.getSeparateComponents(), key=lambda part: part.BoundBox.DiagonalLength).BoundBox
        self.assertAlmostEqual(inside.XLength, 14, places=3)
        self.assertAlmostEqual(inside.ZMin, 11, places=3)

    def test_says_what_is_not_in_the_plane(self):
        robot, obstacle = self.box(), self.box((5, 5, 5), (0, 0, 40), "High")
        obj = scw.make_configuration_space(robot, obstacle)
        self.assertFalse(obj.isValid())
        self.assertIn("'High' has nothing in the plane", obj.getStatusString())

    def test_survives_saving(self):
        name = scw.make_configuration_space(self.box((4, 2, 1)), self.box((6, 5, 1), (20, 0, 0)), height=0.5, error=1).Name
        obj = self.reopened().getObject(name)
        self.assertEqual(obj.FreeComponents, 1)
        obj.Robot.Length = 5
        obj.Document.recompute()
        self.assertTrue(obj.isValid())
