"""Every public name is documented, and the exceptions form the promised tree."""
import inspect
import re
import unittest

import starcell as sc

SHAPES_OR_UNITS = re.compile(r"\(\w+,|shape|units|seconds|bytes|levels|number|rows?\b", re.IGNORECASE)
PUBLIC = [name for name in dir(sc) if not name.startswith("_")]


def members(owner):
    for name, member in vars(owner).items():
        if not name.startswith("_") or name in ("__or__", "__and__", "__sub__", "__invert__"):
            yield f"{owner.__name__}.{name}", member


class Docstrings(unittest.TestCase):
    def check(self, name, thing):
        doc = inspect.getdoc(thing)
        self.assertTrue(doc, f"{name} has no docstring")
        self.assertRegex(doc, SHAPES_OR_UNITS, f"{name}: no word about shapes or units")

    def test_names_of_the_module(self):
        for name in PUBLIC:
            with self.subTest(name):
                self.check(name, getattr(sc, name))

    def test_members_of_the_classes(self):
        for owner in (getattr(sc, name) for name in PUBLIC):
            if inspect.isclass(owner) and not issubclass(owner, Exception):
                for name, member in members(owner):
                    with self.subTest(name):
                        self.check(name, member)

    def test_the_module_itself(self):
        self.check("starcell", sc)
        self.assertRegex(sc.__version__, r"^\d+\.\d+\.\d+$")

    def test_the_promised_names_are_there(self):
        promised = """Polyhedron read_mesh Box HalfSpace Sphere Ellipsoid Cylinder Cone Torus Quadric from_brep union intersection Budget evaluate offset shell minkowski_sum dilate erode opening closing penetration_depth Result Certificate Solid
                      Error InvalidSolidError UnboundedError CancelledError UnresolvedError FileError"""
        self.assertEqual(set(promised.split()) - set(PUBLIC), set())


class Exceptions(unittest.TestCase):
    def test_all_are_errors_of_starcell(self):
        for name in ("InvalidSolidError", "UnboundedError", "CancelledError", "UnresolvedError", "FileError"):
            self.assertTrue(issubclass(getattr(sc, name), sc.Error), name)
            self.assertEqual(getattr(sc, name).__module__, "starcell")

    def test_the_base_is_an_ordinary_exception(self):
        self.assertTrue(issubclass(sc.Error, Exception))
        self.assertFalse(issubclass(sc.Error, ValueError))

    def test_siblings_do_not_catch_one_another(self):
        with self.assertRaises(sc.InvalidSolidError) as caught:
            sc.Polyhedron([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        self.assertNotIsInstance(caught.exception, sc.FileError)
        self.assertIs(type(caught.exception), sc.InvalidSolidError)


if __name__ == "__main__":
    unittest.main()
