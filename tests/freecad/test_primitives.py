"""Part's primitives as operands: exact, whole or as sectors, wherever placements, links and containers put them."""
import json
import math
import tempfile

import FreeCAD
import Part
from FreeCAD import Rotation, Vector
from support import DocumentTest

import starcell_workbench as scw
from starcell_workbench import engine, mesh_transfer, operands, primitives

TURNED = FreeCAD.Placement(Vector(3, -4, 5), Rotation(Vector(1, 2, 3), 40))
WHOLE = (("Sphere", {"Radius": 4}, 4 / 3 * math.pi * 64),
         ("Ellipsoid", {"Radius1": 2, "Radius2": 4, "Radius3": 3}, 4 / 3 * math.pi * 24),
         ("Ellipsoid", {"Radius1": 2, "Radius2": 4, "Radius3": 0}, 4 / 3 * math.pi * 32),
         ("Cylinder", {"Radius": 3, "Height": 4}, 36 * math.pi), ("Cone", {"Radius1": 1, "Radius2": 3, "Height": 6}, 26 * math.pi),
         ("Cone", {"Radius1": 3, "Radius2": 0, "Height": 4}, 12 * math.pi), ("Torus", {"Radius1": 5, "Radius2": 2}, 40 * math.pi ** 2),
         ("Box", {"Length": 3, "Width": 5, "Height": 7}, 105))
SECTORS = (("Sphere", "Angle3"), ("Ellipsoid", "Angle3"), ("Cylinder", "Angle"), ("Cone", "Angle"), ("Torus", "Angle3"))


