"""What can be an operand, and where it is: containers, links, meshes, bodies, other results, and what is refused."""
import FreeCAD
import Mesh
import Part
from FreeCAD import Rotation, Vector
from support import DocumentTest

import starcell_workbench as scw

TURN = Rotation(Vector(1, 2, 3), 40)


class Placements(DocumentTest):
    def test_own_placement_counts(self):
        a, b = self.box(name="A"), self.box(name="B")
        b.Placement = FreeCAD.Placement(Vector(5, 5, 5), Rotation())
        self.assertSolid(scw.make_union([a, b]), 1875)

    def test_rotated_together_volume_stays(self):
        a, b = self.box(name="A"), self.box(name="B")
        a.Placement = FreeCAD.Placement(Vector(), TURN)
        b.Placement = FreeCAD.Placement(TURN.multVec(Vector(5, 5, 5)), TURN)
        self.assertSolid(scw.make_union([a, b]), 1875, relative=1e-5)

    def test_operand_in_nested_containers(self):
        # The box comes to (5, 5, 5) only through both containers.
        a, b = self.box(name="A"), self.box(at=(1, 1, 1), name="B")
        self.part([self.part([b], (1, 1, 1), name="Inner")], (3, 3, 3), name="Outer")
        self.assertSolid(scw.make_intersection([a, b]), 125)

    def test_moving_a_container_recomputes(self):
        a, b = self.box(name="A"), self.box(name="B")
        part = self.part([b], (5, 5, 5))
        obj = scw.make_intersection([a, b])
        part.Placement.Base = Vector(8, 8, 8)
        self.doc.recompute()
        self.assertSolid(obj, 8)

    def test_result_in_the_container_of_its_operands(self):
        # Computed in the container's own coordinates: it moves with them, without a recompute of the mesh.
        a, b = self.box(name="A"), self.box(at=(5, 5, 5), name="B")
        part = self.part([a, b], (100, 0, 0), TURN)
        obj = scw.make_intersection([a, b])
        self.assertIs(obj.getParentGeoFeatureGroup(), part)
        self.assertSolid(obj, 125)
        part.Placement = FreeCAD.Placement(Vector(200, 0, 0), Rotation())
        self.doc.recompute()
        self.assertBox(obj, (205, 5, 5), (210, 10, 10))

    def test_placement_of_the_result_survives_recompute(self):
        a, b = self.box(name="A"), self.box(at=(5, 5, 5), name="B")
        obj = scw.make_intersection([a, b])
        obj.Placement.Base = Vector(0, 0, 50)
        b.Length = 20
        self.doc.recompute()
        self.assertBox(obj, (5, 5, 55), (10, 10, 60))

    def test_moving_a_result_moves_what_is_built_on_it_and_computes_only_that(self):
        inner = scw.make_union([self.box(name="A"), self.box(at=(5, 5, 5), name="B")])
        obj = scw.make_intersection([inner, self.box((30, 30, 4), (-9, -9, -9), name="C")])
        self.assertEqual(obj.Triangles, 0)
        calls = []
        execute = type(inner.Proxy).execute
        try:
            type(inner.Proxy).execute = lambda proxy, each: calls.append(each) or execute(proxy, each)
            inner.Placement.Base = Vector(0, 0, -9)
            self.doc.recompute()
        finally:
            type(inner.Proxy).execute = execute
        self.assertEqual(calls, [])
        self.assertSolid(obj, 400, verdicts=("exact", "contact"))


