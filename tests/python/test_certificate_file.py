"""Certificate.save() and check_certificate(): honest files pass, every kind of tampering is found, nonsense is refused."""
import json
import math
import os
import tempfile
import unittest

import numpy as np
import starcell as sc

from models import rotation, sphere_mesh

UNIT = sc.Box((0, 0, 0), (1, 1, 1))
CORNER = sc.Box((0.5, 0.25, 0.125), (2, 2, 2))
THROUGH = sc.Box((0.25, 0.25, -1), (0.75, 0.75, 2))  # drills UNIT from below to above
BALL = sc.Polyhedron(*sphere_mesh(2, 0.6))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "result.certificate")

    def save(self, solid, **options):
        result = sc.evaluate(solid, **{"error": 0.05, **options})
        result.certificate.save(self.path)
        return result

    def saved(self):
        with open(self.path, encoding="utf-8") as file:
            return json.load(file)

    def check(self, data=None):
        """The answers by name, after the file was replaced by `data`."""
        if data is not None:
            with open(self.path, "w", encoding="utf-8") as file:
                json.dump(data, file)
        report = sc.check_certificate(self.path)
        self.assertEqual(report.ok, all(claim.holds is not False for claim in report.claims))
        self.assertEqual(bool(report), report.ok)
        return {claim.name: claim.holds for claim in report.claims}

    def assert_holds(self, solid, **options):
        self.save(solid, **options)
        report = sc.check_certificate(self.path)
        self.assertTrue(report.complete, str(report))


class Honest(Files):
    def test_every_claim_holds_for_each_operation(self):
        for solid in (UNIT | CORNER, UNIT & CORNER, UNIT - CORNER, UNIT - THROUGH):
            self.assert_holds(solid)

    def test_turned_solids(self):
        turn = rotation((1, 2, 3), 0.7)
        self.assert_holds((UNIT - THROUGH).transformed(turn) | BALL)

    def test_many_operands_half_spaces_and_complements(self):
        cut = sc.HalfSpace((0.1, 0.2, 0.7), (1, 2, 3))
        self.assert_holds(UNIT & cut)
        # Off the cube's planes: where the ball's vertices lie on them the verdict is `contact`, and less can be checked.
        ball = BALL.transformed([[1, 0, 0, 0.013], [0, 1, 0, 0.021], [0, 0, 1, 0.034], [0, 0, 0, 1]])
        self.assert_holds(sc.union([UNIT, ball, CORNER]) & ~cut)
        self.assert_holds(~(~UNIT | THROUGH | ~cut))  # = UNIT - THROUGH inside cut

    def test_a_far_half_space_changes_nothing(self):
        self.assert_holds(UNIT & sc.HalfSpace((0, 0, 1000), (0, 0, 1)))

    def test_nothing_is_certified_to_be_nothing(self):
        self.assert_holds(UNIT & sc.Box((3, 3, 3), (4, 4, 4)))

    def test_topology_only(self):
        self.assert_holds(UNIT - THROUGH, error=math.inf)

    def test_a_cavity_is_a_component_of_its_own(self):
        self.assert_holds(UNIT - sc.Box((0.25, 0.25, 0.25), (0.75, 0.75, 0.75)))

    def test_contact_is_checked_by_volume(self):
        self.save(UNIT | sc.Box((1, 0, 0), (2, 1, 1)))
        report = sc.check_certificate(self.path)
        self.assertTrue(report.ok, str(report))

    def test_the_certificate_outlives_its_result(self):
        certificate = sc.evaluate(UNIT - THROUGH, error=0.05).certificate
        certificate.save(self.path)
        self.assertTrue(sc.check_certificate(self.path).complete)


