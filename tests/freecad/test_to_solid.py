"""Meshes as Part solids: valid, of the mesh's volume, with the faces that a person would draw; and what is refused."""
import time

import FreeCAD
import Mesh
import numpy
from FreeCAD import Rotation, Vector
from support import DocumentTest

import starcell_workbench as scw
from starcell_workbench import mesh_transfer

TURN = Rotation(Vector(1, 2, 3), 40)


def cubes(full):
    """(vertices, triangles) of the boundary of the unit cubes where the boolean array `full` is true: two triangles a square."""
    full = numpy.pad(full, 1)
    numbers, triangles = {}, []
    for axis in range(3):
        for side in (0, 1):
            beyond = numpy.roll(full, -1 if side else 1, axis)
            for cell in numpy.argwhere(full & ~beyond):
                corners = []
                for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    at = cell.copy()
                    at[axis] += side
                    at[(axis + 1) % 3] += u
                    at[(axis + 2) % 3] += v
                    corners.append(numbers.setdefault(tuple(at), len(numbers)))
                a, b, c, d = corners if side else corners[::-1]
                triangles += [(a, b, c), (a, c, d)]
    return numpy.array(list(numbers), float), numpy.array(triangles)


class ToSolidTest(DocumentTest):
    def mesh(self, vertices, triangles, name="Mesh"):
        obj = self.doc.addObject("Mesh::Feature", name)
        obj.Mesh = mesh_transfer.to_mesh(vertices, triangles)
        return obj

    def assertShape(self, obj, volume, faces, edges=None, vertices=None, solids=1, shells=1, relative=1e-6):
        self.assertTrue(obj.isValid(), obj.getStatusString())
        shape = obj.Shape
        self.assertTrue(shape.isValid())
        self.assertAlmostEqual(shape.Volume, volume, delta=relative * volume)
        self.assertEqual((len(shape.Faces), obj.Faces), (faces, faces))
        self.assertEqual((len(shape.Solids), len(shape.Shells)), (solids, shells))
        self.assertTrue(all(shell.isClosed() for shell in shape.Shells))
        if edges:
            self.assertEqual((len(shape.Edges), len(shape.Vertexes)), (edges, vertices))


class Shapes(ToSolidTest):
    def setUp(self):
        super().setUp()
        self.a = self.box(name="A")

    def test_cube(self):
        obj = scw.make_solid(self.mesh(*cubes(numpy.ones((5, 5, 5), bool))))
        self.assertEqual(obj.Shape.ShapeType, "Solid")
        self.assertShape(obj, 125, 6, 12, 8)

    def test_corner_cut_off(self):
        # Three more faces where the small cube was.
        obj = scw.make_solid(scw.make_cut(self.a, self.box(at=(5, 5, 5), name="B")))
        self.assertShape(obj, 875, 9, 21, 14)

    def test_through_hole(self):
        # Six sides, two of them with a hole, and four walls: genus one.
        obj = scw.make_solid(scw.make_cut(self.a, self.box((2, 2, 12), (4, 4, -1))))
        self.assertShape(obj, 960, 10, 24, 16)
        self.assertEqual(sorted(len(face.Wires) for face in obj.Shape.Faces), [1] * 8 + [2] * 2)

    def test_cavity(self):
        obj = scw.make_solid(scw.make_cut(self.a, self.box((2, 2, 2), (4, 4, 4))))
        self.assertShape(obj, 992, 12, 24, 16, shells=2)

    def test_two_components(self):
        obj = scw.make_solid(scw.make_union([self.a, self.box((1, 2, 3), (20, 0, 0))]))
        self.assertEqual(obj.Shape.ShapeType, "Compound")
        self.assertShape(obj, 1006, 12, 24, 16, solids=2, shells=2)

    def test_turned_parts_keep_their_planes(self):
        # The mesh's points are rounded to single precision: no four of them lie in one plane exactly.
        b = self.box((4, 4, 30), (3, 3, -10), name="B")
        for each in (self.a, b):
            each.Placement = FreeCAD.Placement(Vector(50, 60, 70), TURN) * each.Placement
        self.assertShape(scw.make_solid(scw.make_cut(self.a, b)), 1000 - 160, 10, 24, 16, relative=1e-5)

    def test_curved_result_keeps_its_triangles_where_it_is_curved(self):
        result = scw.make_cut(self.a, self.sphere(4, (5.1, 5.2, 10.3)), error=0.1)
        obj = scw.make_solid(result)
        self.assertShape(obj, result.Volume.Value, obj.Faces, relative=1e-5)
        self.assertEqual(len([face for face in obj.Shape.Faces if face.Area > 99]), 5)  # the sides that the ball leaves alone
        self.assertLess(obj.Faces, result.Triangles)

    def test_operations_of_part_go_on_from_there(self):
        solid = scw.make_solid(scw.make_cut(self.a, self.box(at=(5, 5, 5), name="B")))
        fused = solid.Shape.fuse(self.box((10, 10, 2), (0, 0, -2), name="C").Shape)
        self.assertAlmostEqual(fused.Volume, 1075, delta=1e-6)
        self.assertTrue(fused.isValid())

    def test_many_faces_are_quick(self):
        full = numpy.ones((37, 37, 1), bool)
        full[1::2, 1::2] = False  # 18 x 18 holes
        source = self.mesh(*cubes(full))
        start = time.monotonic()
        obj = scw.make_solid(source)
        seconds = time.monotonic() - start
        print("{} triangles to a solid of {} faces: {:.2f} s".format(source.Mesh.CountFacets, obj.Faces, seconds))
        self.assertShape(obj, 37 * 37 - 18 * 18, 6 + 4 * 18 * 18)

    def test_stairs(self):
        # Columns whose heights rise along x: no two cubes meet in an edge or a corner only. Every rise is a wall of its own.
        heights = numpy.sort(numpy.random.default_rng(1).integers(1, 12, (24, 24)), axis=0)
        vertices, triangles = cubes(numpy.arange(12) < heights[:, :, None])
        source = self.mesh(vertices, triangles)
        start = time.monotonic()
        obj = scw.make_solid(source)
        print("{} triangles to a solid of {} faces: {:.2f} s".format(len(triangles), obj.Faces, time.monotonic() - start))
        self.assertShape(obj, heights.sum(), obj.Faces)
        level = {round(face.BoundBox.ZMax) for face in obj.Shape.Faces if face.BoundBox.ZLength < 0.1}
        self.assertEqual(len(level), 1 + len(numpy.unique(heights)))  # the bottom, and every height