class Kinds(DocumentTest):
    def setUp(self):
        super().setUp()
        self.a = self.box(name="A")

    def test_mesh(self):
        mesh = self.doc.addObject("Mesh::Feature", "Mesh")
        mesh.Mesh = Mesh.createBox(10, 10, 10)  # around the origin: an eighth of it is inside A
        self.assertSolid(scw.make_intersection([self.a, mesh]), 125)

    def test_moved_mesh(self):
        mesh = self.doc.addObject("Mesh::Feature", "Mesh")
        mesh.Mesh = Mesh.createBox(4, 4, 4)
        mesh.Placement.Base = Vector(10, 5, 5)  # half of it is inside A
        self.assertSolid(scw.make_intersection([self.a, mesh]), 32)

    def test_inverted_mesh_is_turned(self):
        mesh = self.doc.addObject("Mesh::Feature", "Mesh")
        flipped = Mesh.createBox(10, 10, 10)
        flipped.flipNormals()
        mesh.Mesh = flipped
        self.assertSolid(scw.make_intersection([self.a, mesh]), 125)

    def test_link(self):
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = self.a
        link.Placement.Base = Vector(5, 5, 5)
        self.assertSolid(scw.make_union([self.a, link]), 1875)

    def test_link_to_a_mesh(self):
        mesh = self.doc.addObject("Mesh::Feature", "Mesh")
        mesh.Mesh = Mesh.createBox(4, 4, 4)
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = mesh
        link.Placement.Base = Vector(10, 5, 5)
        self.assertSolid(scw.make_intersection([self.a, link]), 32)

    def test_link_that_adds_to_the_placement_of_a_mesh(self):
        mesh = self.doc.addObject("Mesh::Feature", "Mesh")
        mesh.Mesh = Mesh.createBox(4, 4, 4)
        mesh.Placement.Base = Vector(0, 5, 5)
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = mesh
        link.LinkTransform = True
        link.Placement.Base = Vector(10, 0, 0)
        self.assertSolid(scw.make_intersection([self.a, link]), 32)

    def test_link_array(self):
        # Three slots of 1 x 20 x 20, 3 apart, cut the block: 1000 - 3 * 100, four plates.
        slot = self.box((1, 20, 20), (2, -5, -5), name="Slot")
        array = self.doc.addObject("App::Link", "Array")
        array.LinkedObject = slot
        array.LinkTransform = True
        array.ElementCount = 3
        for k, element in enumerate(array.ElementList):
            element.Placement.Base = Vector(3 * k, 0, 0)
        self.doc.recompute()
        self.assertSolid(scw.make_cut(self.a, array), 700, components=4, genus=(0,) * 4)

    def test_container_is_the_union_of_its_visible_solids(self):
        part = self.part([self.box((2, 2, 20), (1, 1, -5)), self.box((2, 2, 20), (6, 6, -5)), self.box((50, 50, 50), name="Hidden")])
        self.doc.getObject("Hidden").Visibility = False
        part.addObject(self.doc.addObject("Sketcher::SketchObject", "Sketch"))
        self.assertSolid(scw.make_cut(self.a, part), 1000 - 80, genus=(2,))

    def test_container_of_meshes_and_shapes(self):
        mesh = self.doc.addObject("Mesh::Feature", "Mesh")
        mesh.Mesh = Mesh.createBox(2, 2, 20)
        mesh.Placement.Base = Vector(2, 2, 5)
        part = self.part([mesh, self.box((2, 2, 20), (6, 6, -5))])
        self.assertSolid(scw.make_cut(self.a, part), 1000 - 80, genus=(2,))

    def test_change_inside_a_container_and_behind_a_link(self):
        hole = self.box((2, 2, 20), (1, 1, -5), name="Hole")
        part = self.part([hole])
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = part
        link.Placement.Base = Vector(4, 4, 0)
        obj = scw.make_cut(self.a, [part, link])
        self.assertSolid(obj, 920, genus=(2,))
        hole.Length = 3
        self.doc.recompute()
        self.assertSolid(obj, 880, genus=(2,))

    def test_link_to_a_container(self):
        part = self.part([self.box((2, 2, 20), (1, 1, -5))])
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = part
        link.Placement.Base = Vector(3, 3, 0)
        obj = scw.make_cut(self.a, link)
        self.assertSolid(obj, 960, genus=(1,))

    def test_group_inside_a_container_counts_once(self):
        group = self.doc.addObject("App::DocumentObjectGroup", "Group")
        part = self.part([group], (1, 1, 0))
        group.addObject(self.box((2, 2, 20), (0, 0, -5)))
        self.assertSolid(scw.make_cut(self.a, part), 960, genus=(1,))

    def test_body(self):
        body = self.doc.addObject("PartDesign::Body", "Body")
        pad = body.newObject("PartDesign::AdditiveBox", "Pad")
        pad.Length = pad.Width = pad.Height = 10
        body.Placement.Base = Vector(5, 5, 5)
        self.doc.recompute()
        self.assertSolid(scw.make_union([self.a, body]), 1875)

    def test_feature_inside_a_body(self):
        body = self.doc.addObject("PartDesign::Body", "Body")
        pad = body.newObject("PartDesign::AdditiveBox", "Pad")
        pad.Length = pad.Width = pad.Height = 10
        body.Placement.Base = Vector(5, 5, 5)
        self.doc.recompute()
        self.assertSolid(scw.make_union([self.a, pad]), 1875)

    def test_compound_of_solids(self):
        compound = self.doc.addObject("Part::Feature", "Compound")
        compound.Shape = Part.makeCompound([Part.makeBox(2, 2, 20, Vector(1, 1, -5)), Part.makeBox(2, 2, 20, Vector(6, 6, -5))])
        self.assertSolid(scw.make_cut(self.a, compound), 920, genus=(2,))

    def test_another_result(self):
        inner = scw.make_union([self.a, self.box(at=(5, 5, 5), name="B")])
        obj = scw.make_cut(inner, self.box((30, 30, 5), (-1, -1, -1), name="C"))  # takes A below 4
        self.assertSolid(obj, 1875 - 400)
        self.assertIn("'Union' is taken as its mesh", obj.Report)

    def test_change_runs_through_nested_results(self):
        b = self.box(at=(5, 5, 5), name="B")
        obj = scw.make_cut(scw.make_union([self.a, b]), self.box((30, 30, 5), (-1, -1, -1), name="C"))
        b.Height = 20
        self.doc.recompute()
        self.assertSolid(obj, 1000 + 2000 - 125 - 400)