class PrimitiveTest(DocumentTest):
    def primitive(self, kind, placement=TURNED, **values):
        obj = self.doc.addObject("Part::" + kind, kind)
        for name, value in values.items():
            setattr(obj, name, value)
        obj.Placement = placement
        self.doc.recompute()
        return obj

    def result(self, obj, error=0.1):
        """The engine's result for an operand alone, whose result would lie outside of every container."""
        with tempfile.TemporaryDirectory() as folder:
            operand = operands.gather(obj, self.doc.addObject("App::FeaturePython", "Nowhere"), folder)
            return engine.load().evaluate(operand.solid(engine.load(), error / 4), error=error)

    def assertExact(self, obj, shape, volume=None, verdicts=("exact",)):
        """The operand is the shape, without tessellation: every vertex lies near its surface, and the volume fits."""
        result = self.result(obj)
        certificate = result.certificate
        self.assertEqual(list(certificate.tessellated), [])
        self.assertIn(certificate.verdict, verdicts)
        got = mesh_transfer.volume(result.vertices, result.triangles)
        area = mesh_transfer.area(result.vertices, result.triangles)
        self.assertAlmostEqual(got, shape.Volume if volume is None else volume, delta=certificate.error_bound * area + 1e-9)
        step = max(1, len(result.vertices) // 40)
        for point in result.vertices[::step]:
            distance = min(face.distToShape(Part.Vertex(*map(float, point)))[0] for face in shape.Faces)
            self.assertLessEqual(distance, certificate.error_bound + 1e-6)


class Exact(PrimitiveTest):
    def test_whole(self):
        for kind, values, volume in WHOLE:
            with self.subTest(kind, **values):
                obj = self.primitive(kind, **values)
                self.assertAlmostEqual(obj.Shape.Volume, volume, delta=1e-3 * volume)  # OpenCASCADE integrates splines no better
                self.assertExact(obj, obj.Shape, volume)

    def test_sectors(self):
        # A cone's sector ends in an apex of five faces, and so may count as touching there.
        for kind, name in SECTORS:
            for angle in (37, 90, 180, 200, 270):
                with self.subTest(kind, angle=angle):
                    obj = self.primitive(kind, **{name: angle})
                    self.assertExact(obj, obj.Shape, verdicts=("exact", "contact"))

    def test_operation_reports_no_tessellation(self):
        for kind in ("Sphere", "Ellipsoid", "Cylinder", "Cone", "Torus"):
            with self.subTest(kind):
                obj = scw.make_union([self.primitive(kind), self.box((2, 2, 2), (90, 0, 0))])
                self.assertTrue(obj.isValid(), obj.getStatusString())
                self.assertEqual(json.loads(obj.Certificate)["tessellated"], [])

    def test_change_of_a_dimension(self):
        sphere = self.primitive("Sphere", Radius=4)
        obj = scw.make_union([sphere, self.box((2, 2, 2), (90, 0, 0))])
        sphere.Radius = 2
        self.doc.recompute()
        self.assertAlmostEqual(obj.Volume.Value, 8 + 32 / 3 * math.pi, delta=obj.ErrorBound.Value * 16 * math.pi)


class Placed(PrimitiveTest):
    def test_link(self):
        cone = self.primitive("Cone")
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = cone
        link.Placement = FreeCAD.Placement(Vector(20, 0, 1), Rotation(Vector(3, 0, 1), 70))
        shape = cone.Shape.copy()
        shape.Placement = link.Placement  # in place of the cone's own
        self.assertExact(link, shape)

    def test_link_that_adds_to_the_placement(self):
        cone = self.primitive("Cone")
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject, link.LinkTransform = cone, True
        link.Placement = FreeCAD.Placement(Vector(20, 0, 1), Rotation(Vector(3, 0, 1), 70))
        shape = cone.Shape.copy()
        shape.Placement = link.Placement * cone.Placement
        self.assertExact(link, shape)

    def test_stretched_link(self):
        sphere = self.primitive("Sphere", FreeCAD.Placement(), Radius=2)
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject, link.ScaleVector = sphere, Vector(1, 2, 3)
        stretch = FreeCAD.Matrix(1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0)
        self.assertExact(link, sphere.Shape.transformGeometry(stretch), 4 / 3 * math.pi * 48)

    def test_nested_containers(self):
        torus = self.primitive("Torus")
        inner = self.part([torus], (1, 2, 3), Rotation(Vector(0, 1, 1), 50), "Inner")
        outer = self.part([inner], (-7, 0, 2), Rotation(Vector(1, 0, 1), 110), "Outer")
        shape = torus.Shape.copy()
        shape.Placement = outer.Placement * inner.Placement * torus.Placement
        self.assertExact(torus, shape)
        self.assertExact(outer, shape)

    def test_link_array(self):
        cylinder = self.primitive("Cylinder", FreeCAD.Placement())
        array = self.doc.addObject("App::Link", "Array")
        array.LinkedObject, array.ElementCount = cylinder, 2
        array.ElementList[1].Placement = TURNED
        self.doc.recompute()
        second = cylinder.Shape.copy()
        second.Placement = TURNED
        self.assertExact(array, cylinder.Shape.fuse(second))


class TakenAsShape(PrimitiveTest):
    # What has no recipe is tessellated, as any other shape.

    def test_no_recipe(self):
        for kind, values in (("Sphere", {"Angle1": 0}), ("Sphere", {"Angle2": 45}), ("Ellipsoid", {"Angle1": -45}),
                             ("Torus", {"Angle2": 90}), ("Cylinder", {"FirstAngle": 20}), ("Cylinder", {"SecondAngle": 10}),
                             ("Torus", {"Radius1": 2, "Radius2": 3}), ("Sphere", {"Angle3": 1e-9}), ("Prism", {}), ("Wedge", {})):
            with self.subTest(kind, **values):
                self.assertIsNone(primitives.recipe(self.primitive(kind, **values)))

    def test_zone_of_a_sphere(self):
        # Half a ball, cut off along its equator.
        half = self.primitive("Sphere", FreeCAD.Placement(), Radius=3, Angle1=0)
        obj = scw.make_union([half, self.box((2, 2, 2), (90, 0, 0))], error=0.05)
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertAlmostEqual(obj.Volume.Value, 8 + 18 * math.pi, delta=0.05 * 27 * math.pi)

    def test_prism_is_exact_through_its_shape(self):
        prism = self.primitive("Prism", Circumradius=2, Height=5)
        self.assertExact(prism, prism.Shape, 6 * math.sqrt(3) * 5)
