// Budget, Result and evaluate(): options in, a certified mesh out.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <variant>

#include "arrays.h"
#include "bindings.h"
#include "run_operation.h"
#include "operations/evaluate_in_few.h"
#include "operations/minkowski.h"
#include "operations/remesh.h"
#include "operations/repair.h"
#include "operations/simplify.h"
#include "solids/mesh_writer.h"

namespace starcell::python {
namespace {

/// None means no limit of the user's own: the core's default.
Budget make_budget(std::optional<long long> max_depth, std::optional<long long> max_cells, std::optional<double> max_seconds,
                   std::optional<long long> max_bytes) {
  const auto positive = [](double value, const char* name) {
    if (!(value > 0)) throw py::value_error(std::string(name) + ": must be greater than 0, or None");
  };
  Budget budget;
  if (max_depth) {
    positive(static_cast<double>(*max_depth), "max_depth");
    budget.max_depth = static_cast<int>(std::min<long long>(*max_depth, 1000));  // float32 ends far above that
  }
  if (max_cells) {
    positive(static_cast<double>(*max_cells), "max_cells");
    budget.max_cells = static_cast<std::size_t>(*max_cells);
  }
  if (max_seconds) {
    positive(*max_seconds, "max_seconds");
    budget.max_seconds = *max_seconds;
  }
  if (max_bytes) {
    positive(static_cast<double>(*max_bytes), "max_bytes");
    budget.max_bytes = static_cast<std::size_t>(*max_bytes);
  }
  return budget;
}

py::object evaluate_expression(const Expression& expression, std::optional<double> error, std::optional<double> contact,
                               const std::string& criterion, int threads, const std::optional<Budget>& budget,
                               const py::object& progress, const std::string& on_unresolved, bool decimate) {
  return run_operation(read_options(error, contact, criterion, threads, budget), progress, on_unresolved, [&](const Options& options, ResultRecord& record) {
    record.expression = expression;
    record.result = decimate ? evaluate_in_few(expression, options) : evaluate(expression, options);
  });
}

py::object simplify_solid(const Expression& solid, std::optional<double> error, std::optional<double> contact, int threads,
                          const std::optional<Budget>& budget, const py::object& progress, const std::string& on_unresolved) {
  return run_operation(read_options(error, contact, "trace", threads, budget), progress, on_unresolved, [&](const Options& options, ResultRecord& record) {
    record.expression = solid;
    record.result = simplify(solid, options);
  });
}

py::object remesh_solid(const Expression& solid, std::optional<double> error, std::optional<double> edge_length, double feature_angle,
                        std::optional<double> contact, int threads, const std::optional<Budget>& budget, const py::object& progress, const std::string& on_unresolved) {
  return run_operation(read_options(error, contact, "trace", threads, budget), progress, on_unresolved, [&](const Options& options, ResultRecord& record) {
    record.expression = solid;
    record.result = remesh(solid, edge_length, feature_angle, options);
  });
}

py::object repair_soup(const py::object& vertices, const py::object& triangles, std::optional<double> error, std::optional<double> contact, int threads,
                       const std::optional<Budget>& budget, const py::object& progress, const std::string& on_unresolved) {
  std::vector<Vec3> points = read_points(vertices, "vertices");
  std::vector<Triangle> corners = read_triangles(triangles, "triangles", points.size());
  return run_operation(read_options(error, contact, "trace", threads, budget), progress, on_unresolved, [&](const Options& options, ResultRecord& record) {
    Repaired repaired = repair(std::move(points), std::move(corners), options);
    record.result = std::move(repaired.result);
    record.expression = std::move(repaired.solids);
    record.findings = std::move(repaired.findings);
  });
}

constexpr double preparing_share = 0.4;

// An operation that prepares an expression, evaluated as any other.
template <class Prepare>
py::object evaluate_prepared(Prepare prepare, std::optional<double> error, std::optional<double> contact, const std::string& criterion,
                             int threads, const std::optional<Budget>& budget, const py::object& progress, const std::string& on_unresolved, bool decimate) {
  return run_operation(read_options(error, contact, criterion, threads, budget), progress, on_unresolved, [&](Options options, ResultRecord& record) {
    // What is meshed on the way has the first part of the bar, if anything is.
    const Progress report = options.progress;
    double begun = 0;
    options.progress = [&](double done, const std::string& stage) {
      begun = preparing_share;
      return report(preparing_share * done, stage);
    };
    Prepared prepared = prepare(options);
    record.expression = prepared.expression;
    prepared.options.progress = [&](double done, const std::string& stage) { return report(begun + (1 - begun) * done, stage); };
    record.result = decimate ? evaluate_in_few(prepared.expression, prepared.options) : evaluate(prepared.expression, prepared.options);
  });
}

using Preparation = Prepared (*)(const Expression&, double, const Options&);
using SolidPreparation = Prepared (*)(const Expression&, const Expression&, const Options&);

// Binds a function of one solid, of two, or of a solid and a number.
template <class Second, class Prepare>
void bind_prepared(py::module_& module, const char* name, const char* first, const char* second, Prepare prepare, const char* doc) {
  module.def(
      name,
      [prepare](const Expression& solid, const Second& other, std::optional<double> error, std::optional<double> contact,
                const std::string& criterion, int threads, const std::optional<Budget>& budget, const py::object& progress,
                const std::string& on_unresolved, bool decimate) {
        return evaluate_prepared([&](const Options& options) { return prepare(solid, other, options); }, error, contact, criterion, threads,
                                 budget, progress, on_unresolved, decimate);
      },
      py::arg(first), py::arg(second), py::arg("error") = py::none(), py::arg("contact") = py::none(), py::arg("criterion") = "trace",
      py::arg("threads") = 0, py::arg("budget") = py::none(), py::arg("progress") = py::none(), py::arg("on_unresolved") = "return",
      py::arg("decimate") = true, doc);
}

/// A ball's radius, or any solid.
using Element = std::variant<double, Expression>;

// Morphology with a ball, or with any solid.
void bind_morphology(py::module_& module, const char* name, Preparation with_ball, SolidPreparation with_solid, const char* doc) {
  bind_prepared<Element>(
      module, name, "solid", "element",
      [with_ball, with_solid](const Expression& solid, const Element& element, const Options& options) {
        if (const double* radius = std::get_if<double>(&element)) {
          if (!(*radius > 0) || !std::isfinite(*radius)) throw std::invalid_argument("element: a ball's radius must be positive and finite");
          return with_ball(solid, *radius, options);
        }
        return with_solid(solid, std::get<Expression>(element), options);
      },
      doc);
}

Prepared dilated(const Expression& solid, double radius, const Options& options) { return prepare_offset(solid, radius, options); }
Prepared eroded(const Expression& solid, double radius, const Options& options) { return prepare_offset(solid, -radius, options); }

void bind_budget(py::module_& module) {
  py::class_<Budget>(
      module, "Budget",
      "Where a run stops and says \"unresolved\". max_depth: octree levels; max_cells: cells; max_seconds: seconds of wall "
      "clock; max_bytes: estimated bytes of the octree. None leaves the default. Raises ValueError unless each is > 0.")
      .def(py::init(&make_budget), py::kw_only(), py::arg("max_depth") = py::none(), py::arg("max_cells") = py::none(),
           py::arg("max_seconds") = py::none(), py::arg("max_bytes") = py::none(),
           "max_depth in levels, max_cells in cells, max_seconds in seconds, max_bytes in bytes.")
      .def_readonly("max_depth", &Budget::max_depth, "Octree levels; 0: as many as float32 coordinates allow.")
      .def_readonly("max_cells", &Budget::max_cells, "Number of cells (no units); 0: in proportion to the input and to (size / error)^2, 50 million at most.")
      .def_readonly("max_seconds", &Budget::max_seconds, "Seconds of wall clock; inf: no limit.")
      .def_readonly("max_bytes", &Budget::max_bytes, "Estimated memory in bytes; 0: no limit.");
}

void bind_result(py::module_& module) {
  py::class_<ResultRecord, std::shared_ptr<ResultRecord>>(
      module, "Result", "A closed, oriented, embedded triangle mesh in model units, and what is proved of it.")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) { return view_points(self.cast<const ResultRecord&>().result.vertices, self); },
          "(n, 3) float64, model units, read-only.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) { return view_triangles(self.cast<const ResultRecord&>().result.triangles, self); },
          "(m, 3) int32, read-only: anticlockwise seen from outside.")
      .def_property_readonly(
          "certificate", [](const std::shared_ptr<ResultRecord>& self) { return CertificateHandle{self}; },
          "The Certificate of this mesh; its lengths are in model units.")
      .def_property_readonly(
          "findings",
          [](const ResultRecord& self) {
            py::list found;
            for (const auto& [what, where] : self.findings) found.append(py::make_tuple(what, to_tuple(where)));
            return found;
          },
          "What repair() found wrong and put right, in order: (what: str, (lower, upper)), model units. Empty for other operations.")
      .def(
          "as_solid",
          [](const ResultRecord& self) {
            const py::gil_scoped_release release;
            return PolyhedronSolid(Polyhedron::trusted(self.result.vertices, self.result.triangles));
          },
          "This mesh as a Polyhedron, in model units, for further operations. Their certificates are about this mesh as it "
          "is: the distances to the original solids add up, error_bound by error_bound.")
      .def(
          "write",
          [](const ResultRecord& self, const std::filesystem::path& path) {
            const py::gil_scoped_release release;
            write_mesh(path, self.result.vertices, self.result.triangles);
          },
          py::arg("path"),
          "Writes the mesh, in model units, as .off or .obj (text), .stl or .ply (binary; STL rounds to float32). Raises "
          "ValueError for another extension, FileError if the file cannot be written; no half-written file stays.")
      .def("__repr__", [](const ResultRecord& self) {
        return "<starcell.Result: " + std::to_string(self.result.triangles.size()) + " triangles, " +
               to_string(self.result.certificate.verdict) + ">";
      });
}

}  // namespace

