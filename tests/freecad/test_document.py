"""Life in a document: parametric change, failure, undo, saving, opening."""
import json

import FreeCAD
from FreeCAD import Vector
from support import DocumentTest, snapshot

import starcell_workbench as scw


class Parametric(DocumentTest):
    def setUp(self):
        super().setUp()
        self.a, self.b = self.box(name="A"), self.box(at=(5, 5, 5), name="B")

    def test_operand_changes(self):
        obj = scw.make_union([self.a, self.b])
        self.b.Placement.Base = Vector(8, 8, 8)
        self.doc.recompute()
        self.assertSolid(obj, 2000 - 8)

    def test_error_changes(self):
        obj = scw.make_cut(self.a, self.sphere(4, (1.3, 2.1, 0.7)))
        coarse = obj.Triangles
        obj.Error = "0.01 mm"
        self.doc.recompute()
        self.assertGreater(obj.Triangles, coarse)
        self.assertLessEqual(obj.ErrorBound.Value, 0.01)

    def test_operands_are_exchanged(self):
        obj = scw.make_union([self.a, self.b])
        obj.Operands = [self.a, self.b, self.box((1, 1, 1), (-20, 0, 0), name="C")]
        self.doc.recompute()
        self.assertSolid(obj, 1876, components=2, genus=(0, 0))

    def test_untouched_objects_are_not_computed_again(self):
        obj = scw.make_union([self.a, self.b])
        seconds = obj.Seconds
        self.box(at=(50, 0, 0), name="C")
        self.assertEqual(obj.Seconds, seconds)
        self.assertIn("Up-to-date", obj.State)

    def test_same_input_gives_the_same_mesh(self):
        obj = scw.make_cut(self.a, self.sphere(4, (1.3, 2.1, 0.7)))
        first = snapshot(obj)[:2]
        obj.touch()
        self.doc.recompute()
        self.assertEqual(snapshot(obj)[:2], first)

    def test_expression_drives_the_error(self):
        obj = scw.make_union([self.a, self.b])
        obj.setExpression("Error", "<<A>>.Length / 50")
        self.doc.recompute()
        self.assertAlmostEqual(json.loads(obj.Certificate)["requested_error"], 0.2)


class Failure(DocumentTest):
    def setUp(self):
        super().setUp()
        self.a, self.b = self.box(name="A"), self.box(at=(5, 5, 5), name="B")
        self.obj = scw.make_union([self.a, self.b])

    def break_it(self):
        self.obj.Operands = [self.a, self.doc.addObject("App::FeaturePython", "Note")]
        self.doc.recompute()
        self.assertFalse(self.obj.isValid())

    def test_failed_recompute_keeps_the_last_result(self):
        before = snapshot(self.obj)
        self.break_it()
        self.assertEqual(snapshot(self.obj), before)

    def test_mended_operand_heals_the_object(self):
        self.break_it()
        self.obj.Operands = [self.a, self.b]
        self.doc.recompute()
        self.assertSolid(self.obj, 1875)

    def test_failure_survives_saving(self):
        self.break_it()
        before = snapshot(self.obj)
        obj = self.reopened().getObject("Union")
        self.assertEqual(snapshot(obj), before)
        self.doc.recompute()
        self.assertFalse(obj.isValid())
        self.assertEqual(snapshot(obj), before)

    def test_dependent_of_a_failed_result_keeps_its_last_result(self):
        outer = scw.make_cut(self.obj, self.box((20, 20, 5), name="C"))
        before = snapshot(outer)
        self.break_it()
        self.assertEqual(snapshot(outer), before)

    def test_missing_operands(self):
        self.obj.Operands = [self.a]
        self.doc.recompute()
        self.assertFalse(self.obj.isValid())
        self.assertIn("at least 2", self.obj.getStatusString())

    def test_deleted_operand(self):
        before = snapshot(self.obj)
        self.doc.removeObject("B")
        self.doc.recompute()
        self.assertFalse(self.obj.isValid())
        self.assertEqual(snapshot(self.obj), before)