class Content(Files):
    def test_every_double_reads_back_the_same(self):
        solid = BALL.transformed(rotation((3, 1, 2), 0.4))
        result = self.save(solid - THROUGH, error=1 / 30)
        data = self.saved()
        self.assertTrue(np.array_equal(np.array(data["result"]["vertices"]), result.vertices))
        self.assertTrue(np.array_equal(np.array(data["result"]["triangles"]), result.triangles))
        stored = [np.array(operand["mesh"]["vertices"]) for operand in data["operands"]]
        self.assertTrue(any(np.array_equal(vertices, solid.vertices) for vertices in stored))
        fields, certificate = data["certificate"], result.certificate
        for name in ("verdict", "error_bound", "requested_error", "contact_tolerance", "components", "genus",
                     "euler_characteristic", "statistics"):
            self.assertEqual(fields[name], getattr(certificate, name), name)
        self.assertEqual(data["options"], {"error": 1 / 30, "contact": None})

    def test_a_solid_used_twice_is_stored_once(self):
        self.save((UNIT - CORNER) | (UNIT & CORNER))
        self.assertEqual(len(self.saved()["operands"]), 2)


class Tampered(Files):
    def setUp(self):
        super().setUp()
        self.save(UNIT - THROUGH)
        self.data = self.saved()

    def test_a_vertex_moved_by_more_than_the_bound(self):
        # In no plane of the solid: along one, the vertex would stay on the surface, and the check is no finer than its text says.
        vertex = self.data["result"]["vertices"][0]
        for axis, move in enumerate((0.001, 0.0007, 0.0004)):
            vertex[axis] += move
        self.assertIs(self.check(self.data)["distance"], False)

    def test_a_vertex_moved_through_the_far_side(self):
        self.data["result"]["vertices"][0] = [5.0, 5.0, 0.5]
        answers = self.check(self.data)
        self.assertIs(answers["distance"], False)
        self.assertIs(answers["volume"], False)

    def test_a_removed_triangle(self):
        del self.data["result"]["triangles"][3]
        self.assertIs(self.check(self.data)["manifold"], False)

    def test_a_reversed_triangle(self):
        self.data["result"]["triangles"][3].reverse()
        self.assertIs(self.check(self.data)["manifold"], False)

    def test_an_inside_out_result(self):
        for triangle in self.data["result"]["triangles"]:
            triangle.reverse()
        answers = self.check(self.data)
        self.assertIs(answers["embedded"], False)
        self.assertIs(answers["volume"], False)

    def test_changed_counts(self):
        for field, value in (("genus", [0]), ("components", 2), ("euler_characteristic", 2)):
            data = json.loads(json.dumps(self.data))
            data["certificate"][field] = value
            self.assertIs(self.check(data)["counts"], False, field)

    def test_another_mesh_with_other_topology(self):
        vertices, triangles = UNIT.vertices.tolist(), UNIT.triangles.tolist()
        self.data["result"] = {"vertices": vertices, "triangles": triangles}
        self.data["certificate"].update(genus=[0], euler_characteristic=2)
        answers = self.check(self.data)
        self.assertIs(answers["counts"], True)
        self.assertIs(answers["topology"], False)

    def test_another_expression(self):
        self.data["operands"][1]["mesh"]["vertices"] = (THROUGH.vertices * 0.5).tolist()
        self.assertIs(sc.check_certificate(self.path).ok, True)
        answers = self.check(self.data)
        self.assertIn(False, (answers["topology"], answers["distance"], answers["volume"]))

    def test_a_bound_above_the_error(self):
        self.data["certificate"]["error_bound"] = 0.06
        self.assertIs(self.check(self.data)["error bound"], False)

    def test_a_hidden_tessellation(self):
        self.data["operands"][0]["deflection"] = 0.01
        self.assertIs(self.check(self.data)["tessellated"], False)

    def test_a_hidden_unresolved_cell(self):
        self.data["certificate"]["unresolved"] = [{"lower": [0, 0, 0], "upper": [1, 1, 1]}]
        self.assertIs(self.check(self.data)["verdict"], False)

    def test_an_operand_that_is_no_solid(self):
        del self.data["operands"][0]["mesh"]["triangles"][0]
        answers = self.check(self.data)
        self.assertIs(answers["operands"], False)
        self.assertIsNone(answers["topology"])

    def test_two_vertices_that_float32_cannot_tell_apart(self):
        # A sliver of the width 1e-12 around 1: fine in double, degenerate in float32. Split the first triangle's edge.
        mesh = self.data["result"]
        a, b, c = mesh["triangles"][0]
        point = np.array(mesh["vertices"][a]) + 1e-12 * (np.mean([mesh["vertices"][k] for k in (a, b, c)], axis=0)
                                                        - np.array(mesh["vertices"][a]))
        new = len(mesh["vertices"])
        mesh["vertices"].append(point.tolist())
        mesh["triangles"][0:1] = [[a, b, new], [b, c, new], [c, a, new]]
        self.assertIs(self.check(self.data)["embedded in float32"], False)