void bind_operations(py::module_& module) {
  bind_budget(module);
  bind_result(module);
  module.def(
      "evaluate", &evaluate_expression, py::arg("expression"), py::arg("error") = py::none(),
      py::arg("contact") = py::none(), py::arg("criterion") = "trace", py::arg("threads") = 0,
      py::arg("budget") = py::none(), py::arg("progress") = py::none(), py::arg("on_unresolved") = "return", py::arg("decimate") = true,
      "The boundary of a Solid as a Result: mesh and certificate.\n\n"
      "expression: Solid. error: two-sided Hausdorff bound, model units; None: longest side of the bounding box / 128; inf: "
      "topology only. contact: contact tolerance, model units, < error; None: error / 100. criterion: \"trace\" (DESIGN, "
      "section 3) or \"complex-cell\" (T§3.4). threads: 0 for all; the result does not depend on it. budget: Budget. "
      "progress: "
      "callable(fraction in [0, 1], stage: str) -> bool, called on this thread; False cancels, None goes on. on_unresolved: "
      "\"return\" or \"raise\". decimate: False leaves the mesh as it was contoured: sooner done, in more triangles, within the same "
      "error; what is exact to rounding is never decimated. statistics[\"triangles.contoured\"] counts what was.\n\n"
      "Raises UnboundedError, CancelledError, UnresolvedError (with .result), ValueError naming the argument, whatever "
      "progress "
      "raises, KeyboardInterrupt. Source: T§3.");
  module.def(
      "simplify", &simplify_solid, py::arg("solid"), py::arg("error") = py::none(), py::arg("contact") = py::none(), py::arg("threads") = 0,
      py::arg("budget") = py::none(), py::arg("progress") = py::none(), py::arg("on_unresolved") = "return",
      "The Solid in fewer triangles: same components and genus, embedded, within `error` (model units) both ways.\n\nerror None: longest side of "
      "the bounding box / 128. statistics[\"triangles.before\"] counts what was decimated. Arguments, and errors raised, as for evaluate(). "
      "Source: T§3.12.2, Garland & Heckbert 1997.");
  module.def(
      "remesh", &remesh_solid, py::arg("solid"), py::arg("error") = py::none(), py::arg("edge_length") = py::none(),
      py::arg("feature_angle") = default_feature_angle, py::arg("contact") = py::none(), py::arg("threads") = 0, py::arg("budget") = py::none(),
      py::arg("progress") = py::none(), py::arg("on_unresolved") = "return",
      "The Solid in well-shaped triangles: same components and genus, embedded, within `error` (model units) both ways.\n\nedge_length: of most edges, "
      "model units; None: 5 errors. Beside sharp edges that are nearer to each other edges are shorter. feature_angle: edges at which the mesh turns "
      "by more degrees are sharp, and stay where they are, but for folds of less than 2.6 degrees and walls narrower than a 64th of the error. error None: longest side of the bounding box / 128. statistics: \"angle.least\" "
      "(degrees), \"aspect_ratio.mean\" (1: equal sides), \"aspect_ratio.largest\", \"triangles\", each also with \".before\". Arguments, and errors "
      "raised, as for evaluate(); ValueError for a length or an angle out of range. Source: T§3.12.2, Botsch & Kobbelt 2004.");
  module.def(
      "repair", &repair_soup, py::arg("vertices"), py::arg("triangles"), py::arg("error") = py::none(), py::arg("contact") = py::none(),
      py::arg("threads") = 0, py::arg("budget") = py::none(), py::arg("progress") = py::none(), py::arg("on_unresolved") = "return",
      "The solid that triangles mean: the boundary of {winding number >= 1}.\n\nvertices: (n, 3) floats; triangles: (m, 3) indices, in any state: "
      "crossing, overlapping, doubled, turned, or with holes up to 10 `error` wide (model units), which are filled. Triangles are cut where they cross, and others stay as they are: "
      "simplify() makes fewer. error None: longest side / 128. "
      "Result.findings lists what was wrong, and where. Raises InvalidSolidError, with the reason, for what has no inside; else as evaluate(). "
      "Source: Jacobson et al. 2013, Zhou et al. 2016.");
  bind_prepared<double>(module, "offset", "solid", "distance", &prepare_offset,
                "The rounded offset of a Solid: all points within `distance` of it (> 0, model units), or all its points farther than "
                "-distance from its boundary (< 0).\n\nOther arguments, and errors raised, as for evaluate(); error None: longest side of the "
                "result's box / 128. What has no closed form is meshed first and named in certificate.tessellated. Source: T§4.2.");
  module.def(
      "shell",
      [](const Expression& solid, double thickness, std::optional<double> error, const std::vector<std::int64_t>& open_faces,
         std::optional<double> contact, const std::string& criterion, int threads, const std::optional<Budget>& budget, const py::object& progress,
         const std::string& on_unresolved, bool decimate) {
        return evaluate_prepared([&](const Options& options) { return prepare_shell(solid, thickness, options, open_faces); }, error, contact, criterion,
                                 threads, budget, progress, on_unresolved, decimate);
      },
      py::arg("solid"), py::arg("thickness"), py::arg("error") = py::none(), py::arg("open_faces") = std::vector<std::int64_t>(),
      py::arg("contact") = py::none(), py::arg("criterion") = "trace", py::arg("threads") = 0, py::arg("budget") = py::none(),
      py::arg("progress") = py::none(), py::arg("on_unresolved") = "return", py::arg("decimate") = true,
      "A wall about a Solid's boundary: outside it (thickness > 0, model units) or inside (< 0).\n\nopen_faces: where there shall be no wall, "
      "as numbers of CAD faces (cad_faces), or of triangles if the solid is a Polyhedron that is no import; the wall is then what lies within "
      "its thickness of the other faces. ValueError for numbers that are none of the solid's, if none would stay, and for solids without "
      "faces to choose from. Other arguments, and errors raised, as for offset(). Source: T§4.2.");
  bind_prepared<Expression>(
      module, "minkowski_sum", "a", "b", &prepare_minkowski_sum,
      "The Minkowski sum {a + b} of two Solids, of any shape, the origin anywhere.\n\nA sphere as one of them makes it an offset; other curved "
      "solids are meshed first, within a share of the error, and named in certificate.tessellated. error None: longest side of the sum's box / "
      "128, model units. Other arguments, and errors raised, as for evaluate(). Source: T§4.1, Campen & Kobbelt 2010.");
  bind_morphology(module, "dilate", &dilated, &prepare_minkowski_sum,
                  "Minkowski sum with `element`: a ball of that radius (model units), or a Solid. Other arguments as for minkowski_sum(). Source: "
                  "T§1.2.");
  bind_morphology(module, "erode", &eroded, &prepare_erosion,
                  "Where `element` fits into a Solid: all x with x + element inside. A number is a ball's radius (model units): points farther "
                  "than that from the boundary. Other arguments as for minkowski_sum(). Source: T§1.2.");
  bind_morphology(module, "opening", &prepare_opening, &prepare_opening,
                  "Erosion, then dilation, by `element`: all that it covers where it fits in. With a ball of that radius (model units) parts "
                  "thinner than its diameter go, convex edges are rounded. The error is shared between the two. Other arguments as for "
                  "minkowski_sum(). Source: T§1.2.");
  bind_morphology(module, "closing", &prepare_closing, &prepare_closing,
                  "Dilation, then erosion, by `element`: a ball's radius (model units) or a Solid. Slots narrower than it are filled, concave "
                  "edges rounded. The error is shared between the two. Other arguments as for minkowski_sum(). Source: T§1.2.");
}

}  // namespace starcell::python