class Undo(DocumentTest):
    def setUp(self):
        super().setUp()
        self.doc.UndoMode = 1
        self.a, self.b = self.box(name="A"), self.box(at=(5, 5, 5), name="B")

    def make(self):
        self.doc.openTransaction("Union")
        obj = scw.make_union([self.a, self.b])
        self.doc.commitTransaction()
        return obj

    def test_undo_and_redo_of_making(self):
        self.make()
        self.doc.undo()
        self.assertIsNone(self.doc.getObject("Union"))
        self.assertTrue(self.a.Visibility and self.b.Visibility)
        self.doc.redo()
        self.assertSolid(self.doc.getObject("Union"), 1875)

    def test_undo_of_a_change(self):
        obj = self.make()
        before = snapshot(obj)
        self.doc.openTransaction("Change")
        obj.Error = 0.01
        self.b.Placement.Base = Vector(8, 8, 8)
        self.doc.recompute()
        self.doc.commitTransaction()
        self.assertSolid(obj, 1992)
        self.doc.undo()
        self.assertEqual(snapshot(obj), before)


class Saved(DocumentTest):
    def test_every_value_comes_back(self):
        a, b = self.box(name="A"), self.box(at=(5, 5, 5), name="B")
        obj = scw.make_union([a, b], error="0.1 mm", contact="0.001 mm")
        obj.Placement.Base = Vector(1, 2, 3)
        self.doc.recompute()
        before = snapshot(obj)
        obj = self.reopened().getObject("Union")
        self.assertEqual(type(obj.Proxy).__name__, "Union")
        self.assertEqual(snapshot(obj), before)
        self.assertEqual([each.Name for each in obj.Operands], ["A", "B"])
        self.assertNotIn("Touched", obj.State)

    def test_reopened_object_recomputes(self):
        self.box(name="A")
        scw.make_cut(self.doc.A, self.box(at=(5, 5, 5), name="B"))
        self.reopened()
        self.doc.B.Placement.Base = Vector(8, 8, 8)
        self.doc.recompute()
        self.assertSolid(self.doc.Cut, 992)

    def test_reopened_container_still_drives_the_result(self):
        self.box(name="A")
        part = self.part([self.box(name="B")], (5, 5, 5))
        scw.make_intersection([self.doc.A, self.doc.B])
        name = part.Name
        self.reopened()
        self.doc.getObject(name).Placement.Base = Vector(8, 8, 8)
        self.doc.recompute()
        self.assertSolid(self.doc.Intersection, 8)

    def test_certificate_is_json_with_every_field(self):
        obj = scw.make_union([self.box(name="A"), self.box(at=(5, 5, 5), name="B")])
        certificate = json.loads(obj.Certificate)
        for name in ("verdict", "error_bound", "components", "genus", "euler_characteristic", "tessellated", "contacts", "unresolved", "statistics"):
            self.assertIn(name, certificate)
        self.assertEqual(certificate["euler_characteristic"], 2)
        self.assertEqual(certificate["error_bound"], obj.ErrorBound.Value)


class Start(DocumentTest):
    def test_package_metadata_supports_this_freecad(self):
        import os

        import starcell_workbench.resources as resources

        metadata = FreeCAD.Metadata(os.path.join(resources.ROOT, "package.xml"))
        self.assertEqual(metadata.Name, "StarCell")
        self.assertTrue(metadata.supportsCurrentFreeCAD())

    def test_missing_engine_is_a_sentence(self):
        import sys

        from starcell_workbench import engine

        loaded, folders, path = sys.modules.pop("starcell", None), engine.folders, list(sys.path)
        try:
            engine.folders = lambda: ["nowhere"]
            sys.path[:] = [each for each in sys.path if "starcell" not in each.lower() and not each.endswith(os_lib())]
            with self.assertRaises(engine.EngineMissing) as caught:
                engine.load()
            self.assertIn("not built", str(caught.exception))
        finally:
            engine.folders, sys.path[:] = folders, path
            if loaded:
                sys.modules["starcell"] = loaded


def os_lib():
    import os

    return os.path.join("build", "lib")
