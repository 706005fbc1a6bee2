// The Python module starcell_cad: CAD files to starcell.Solid, and meshes to CAD files. A module of its own, so that
// `starcell` itself runs without OpenCASCADE. Its types and exceptions are those that the module starcell registers.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "arrays.h"
#include "cad/cad_export.h"
#include "cad/cad_import.h"

namespace py = pybind11;

namespace {

std::size_t write_solid(const py::object& vertices, const py::object& triangles, const std::filesystem::path& path,
                        const std::optional<double>& tolerance) {
  std::vector<starcell::Vec3> points = starcell::python::read_points(vertices, "vertices");
  std::vector<starcell::Triangle> corners = starcell::python::read_triangles(triangles, "triangles", points.size());
  const py::gil_scoped_release release;
  const starcell::PolyhedronPtr mesh = starcell::Polyhedron::make(std::move(points), std::move(corners));
  return starcell::write_solid(*mesh, path.string(), tolerance);
}

}  // namespace

PYBIND11_MODULE(starcell_cad, module) {
  module.doc() =
      "CAD files to starcell.Solid (used through starcell.from_brep), and meshes to CAD files: OpenCASCADE's part of StarCell.\n\n"
      "Balls, cylinders, cones and tori are read as such, in closed form. Any other solid becomes a watertight polyhedron,\n"
      "stitched along the edges' shared discretisation; the distance to the CAD shape, in model units, is measured and\n"
      "reported in the certificate.";
  py::module_::import("starcell");  // registers Solid and the exceptions
  module.def(
      "read",
      [](const std::filesystem::path& path, double error, bool recognise) {
        const py::gil_scoped_release release;
        return starcell::read_cad(path.string(), error, recognise ? starcell::Curved::recognised : starcell::Curved::tessellated);
      },
      py::arg("path"), py::arg("error"), py::arg("recognise") = true,
      "Read a shape from .brep or .brp (text or binary), .bin (FreeCAD's Shape.exportBinary), .step or .stp.\n\n"
      "`error` (a positive float, model units; mm for STEP) bounds the tessellation: the measured two-sided distance of\n"
      "curved faces is at most error / 2; planar faces with straight edges are exact. Infinity: topology only.\n"
      "`recognise` False: balls, cylinders, cones and tori are tessellated too, and know their faces.\n"
      "Returns a starcell.Solid: one curved solid or polyhedron a solid of the shape, their union if there are several.\n"
      "Raises FileError for a file that cannot be read, InvalidSolidError for a shape that bounds no volume or cannot be\n"
      "meshed within the error (the message says which face and why), ValueError for an error that is not positive.\n"
      "Source: DESIGN, sections 5 and 6; the stitching is our own, single faces are triangulated by OpenCASCADE.");
  module.def(
      "write_solid", &write_solid, py::arg("vertices"), py::arg("triangles"), py::arg("path"), py::arg("tolerance") = py::none(),
      "Write a closed mesh as a CAD solid, each planar region as one face: .bin for FreeCAD's Shape.importBinary (coordinates\n"
      "exactly), .brep or .brp for OpenCASCADE's text (15 digits).\n\n"
      "vertices: (n, 3) float64, model units; triangles: (m, 3) integers. tolerance: model units, 0 or more; within it\n"
      "triangles count as coplanar and edges as straight, and the surface moves by no more. None: 1e-9 of the longest side.\n"
      "Several components become a compound of solids, cavities inner shells; normals are turned outward.\n"
      "Returns the number of faces. Raises InvalidSolidError, with counts and the first place, unless the mesh is a closed,\n"
      "embedded 2-manifold, or if OpenCASCADE finds fault with the solid; FileError if the file cannot be written; ValueError\n"
      "for other shapes, a negative tolerance or another extension. Source: our own; planes are fitted, nothing is sewn.");
}
