// penetration_depth(): how far one solid has to move to come free of another, or how far apart they are.
#include "operations/penetration_depth.h"

#include <pybind11/stl.h>

#include <cmath>

#include "arrays.h"
#include "bindings.h"
#include "interruptible.h"

namespace starcell::python {
namespace {

PenetrationDepth measure(const Expression& a, const Expression& b, std::optional<double> error, const std::optional<Budget>& budget,
                         const py::object& progress) {
  if (error && !(*error > 0 && std::isfinite(*error))) throw py::value_error("error: must be a finite number greater than 0, or None");
  if (!progress.is_none() && !PyCallable_Check(progress.ptr())) throw py::type_error("progress: must be callable, or None");
  Options options;
  options.error = error;
  if (budget) options.budget = *budget;
  PenetrationDepth result;
  run_interruptible(progress, [&](const Progress& report) {
    options.progress = report;
    result = penetration_depth(a, b, options);
  });
  return result;
}

}  // namespace

void bind_penetration_depth(py::module_& module) {
  py::class_<PenetrationDepth>(module, "PenetrationDepth", "Certified bounds of how deep two Solids overlap, or of how far apart they are; lengths in model units.")
      .def_readonly("lower", &PenetrationDepth::lower, "No shorter translation separates the solids, model units; 0 if they do not overlap, or that is not proved.")
      .def_readonly("upper", &PenetrationDepth::upper, "So long a translation along `direction` does, model units; 0 if they do not overlap.")
      .def_property_readonly("depth", [](const PenetrationDepth& d) { return d.upper; }, "The upper bound, model units.")
      .def_property_readonly("direction", [](const PenetrationDepth& d) { return py::make_tuple(d.direction.x(), d.direction.y(), d.direction.z()); },
                             "Unit vector, shape (3,), that moves b out of a; zero if they do not overlap.")
      .def_readonly("separation_lower", &PenetrationDepth::separation_lower, "The solids are at least this far apart, model units; 0 if they overlap.")
      .def_readonly("separation_upper", &PenetrationDepth::separation_upper, "The solids are no farther apart than this, model units; 0 if they overlap.")
      .def_property_readonly("point_a", [](const PenetrationDepth& d) { return py::make_tuple(d.point_a.x(), d.point_a.y(), d.point_a.z()); },
                             "Point of a's surface, shape (3,), model units: where b touches it once it is moved, or where b is nearest to it.")
      .def_property_readonly("point_b", [](const PenetrationDepth& d) { return py::make_tuple(d.point_b.x(), d.point_b.y(), d.point_b.z()); },
                             "The point of b's surface, shape (3,), model units, that belongs to point_a.")
      .def_readonly("deflection", &PenetrationDepth::deflection, "By how much meshes of curved solids are off, model units; the bounds contain it.")
      .def("__repr__", [](const PenetrationDepth& d) {
        const bool overlap = d.upper > 0;
        return std::string("<starcell.PenetrationDepth: ") + (overlap ? "depth " : "separation ") + std::to_string(overlap ? d.lower : d.separation_lower) +
               " to " + std::to_string(overlap ? d.upper : d.separation_upper) + ">";
      });
  module.def("penetration_depth", &measure, py::arg("a"), py::arg("b"), py::arg("error") = py::none(), py::arg("budget") = py::none(),
             py::arg("progress") = py::none(),
             "How far the Solid b has to be moved to come free of the Solid a, as a PenetrationDepth: lower and upper bound, and the way out. 0 if "
             "they do not overlap; then the bounds of their separation.\n\nerror: upper - lower at most, model units; None: a hundredth of the smaller "
             "solid's longest side. Curved solids are meshed within a share of it; where their room is smaller than that, lower is 0. "
             "budget: Budget, of which max_seconds counts; bounds are as far "
             "apart as they are when it ends. progress as for evaluate(). Raises UnboundedError, CancelledError, ValueError naming the argument. "
             "Source: T§4.3.");
}

}  // namespace starcell::python
