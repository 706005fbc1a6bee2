// The certificate as Python reads it: every field of the core's struct, read-only; its file, and the check of one.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "arrays.h"
#include "bindings.h"
#include "certificate/certificate_file.h"
#include "certificate/checker.h"

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

CertificateFile to_file(const ResultRecord& record) {
  CertificateFile file;
  if (record.expression) store_expression(*record.expression, file);
  file.error = record.error;
  file.contact = record.contact;
  file.result = {record.result.vertices, record.result.triangles};
  file.certificate = record.result.certificate;
  return file;
}

py::object to_object(Answer answer) {
  return answer == Answer::unknown ? py::object(py::none()) : py::bool_(answer == Answer::yes);
}

std::string to_text(const Claim& claim) {
  const char* mark = claim.holds == Answer::yes ? "holds" : claim.holds == Answer::no ? "FAILS" : "not checked";
  return claim.name + ": " + mark + " (" + claim.detail + ")";
}

void bind_report(py::module_& module) {
  py::class_<Claim>(module, "Claim", "One claim of a certificate, as checked. Texts give lengths in model units.")
      .def_readonly("name", &Claim::name, "What is claimed, in a word or two (no units).")
      .def_property_readonly(
          "holds", [](const Claim& c) { return to_object(c.holds); },
          "True, False, or None: it could not be checked (no units).")
      .def_readonly("detail", &Claim::detail, "What was found, with slacks; or why it could not be checked. Model units.")
      .def("__repr__", [](const Claim& c) { return "<starcell.Claim: " + to_text(c) + ">"; });
  py::class_<CheckReport>(module, "CheckReport",
                          "What check_certificate() found. True in a condition if no claim was found wrong. Its texts "
                          "give lengths in model units.")
      .def_property_readonly("ok", &CheckReport::ok, "True if no claim was found wrong (no units).")
      .def_property_readonly("complete", &CheckReport::complete, "True if every claim was checked and holds (no units).")
      .def_property_readonly(
          "claims", [](const CheckReport& r) { return r.claims; },
          "List of Claim: file, operands, manifold, embedded, embedded in float32, counts, topology, distance, volume, "
          "error bound, verdict, tessellated. Lengths in model units.")
      .def("__bool__", &CheckReport::ok)
      .def("__str__",
           [](const CheckReport& r) {
             std::string text;
             for (const Claim& claim : r.claims) text += (text.empty() ? "" : "\n") + to_text(claim);
             return text;
           })
      .def("__repr__", [](const CheckReport& r) {
        const auto count = [&](Answer answer) {
          return std::to_string(
              std::count_if(r.claims.begin(), r.claims.end(), [&](const Claim& claim) { return claim.holds == answer; }));
        };
        return "<starcell.CheckReport: " + count(Answer::yes) + " claims hold, " + count(Answer::no) + " fail, " +
               count(Answer::unknown) + " not checked>";
      });
  module.def(
      "check_certificate",
      [](const std::filesystem::path& path) {
        const py::gil_scoped_release release;
        return check_certificate(path);
      },
      py::arg("path"),
      "Checks a file that Certificate.save() wrote, and returns a CheckReport; lengths in model units.\n\n"
      "Independent of the engine: CGAL computes the exact Boolean of the stored operands anew, and the stored mesh is "
      "measured against it. Claims that cannot be checked (no Boolean; above 400 000 triangles; the exact result is no "
      "manifold) come back as None with the reason. Distances have a precision of error_bound / 20, but not finer than "
      "1/1000 of the diagonal; vertices are measured up to rounding. Takes seconds to minutes. Raises FileError if there "
      "is no well-formed certificate. Source: DESIGN, section 5.");
}

}  // namespace

void bind_certificate(py::module_& module) {
  bind_report(module);
  py::class_<CertificateHandle>(module, "Certificate",
                                "What was proved of a result (DESIGN, section 1). Lengths in model units; boxes are (lower, "
                                "upper) of shape (3,) each.")
      .def_property_readonly(
          "verdict", [](const CertificateHandle& c) { return to_string(c.get().verdict); },
          "\"exact\": the mesh is isotopic to the true boundary and within error_bound. \"contact\": the same for an input "
          "moved by at most contact_tolerance (model units). \"unresolved\": a budget ran out; still closed and embedded.")
      .def_property_readonly(
          "error_bound", [](const CertificateHandle& c) { return c.get().error_bound; },
          "Two-sided Hausdorff distance to the true boundary, an upper bound, model units: everything included.")
      .def_property_readonly(
          "requested_error", [](const CertificateHandle& c) { return c.get().requested_error; },
          "The error asked for, model units.")
      .def_property_readonly(
          "contact_tolerance", [](const CertificateHandle& c) { return c.get().contact_tolerance; },
          "How close counts as contact, model units.")
      .def_property_readonly(
          "components", [](const CertificateHandle& c) { return c.get().components; },
          "Number of connected components of the mesh (no units).")
      .def_property_readonly(
          "genus", [](const CertificateHandle& c) { return c.get().genus; },
          "List of ints, shape (components,): handles of each, the largest volume first.")
      .def_property_readonly(
          "euler_characteristic", [](const CertificateHandle& c) { return c.get().euler_characteristic; },
          "V - E + F of the mesh (no units).")
      .def_property_readonly(
          "tessellated", [](const CertificateHandle& c) { return c.get().tessellated; },
          "List of (name, measured deflection in model units): operands that were approximated on the way in; [] if none. "
          "The topology proved is that of these approximations.")
      .def_property_readonly(
          "contacts", [](const CertificateHandle& c) { return to_list(c.get().contacts); },
          "List of (lower, upper) boxes, shape (3,) each, model units: where the input touches itself.")
      .def_property_readonly(
          "unresolved", [](const CertificateHandle& c) { return to_list(c.get().unresolved); },
          "List of (lower, upper) boxes, shape (3,) each, model units: cells in which nothing is proved.")
      .def_property_readonly(
          "statistics", [](const CertificateHandle& c) { return to_dict(c.get().statistics); },
          "dict of numbers: leaves, cells, max_depth, seconds of each stage, guard tests by kind, triangles; times in "
          "seconds.")
      .def(
          "save",
          [](const CertificateHandle& c, const std::filesystem::path& path) {
            const py::gil_scoped_release release;
            write_certificate(path, to_file(*c.record));
          },
          py::arg("path"),
          "Writes one self-contained JSON file, lengths in model units: operands, expression, options, mesh and every field "
          "of this certificate, every double as the shortest text that reads back the same. check_certificate() reads it. "
          "Raises FileError if it cannot be written; no half-written file stays.")
      .def("__repr__", [](const CertificateHandle& handle) {
        const Certificate& c = handle.get();
        return "<starcell.Certificate: " + std::string(to_string(c.verdict)) + ", error_bound " +
               py::repr(py::float_(c.error_bound)).cast<std::string>() + ", components " + std::to_string(c.components) +
               ">";
      });
}

}  // namespace starcell::python
