// thin_places() and count_pieces(): what to know of a solid beside its offset.
#include "inspection/pieces.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "inspection/thin_places.h"
#include "interruptible.h"
#include "solids/errors.h"

namespace starcell::python {
namespace {

struct Inspected {
  PolyhedronPtr solid;
  ThinPlaces found;
};

constexpr double meshing_share = 0.8;

/// The solid as a polyhedron: itself, or a certified mesh of it.
PolyhedronPtr mesh_of(const Expression& solid, std::optional<double> error, const Progress& progress) {
  if (solid.kind() == Expression::Kind::polyhedron) return solid.polyhedron();
  Options options;
  options.error = error;
  options.progress = [&](double done, const std::string& stage) { return progress(meshing_share * done, stage); };
  Result mesh = evaluate(solid, options);
  Provenance provenance;
  provenance.deflection = std::isfinite(mesh.certificate.error_bound) ? mesh.certificate.error_bound : mesh.certificate.requested_error;
  provenance.unresolved = std::move(mesh.certificate.unresolved);
  return Polyhedron::trusted(std::move(mesh.vertices), std::move(mesh.triangles), std::move(provenance));
}

Inspected thin_places(const Expression& solid, double thickness, bool gaps, std::optional<double> error, const py::object& progress) {
  if (!(thickness > 0 && std::isfinite(thickness))) throw py::value_error("thickness: must be a finite number greater than 0");
  if (error && !(*error > 0)) throw py::value_error("error: must be greater than 0, infinite, or None");
  if (!progress.is_none() && !PyCallable_Check(progress.ptr())) throw py::type_error("progress: must be callable, or None");
  Inspected result;
  run_interruptible(progress, [&](const Progress& report) {
    result.solid = mesh_of(solid, error, report);
    result.found = find_thin_places(*result.solid, thickness, gaps ? ThinSide::gap : ThinSide::wall,
                                    [&] { return report(meshing_share, "looking for thin places"); });
  });
  return result;
}

py::array spokes_of(const ThinPlace& place) {
  py::array_t<double> spokes({static_cast<py::ssize_t>(place.spokes.size()), py::ssize_t{2}, py::ssize_t{3}});
  auto at = spokes.mutable_unchecked<3>();
  for (py::ssize_t i = 0; i < at.shape(0); ++i)
    for (py::ssize_t k = 0; k < 3; ++k) {
      at(i, 0, k) = place.spokes[static_cast<std::size_t>(i)].from[k];
      at(i, 1, k) = place.spokes[static_cast<std::size_t>(i)].to[k];
    }
  return spokes;
}

template <class Of>
py::list list_of(const Inspected& inspected, Of of) {
  py::list all;
  for (const ThinPlace& place : inspected.found.places) all.append(of(place));
  return all;
}

std::vector<int> pieces(const PolyhedronSolid& whole, const PolyhedronSolid& inner) {
  const py::gil_scoped_release release;
  return count_pieces(*whole.polyhedron(), *inner.polyhedron());
}

}  // namespace

void bind_inspection(py::module_& module) {
  py::class_<Inspected>(module, "ThinPlaces",
                        "Where walls or gaps are thinner than a given thickness, the thinnest place first. Lengths in model units.")
      .def_property_readonly("boxes", [](const Inspected& self) { return list_of(self, [](const ThinPlace& p) { return to_tuple(p.box); }); },
                             "A list of (lower, upper), each of shape (3,), model units: a box about each place.")
      .def_property_readonly("thicknesses", [](const Inspected& self) { return list_of(self, [](const ThinPlace& p) { return p.thickness; }); },
                             "A list of floats, model units: how thin each place is where it is thinnest.")
      .def_property_readonly("spokes", [](const Inspected& self) { return list_of(self, spokes_of); },
                             "A list of arrays of shape (k, 2, 3), model units: for each place, segments from one side to the other, "
                             "perpendicular to the side that they start at.")
      .def_property_readonly("spacing", [](const Inspected& self) { return self.found.spacing; },
                             "Distance in model units between the points that were looked at: smaller places may be missing.")
      .def_property_readonly("solid", [](const Inspected& self) { return PolyhedronSolid(self.solid); },
                             "The Polyhedron that was looked at, in model units: the solid, or the mesh of it.")
      .def("__len__", [](const Inspected& self) { return self.found.places.size(); }, "Number of places.")
      .def("__repr__", [](const Inspected& self) {
        return "<starcell.ThinPlaces: " + std::to_string(self.found.places.size()) + ">";
      });
  module.def("thin_places", &thin_places, py::arg("solid"), py::arg("thickness"), py::arg("gaps") = false, py::arg("error") = py::none(),
             py::arg("progress") = py::none(),
             "Where a Solid's walls (or, with gaps, the gaps between its walls) are thinner than `thickness` (model units), as ThinPlaces.\n\n"
             "An erosion or opening by half that loses such walls, a dilation or closing fills such gaps. Opposite sides differ by less than 60 "
             "degrees: edges are no walls. What is no Polyhedron is meshed first, to `error` (as for evaluate()). progress as for evaluate(). "
             "Raises ValueError naming the argument, CancelledError, UnboundedError. Found by rays from points `spacing` apart: every "
             "place is real, but smaller ones may be missing.");
  module.def("count_pieces", &pieces, py::arg("whole"), py::arg("inner"),
             "For each part of `whole`, the largest first, the number of parts of `inner` that lie in it; both are Polyhedron, a part is an "
             "outer shell with its cavities.\n\nOf a solid and its erosion: 0 where a part vanishes, 2 and more where it splits. Of a dilation "
             "and its solid: 2 and more where parts have joined. Parts of `inner` must each lie in one part of `whole`, or outside; units do not matter. "
             "Raises TypeError for other solids (Result.as_solid() makes a Polyhedron of a result).");
}

}  // namespace starcell::python
