// The Python module starcell_cad: CAD files to starcell.Solid. A module of its own, so that `starcell` itself runs
// without OpenCASCADE. Its types and exceptions are those that the module starcell registers.
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "cad/cad_import.h"

namespace py = pybind11;

PYBIND11_MODULE(starcell_cad, module) {
  module.doc() =
      "CAD files to starcell.Solid. OpenCASCADE's part of StarCell; used through starcell.from_brep.\n\n"
      "Each solid becomes a watertight polyhedron, stitched along the edges' shared discretisation; the distance to the\n"
      "CAD shape is measured and reported in the certificate.";
  py::module_::import("starcell");  // registers Solid and the exceptions
  module.def(
      "read",
      [](const std::filesystem::path& path, double error) {
        const py::gil_scoped_release release;
        return starcell::read_cad(path.string(), error);
      },
      py::arg("path"), py::arg("error"),
      "Read a shape from .brep or .brp (text or binary), .bin (FreeCAD's Shape.exportBinary), .step or .stp.\n\n"
      "`error` (a positive float, model units; mm for STEP) bounds the tessellation: the measured two-sided distance of\n"
      "curved faces is at most error / 2; planar faces with straight edges are exact. Infinity: topology only.\n"
      "Returns a starcell.Solid: one polyhedron a solid of the shape, their union if there are several.\n"
      "Raises FileError for a file that cannot be read, InvalidSolidError for a shape that bounds no volume or cannot be\n"
      "meshed within the error (the message says which face and why), ValueError for an error that is not positive.\n"
      "Source: DESIGN, sections 5 and 6; the stitching is our own, single faces are triangulated by OpenCASCADE.");
}
