"""CAD files from Python: what from_brep returns, what it refuses, and how it says so.

The shapes themselves are tested in C++ (tests/cad), where OpenCASCADE can model them. Here a tetrahedron in STEP, written
out below, is enough to see files, solids and errors go through."""
import pathlib
import tempfile
import unittest

import numpy as np
import starcell as sc

from models import volume

try:
    import starcell_cad
except ImportError:
    starcell_cad = None

CORNERS = [(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def tetrahedron_step(faces=FACES):
    """A STEP file of the tetrahedron's faces: a solid if they are all there."""
    lines = []

    def add(text):
        lines.append("#%d=%s;" % (len(lines) + 1, text))
        return "#%d" % len(lines)

    def direction(v):
        return add("DIRECTION('',(%r,%r,%r))" % tuple(float(x) for x in v / np.linalg.norm(v)))

    def point(p):
        return add("CARTESIAN_POINT('',(%r,%r,%r))" % tuple(float(x) for x in p))

    def references(names):
        return "(" + ",".join(names) + ")"

    corners = np.array(CORNERS, dtype=float)
    vertices = [add("VERTEX_POINT('',%s)" % point(c)) for c in corners]
    edges = {}

    def oriented_edge(a, b):
        low, high = sorted((a, b))
        if (low, high) not in edges:
            along = add("VECTOR('',%s,1.)" % direction(corners[high] - corners[low]))
            line = add("LINE('',%s,%s)" % (point(corners[low]), along))
            edges[low, high] = add("EDGE_CURVE('',%s,%s,%s,.T.)" % (vertices[low], vertices[high], line))
        return add("ORIENTED_EDGE('',*,*,%s,.%s.)" % (edges[low, high], "TF"[a > b]))

    shell = []
    for a, b, c in faces:
        loop = add("EDGE_LOOP('',%s)" % references([oriented_edge(a, b), oriented_edge(b, c), oriented_edge(c, a)]))
        bound = add("FACE_OUTER_BOUND('',%s,.T.)" % loop)
        normal = direction(np.cross(corners[b] - corners[a], corners[c] - corners[a]))
        place = add("AXIS2_PLACEMENT_3D('',%s,%s,%s)" % (point(corners[a]), normal, direction(corners[b] - corners[a])))
        shell.append(add("ADVANCED_FACE('',(%s),%s,.T.)" % (bound, add("PLANE('',%s)" % place))))
    if len(faces) == 4:
        body = add("MANIFOLD_SOLID_BREP('',%s)" % add("CLOSED_SHELL('',%s)" % references(shell)))
        kind = "ADVANCED_BREP_SHAPE_REPRESENTATION"
    else:
        body = add("SHELL_BASED_SURFACE_MODEL('',(%s))" % add("OPEN_SHELL('',%s)" % references(shell)))
        kind = "MANIFOLD_SURFACE_SHAPE_REPRESENTATION"
    length = add("(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.))")
    angle = add("(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.))")
    space = add("(NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT())")
    context = add("(GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNIT_ASSIGNED_CONTEXT(%s) REPRESENTATION_CONTEXT('',''))"
                  % references([length, angle, space]))
    shape = add("%s('',(%s),%s)" % (kind, body, context))
    application = add("APPLICATION_CONTEXT('design')")
    product = add("PRODUCT('t','t','',(%s))" % add("PRODUCT_CONTEXT('',%s,'mechanical')" % application))
    formation = add("PRODUCT_DEFINITION_FORMATION('','',%s)" % product)
    stage = add("PRODUCT_DEFINITION_CONTEXT('part definition',%s,'design')" % application)
    definition = add("PRODUCT_DEFINITION('','',%s,%s)" % (formation, stage))
    add("SHAPE_DEFINITION_REPRESENTATION(%s,%s)" % (add("PRODUCT_DEFINITION_SHAPE('','',%s)" % definition), shape))
    return ("ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
            "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n" + "\n".join(lines) + "\nENDSEC;\nEND-ISO-10303-21;\n")


@unittest.skipUnless(starcell_cad, "built without OpenCASCADE")
class FromBrep(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def test_planar_solid_is_exact(self):
        solid = sc.from_brep(self.file("tetrahedron.step", tetrahedron_step()), error=0.1)
        self.assertIsInstance(solid, sc.Polyhedron)
        self.assertEqual(solid.triangles.shape, (4, 3))
        self.assertEqual(sorted(map(tuple, solid.vertices)), sorted(CORNERS))
        self.assertAlmostEqual(volume(solid), 36, places=12)  # 6^3 / 6

    def test_path_may_be_text_or_a_path(self):
        path = self.file("tetrahedron.stp", tetrahedron_step())
        self.assertEqual(len(sc.from_brep(str(path), 0.1).triangles), len(sc.from_brep(path, 0.1).triangles))

    def test_open_shell_is_refused_with_its_free_edges(self):
        path = self.file("open.step", tetrahedron_step(FACES[:3]))
        with self.assertRaisesRegex(sc.InvalidSolidError, "open shell of 3 faces with 3 free edges"):
            sc.from_brep(path, 0.1)

    def test_damaged_files_are_file_errors(self):
        text = tetrahedron_step()
        for damaged in (text[:len(text) // 2], text.replace("LINE(", "LNE("), text.replace("=PLANE", "=PLNE"), "", "solid x"):
            with self.subTest(damaged=damaged[-30:]), self.assertRaises(sc.Error):
                sc.from_brep(self.file("damaged.step", damaged), 0.1)
        with self.assertRaisesRegex(sc.FileError, "missing.brep"):
            sc.from_brep(self.folder / "missing.brep", 0.1)

    def test_error_must_be_positive(self):
        path = self.file("tetrahedron.step", tetrahedron_step())
        for error in (0.0, -1.0, float("nan")):
            with self.assertRaisesRegex(ValueError, "error"):
                sc.from_brep(path, error)

    def test_module_returns_the_same_types(self):
        solid = starcell_cad.read(self.file("tetrahedron.step", tetrahedron_step()), 0.1)
        self.assertIsInstance(solid, sc.Solid)


if __name__ == "__main__":
    unittest.main()
