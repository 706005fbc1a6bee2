// Solids: Solid and its special cases, and the readers that make them.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "arrays.h"
#include "bindings.h"
#include "solids/box.h"
#include "solids/errors.h"
#include "solids/mesh_reader.h"

namespace starcell::python {
namespace {

PolyhedronSolid make_polyhedron(const py::object& vertices, const py::object& triangles) {
  std::vector<Vec3> points = read_points(vertices, "vertices");
  std::vector<Triangle> corners = read_triangles(triangles, "triangles", points.size());
  const py::gil_scoped_release release;
  return PolyhedronSolid(Polyhedron::make(std::move(points), std::move(corners)));
}

PolyhedronSolid read_polyhedron(const std::filesystem::path& path) {
  const py::gil_scoped_release release;
  TriangleSoup soup = read_mesh(path.string());
  Provenance provenance;
  provenance.name = path.filename().string();
  return PolyhedronSolid(Polyhedron::make(std::move(soup.vertices), std::move(soup.triangles), std::move(provenance)));
}

/// OpenCASCADE lives in a module of its own, loaded when first needed: the engine runs without it.
py::object from_brep(const py::object& path, double error, bool recognise) {
  py::module_ cad;
  try {
    cad = py::module_::import("starcell_cad");
  } catch (py::error_already_set& problem) {
    if (!problem.matches(PyExc_ImportError)) throw;
    throw Error(std::string("Reading CAD shapes needs the module starcell_cad, which cannot be imported: ") +
                problem.what());
  }
  return wrap(cad.attr("read")(path, error, recognise).cast<Expression>());
}

std::string describe(const Expression& solid) {
  switch (solid.kind()) {
    case Expression::Kind::polyhedron: return std::to_string(solid.polyhedron()->triangles().size()) + " triangles";
    case Expression::Kind::half_space: return "half-space";
    case Expression::Kind::curved: return solid.curved()->name();
    case Expression::Kind::offset: return "offset";
    case Expression::Kind::sum: return "Minkowski sum";
    case Expression::Kind::winding: return "repaired mesh";
    case Expression::Kind::region: return "region";
    case Expression::Kind::set_union: return "union of " + std::to_string(solid.operands().size());
    case Expression::Kind::intersection: return "intersection of " + std::to_string(solid.operands().size());
    case Expression::Kind::complement: return "complement";
  }
  return {};
}

py::object transformed(const Expression& solid, const py::object& matrix4x4) {
  const Eigen::Matrix4d map = read_matrix4(matrix4x4, "matrix4x4");
  return wrap([&] {
    const py::gil_scoped_release release;
    return solid.transformed(map);
  }());
}

}  // namespace

py::object wrap(const Expression& expression) {
  switch (expression.kind()) {
    case Expression::Kind::polyhedron: return py::cast(PolyhedronSolid(expression.polyhedron()));
    case Expression::Kind::half_space: return py::cast(HalfSpaceSolid(expression.half_space()));
    case Expression::Kind::curved: return wrap_curved(expression.curved());
    default: return py::cast(expression);
  }
}

void bind_solids(py::module_& module) {
  py::class_<Expression> solid(
      module, "Solid",
      "A solid: a leaf (Polyhedron, Box, HalfSpace) or an expression over solids, in model units. Immutable; copies and "
      "expressions share their operands. Combine with | (union), & (intersection), - (difference) and ~ (complement); "
      "evaluate() turns one into a mesh. Source: T§3.10.");
  solid
      .def("transformed", &transformed, py::arg("matrix4x4"),
           "The image under an affine map, as a Solid of the same kind. matrix4x4: (4, 4), applied to column vectors, last "
           "row 0 0 0 1, translation in model units; mirror images are turned right side out. Raises ValueError for "
           "another shape, a singular or a projective matrix, InvalidSolidError if rounding makes the image cross itself.")
      .def_property_readonly(
          "bounding_box", [](const Expression& self) { return to_tuple(self.bounding_box()); },
          "(lower, upper), each of shape (3,), model units: a box that contains the solid, tight for a leaf. Raises "
          "UnboundedError if none can be derived.")
      .def("__repr__", [](const py::object& self) {
        return "<starcell." + py::type::of(self).attr("__name__").cast<std::string>() + ": " +
               describe(self.cast<const Expression&>()) + ">";
      });
  bind_expressions(solid, module);

  py::class_<PolyhedronSolid, Expression>(
      module, "Polyhedron",
      "A closed solid bounded by triangles (T§3.1). vertices: (n, 3) float64, model units. triangles: (m, 3) integers into "
      "them, anticlockwise seen from outside. Bit-identical vertices are welded; a mesh that is inside out is turned. "
      "Raises "
      "InvalidSolidError, with counts and the first place, unless the mesh is finite and a closed, embedded 2-manifold; "
      "ValueError for other shapes or an index outside [0, n); TypeError for what is no number.")
      .def(py::init(&make_polyhedron), py::arg("vertices"), py::arg("triangles"),
           "vertices: (n, 3) float64, model units; triangles: (m, 3) integers.")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) {
            return view_points(self.cast<const PolyhedronSolid&>().polyhedron()->vertices(), self);
          },
          "(n, 3) float64, model units, read-only: the vertices after welding.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            return view_triangles(self.cast<const PolyhedronSolid&>().polyhedron()->triangles(), self);
          },
          "(m, 3) int32, read-only: anticlockwise seen from outside.")
      .def_property_readonly(
          "deflection", [](const PolyhedronSolid& self) { return self.polyhedron()->provenance().deflection; },
          "Measured two-sided distance, in model units, to the CAD shape it was made from; 0 if it is the shape itself.")
      .def_property_readonly(
          "cad_faces",
          [](const PolyhedronSolid& self) {
            const auto& faces = self.polyhedron()->provenance().cad_face;
            return py::array_t<std::int32_t>(static_cast<py::ssize_t>(faces.size()), faces.data());
          },
          "(m,) int32: the CAD face that each triangle came from, counted from 1 as in FreeCAD; shape (0,) if the solid is no import.");

  py::class_<BoxSolid, PolyhedronSolid>(
      module, "Box",
      "An axis-parallel box of twelve triangles. lower, upper: (3,), model units. Raises ValueError unless lower < upper in "
      "every coordinate and all are finite.")
      .def(py::init([](const py::object& lower, const py::object& upper) {
             return BoxSolid(make_box(read_vector(lower, "lower"), read_vector(upper, "upper")));
           }),
           py::arg("lower"), py::arg("upper"), "lower, upper: (3,), model units.");

  py::class_<HalfSpaceSolid, Expression>(
      module, "HalfSpace",
      "Everything on the inner side of a plane. point: (3,), model units, on the plane; normal: (3,), outward, any positive "
      "length. Unbounded, so only usable inside a bounded expression. Raises ValueError for a zero normal or values that "
      "are "
      "not finite.")
      .def(py::init([](const py::object& point, const py::object& normal) {
             return HalfSpaceSolid(HalfSpace::make(read_vector(point, "point"), read_vector(normal, "normal")));
           }),
           py::arg("point"), py::arg("normal"), "point: (3,), model units; normal: (3,), outward.");

  module.def(
      "read_mesh", &read_polyhedron, py::arg("path"),
      "The Polyhedron in a mesh file: OFF, STL, OBJ or PLY, text or binary, by the extension; the file's units are taken as "
      "model units. Polygons are fanned. Raises FileError if the file cannot be read as such, InvalidSolidError if it is no "
      "closed, embedded 2-manifold.");
  module.def(
      "from_brep", &from_brep, py::arg("path"), py::arg("error"), py::arg("recognise") = true,
      "The solid in an OpenCASCADE shape file (.brep, .bin, .step). error: largest distance, model units, by which a "
      "tessellated curved face may differ; the measured one counts in every certificate. Planar faces are exact, and so are "
      "whole balls, round cylinders, cones and ring tori, which become Sphere, Cylinder, Cone and Torus, unless recognise is False: then they are Polyhedra that "
      "know their cad_faces. Raises "
      "FileError if the file cannot be read, InvalidSolidError with the reason if its shape is no closed solid, ValueError "
      "unless error > 0, Error if the module starcell_cad is missing. Source: DESIGN, section 6.");
}

}  // namespace starcell::python