class Unchecked(Files):
    def test_without_an_expression_the_mesh_alone_is_checked(self):
        self.save(UNIT - THROUGH)
        answers = self.check({**self.saved(), "expression": []})
        self.assertIs(answers["counts"], True)
        self.assertEqual([answers[name] for name in ("topology", "distance", "volume")], [None] * 3)

    def test_an_exact_result_that_is_no_manifold(self):
        self.save(UNIT | sc.Box((1, 1, 0), (2, 2, 1)))  # edge to edge
        report = sc.check_certificate(self.path)
        self.assertTrue(report.ok, str(report))
        self.assertFalse(report.complete)
        self.assertTrue(all(claim.detail for claim in report.claims))


class Malformed(Files):
    def refuse(self, text, says=""):
        with open(self.path, "wb") as file:
            file.write(text if isinstance(text, bytes) else text.encode())
        with self.assertRaises(sc.FileError) as caught:
            sc.check_certificate(self.path)
        self.assertIn(says, str(caught.exception))

    def test_what_is_no_certificate(self):
        for text in ("", "{", "[]", "{}", "null", "7", b"\xff\xfe\x00", '{"format": 3}', "[" * 100000, "[" * 100000 + "]" * 100000, "1e999"):
            self.refuse(text)
        self.refuse('{"format": "starcell-certificate", "version": 99}', "version")

    def test_no_file(self):
        for path in (self.path, os.path.dirname(self.path)):
            with self.assertRaises(sc.FileError):
                sc.check_certificate(path)

    def test_no_place_to_save(self):
        certificate = sc.evaluate(UNIT, error=0.05).certificate
        with self.assertRaises(sc.FileError):
            certificate.save(os.path.join(self.path, "missing", "file"))
        with self.assertRaises(sc.FileError):
            certificate.save(os.path.dirname(self.path))

    def test_every_value_replaced_by_nonsense_is_refused_or_judged(self):
        self.save(UNIT & sc.HalfSpace((0, 0, 0.25), (0, 0, 1)))
        text = json.dumps(self.saved())

        def places(value, path=()):
            yield path
            items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
            for k, (key, inner) in enumerate(items):
                if k < 3 or isinstance(value, dict):
                    yield from places(inner, path + (key,))

        judged = refused = 0
        for path in places(json.loads(text)):
            for nonsense in (None, -1, 1e300, 4294967296, "x", [], {}, [[]]):
                data = json.loads(text)
                if not path:
                    data = nonsense
                else:
                    inner = data
                    for key in path[:-1]:
                        inner = inner[key]
                    inner[path[-1]] = nonsense
                with open(self.path, "w", encoding="utf-8") as file:
                    json.dump(data, file)
                try:
                    sc.check_certificate(self.path)
                    judged += 1
                except sc.FileError:
                    refused += 1
        self.assertGreater(refused, 300)
        self.assertGreater(judged, 0)


if __name__ == "__main__":
    unittest.main()