class Refused(DocumentTest):
    """The object is invalid, says why and names the operand; the rest of the document is as it was."""

    def refuse(self, operand, *words):
        a = self.box(name="A")
        before = (a.Shape.Volume, str(a.Placement), operand.State)
        obj = scw.make_union([a, operand])
        self.assertFalse(obj.isValid())
        self.assertIn("Invalid", obj.State)
        for word in (operand.Label, *words):
            self.assertIn(word, obj.getStatusString())
        self.assertEqual(obj.Mesh.CountFacets, 0)
        self.assertEqual((a.Shape.Volume, str(a.Placement), operand.State), before)
        self.assertTrue(a.isValid())

    def test_sketch(self):
        sketch = self.doc.addObject("Sketcher::SketchObject", "Sketch")
        sketch.addGeometry(Part.LineSegment(Vector(0, 0, 0), Vector(1, 0, 0)), False)
        self.doc.recompute()
        self.refuse(sketch, "no solid")

    def test_empty_shape(self):
        self.refuse(self.doc.addObject("Part::Feature", "Nothing"), "no solid")

    def test_surface(self):
        plane = self.doc.addObject("Part::Plane", "Sheet")
        self.doc.recompute()
        self.refuse(plane, "no solid")

    def test_object_without_geometry(self):
        self.refuse(self.doc.addObject("App::FeaturePython", "Note"), "no solid")

    def test_open_mesh(self):
        mesh = self.doc.addObject("Mesh::Feature", "Leaky")
        leaky = Mesh.createBox(1, 1, 1)
        leaky.removeFacets([0])
        mesh.Mesh = leaky
        self.refuse(mesh, "open")

    def test_empty_mesh(self):
        self.refuse(self.doc.addObject("Mesh::Feature", "Void"), "empty")

    def test_empty_container(self):
        self.refuse(self.doc.addObject("App::Part", "Hollow"), "no solid")

    def test_broken_operand(self):
        broken = self.doc.addObject("Part::Cut", "Broken")  # has neither base nor tool
        self.doc.recompute()
        obj = scw.make_union([self.box(name="A"), broken])
        # FreeCAD itself leaves out what depends on a failed object.
        self.assertNotIn("Up-to-date", obj.State)
        self.assertEqual(obj.Mesh.CountFacets, 0)