class Parametric(ToSolidTest):
    def setUp(self):
        super().setUp()
        self.a, self.b = self.box(name="A"), self.box(at=(5, 5, 5), name="B")
        self.result = scw.make_cut(self.a, self.b)

    def test_follows_its_source(self):
        obj = scw.make_solid(self.result)
        self.b.Placement.Base = Vector(8, 8, 8)
        self.doc.recompute()
        self.assertShape(obj, 992, 9)
        self.assertFalse(self.result.Visibility)

    def test_own_placement_survives(self):
        obj = scw.make_solid(self.result)
        obj.Placement.Base = Vector(0, 0, 50)
        self.b.Placement.Base = Vector(8, 8, 8)
        self.doc.recompute()
        self.assertAlmostEqual(obj.Shape.BoundBox.ZMin, 50)

    def test_placement_of_the_source_counts(self):
        self.result.Placement = FreeCAD.Placement(Vector(0, 0, 50), TURN)
        obj = scw.make_solid(self.result)
        self.assertShape(obj, 875, 9)
        centre = self.result.Placement.multVec(Vector(5, 5, 5) * (1000 / 875) - Vector(7.5, 7.5, 7.5) * (125 / 875))
        self.assertLess((obj.Shape.CenterOfMass - centre).Length, 1e-4)

    def test_in_the_container_of_its_source(self):
        part = self.part([self.a, self.b, self.result], (100, 0, 0), TURN)
        obj = scw.make_solid(self.result)
        self.assertIs(obj.getParentGeoFeatureGroup(), part)
        self.assertAlmostEqual(obj.Shape.BoundBox.XMin, 0, delta=1e-5)

    def test_link_to_a_mesh(self):
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = self.result
        link.Placement.Base = Vector(0, 100, 0)
        self.doc.recompute()
        obj = scw.make_solid(link)
        self.assertShape(obj, 875, 9)
        self.assertAlmostEqual(obj.Shape.BoundBox.YMin, 100, delta=1e-4)

    def test_saved_and_reopened(self):
        scw.make_solid(self.result, label="Block")
        self.reopened()
        obj = self.doc.getObjectsByLabel("Block")[0]
        self.assertShape(obj, 875, 9)
        self.assertNotIn("Touched", obj.State)
        self.doc.B.Placement.Base = Vector(8, 8, 8)
        self.doc.recompute()
        self.assertShape(obj, 992, 9)

    def test_tolerance_merges_what_is_nearly_flat(self):
        vertices, triangles = cubes(numpy.ones((4, 4, 4), bool))
        vertices[(vertices == (3, 3, 5)).all(axis=1)] += (0, 0, 0.01)  # a dent in the top
        obj = scw.make_solid(self.mesh(vertices, triangles))
        self.assertGreater(obj.Faces, 6)
        obj.Tolerance = 0.02
        self.doc.recompute()
        self.assertShape(obj, 64, 6, relative=1e-3)


class Refusal(ToSolidTest):
    def refused(self, source):
        obj = scw.make_solid(source)
        self.assertFalse(obj.isValid())
        self.assertTrue(source.Visibility)
        return obj.getStatusString()

    def test_open_mesh_says_where(self):
        vertices, triangles = cubes(numpy.ones((1, 1, 1), bool))
        self.assertRegex(self.refused(self.mesh(vertices, triangles[1:])), "3 open edges")

    def test_empty_mesh(self):
        self.assertIn("empty", self.refused(self.doc.addObject("Mesh::Feature", "Mesh")))

    def test_crossing_components(self):
        mesh = Mesh.createBox(10, 10, 10)
        other = Mesh.createBox(10, 10, 10)
        other.translate(3, 4, 5)
        mesh.addMesh(other)
        source = self.doc.addObject("Mesh::Feature", "Mesh")
        source.Mesh = mesh
        self.assertRegex(self.refused(source), "intersect|cross|meet")

    def test_failure_keeps_the_last_shape(self):
        source = self.mesh(*cubes(numpy.ones((2, 2, 2), bool)))
        obj = scw.make_solid(source)
        vertices, triangles = cubes(numpy.ones((2, 2, 2), bool))
        source.Mesh = mesh_transfer.to_mesh(vertices, triangles[1:])
        source.touch()  # FreeCAD does not see it by itself
        self.doc.recompute()
        self.assertFalse(obj.isValid())
        self.assertAlmostEqual(obj.Shape.Volume, 8)

    def test_wrong_arguments_leave_the_document_alone(self):
        box = self.box()
        before = len(self.doc.Objects)
        self.assertRaises(ValueError, lambda: scw.make_solid(box))
        self.assertRaises(TypeError, lambda: scw.make_solid("Box"))
        self.assertRaises(TypeError, lambda: scw.make_solid(None))
        self.assertEqual(len(self.doc.Objects), before)
