// The certificate as Python reads it: every field of the core's struct, read-only.
#include <pybind11/stl.h>

#include <cmath>

#include "arrays.h"
#include "bindings.h"

namespace starcell::python {
namespace {

py::list to_list(const std::vector<Box3>& boxes) {
  py::list list;
  for (const Box3& box : boxes) list.append(to_tuple(box));
  return list;
}

/// Counts as int, times as float: the core keeps one kind of number.
py::dict to_dict(const std::map<std::string, double>& statistics) {
  py::dict dict;
  for (const auto& [name, value] : statistics) {
    const bool is_count = name.rfind("seconds", 0) != 0 && value == std::floor(value) && std::abs(value) < 1e15;
    dict[py::str(name)] = is_count ? py::object(py::int_(static_cast<long long>(value))) : py::object(py::float_(value));
  }
  return dict;
}

}  // namespace

void bind_certificate(py::module_& module) {
  py::class_<Certificate>(module, "Certificate",
                          "What was proved of a result (DESIGN, section 1). Lengths in model units; boxes are (lower, "
                          "upper) of shape (3,) each.")
      .def_property_readonly(
          "verdict", [](const Certificate& c) { return to_string(c.verdict); },
          "\"exact\": the mesh is isotopic to the true boundary and within error_bound. \"contact\": the same for an input "
          "moved by at most contact_tolerance (model units). \"unresolved\": a budget ran out; still closed and embedded.")
      .def_readonly("error_bound", &Certificate::error_bound,
                    "Two-sided Hausdorff distance to the true boundary, an upper bound, model units: everything included.")
      .def_readonly("requested_error", &Certificate::requested_error, "The error asked for, model units.")
      .def_readonly("contact_tolerance", &Certificate::contact_tolerance, "How close counts as contact, model units.")
      .def_readonly("components", &Certificate::components, "Number of connected components of the mesh (no units).")
      .def_property_readonly(
          "genus", [](const Certificate& c) { return c.genus; },
          "List of ints, shape (components,): handles of each, the largest volume first.")
      .def_readonly("euler_characteristic", &Certificate::euler_characteristic, "V - E + F of the mesh (no units).")
      .def_property_readonly(
          "tessellated", [](const Certificate& c) { return c.tessellated; },
          "List of (name, measured deflection in model units): operands that were approximated on the way in; [] if none. "
          "The topology proved is that of these approximations.")
      .def_property_readonly(
          "contacts", [](const Certificate& c) { return to_list(c.contacts); },
          "List of (lower, upper) boxes, shape (3,) each, model units: where the input touches itself.")
      .def_property_readonly(
          "unresolved", [](const Certificate& c) { return to_list(c.unresolved); },
          "List of (lower, upper) boxes, shape (3,) each, model units: cells in which nothing is proved.")
      .def_property_readonly(
          "statistics", [](const Certificate& c) { return to_dict(c.statistics); },
          "dict of numbers: leaves, cells, max_depth, seconds of each stage, guard tests by kind, triangles; times in "
          "seconds.")
      .def("__repr__", [](const Certificate& c) {
        return "<starcell.Certificate: " + std::string(to_string(c.verdict)) + ", error_bound " +
               py::repr(py::float_(c.error_bound)).cast<std::string>() + ", components " + std::to_string(c.components) +
               ">";
      });
}

}  // namespace starcell::python
