#include "operations/changed_mesh.h"

#include <chrono>
#include <cmath>
#include <limits>

#include "certificate/topology.h"
#include "contouring/float_gaps.h"
#include "decimation/decimate.h"
#include "operations/operand_mesh.h"
#include "operations/tolerances.h"
#include "remeshing/triangle_shape.h"
#include "solids/errors.h"

namespace starcell {
namespace {

// Of the error, what contouring may take, and what opening gaps for float32 may take of the rest.
constexpr double contour_part = 0.25, gap_part = 0.05;
// A mesh that is contoured should have this many times fewer triangles.
constexpr std::size_t pays = 2;
// Of the progress: contouring's, if there is any, and where rounding to float32 begins.
constexpr double contouring_until = 0.5, rounding_from = 0.95;

Result contoured(const Expression& solid, double error, const Options& options) {
  Options inner = options;
  inner.error = error;
  inner.kept = 1 - contour_part;
  if (options.progress) inner.progress = [&](double done, const std::string& stage) { return options.progress(contouring_until * done, stage); };
  return evaluate(solid, inner);
}

// A mesh and what is proved of it, before it changes.
Result mesh_of(const Expression& solid, double error, const Options& options, std::size_t many) {
  if (solid.kind() != Expression::Kind::polyhedron) return contoured(solid, error, options);
  const Polyhedron& mesh = *solid.polyhedron();
  if (mesh.triangles().size() > many && std::isfinite(error)) {
    Result coarse = contoured(solid, error, options);
    if (coarse.certificate.verdict == Verdict::exact && pays * coarse.triangles.size() < mesh.triangles().size()) return coarse;
  }
  const Provenance& from = mesh.provenance();
  Result result{mesh.vertices(), mesh.triangles(), {}};
  Certificate& c = result.certificate;
  Options inner = options;
  inner.error = error;
  c.error_bound = split_error(inner, mesh.bounding_box(), from.deflection + from.moved).inputs;
  if (from.deflection > 0) c.tessellated.emplace_back(from.name, from.proved_deflection());
  c.contacts = from.contacts;
  c.unresolved = from.unresolved;
  if (!c.contacts.empty()) c.verdict = Verdict::contact;
  if (!c.unresolved.empty()) {
    c.verdict = Verdict::unresolved;
    c.error_bound = std::numeric_limits<double>::infinity();
  }
  return result;
}

double seconds_since(std::chrono::steady_clock::time_point start) { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

void report_shapes(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, const std::string& when, Certificate& c) {
  const TriangleShapes shapes = triangle_shapes(vertices, triangles);
  c.statistics["triangles" + when] = static_cast<double>(triangles.size());
  c.statistics["aspect_ratio.mean" + when] = shapes.mean_aspect_ratio;
  c.statistics["aspect_ratio.largest" + when] = shapes.largest_aspect_ratio;
  c.statistics["angle.least" + when] = shapes.least_angle * 180 / M_PI;
}

}  // namespace

Change decimating(double share, std::size_t looks) {
  return [=](std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, double, const std::function<bool(double)>& go_on) {
    if (share == 0) return Changed{std::move(vertices), std::move(triangles), 0};
    const std::size_t most_work = looks == 0 ? SIZE_MAX : looks * triangles.size();
    Decimated few = decimate(std::move(vertices), std::move(triangles), share * most, go_on, most_work);
    return Changed{std::move(few.vertices), std::move(few.triangles), few.bound};
  };
}

std::vector<Box3> change(Result& result, double open, const char* stage, const Change& how, const std::function<bool(double)>& go_on) {
  const auto start = std::chrono::steady_clock::now();
  Certificate& c = result.certificate;
  Changed changed = how(std::move(result.vertices), std::move(result.triangles), (1 - gap_part) * open, c.error_bound, go_on);
  c.error_bound += changed.bound;
  result.vertices = std::move(changed.vertices);
  result.triangles = std::move(changed.triangles);
  c.statistics[std::string("seconds.") + stage] = seconds_since(start);
  const GoOn patient = [&] { return go_on(1), true; };
  const auto meeting = meeting_pairs(result.vertices, result.triangles, every_rounding, patient);
  std::vector<MeetingPair> all;
  for (const auto& pairs : meeting) all.insert(all.end(), pairs.begin(), pairs.end());
  std::vector<Box3> places;
  if (all.empty()) return places;
  const FloatGaps gaps = open_float_gaps(result.vertices, result.triangles, gap_part * open, patient);
  c.error_bound += gaps.moved;
  if (gaps.opened) return places;
  for (const std::uint32_t t : triangles_of(all)) {
    places.emplace_back();
    for (const std::uint32_t v : result.triangles[t]) places.back().extend(result.vertices[v]);
  }
  return places;
}

Result changed_mesh(const Expression& solid, const Options& options, const char* stage, const Change& how, std::size_t many) {
  const auto start = std::chrono::steady_clock::now();
  const Clock clock(options.budget.max_seconds);
  const double error = error_for(options, solid.bounding_box());
  if (!(error > 0)) throw std::invalid_argument("error: must be greater than 0");
  const auto tell = [&](double done, const char* stage) {
    if (options.progress && !options.progress(done, stage)) throw CancelledError("The run was cancelled.");
  };
  tell(0, "meshing");
  Result result = mesh_of(solid, error, options, many);
  Certificate& c = result.certificate;
  c.requested_error = error;
  c.contact_tolerance = options.contact.value_or(std::isinf(error) ? longest_side(solid.bounding_box()) / 12800 : error / 100);
  const bool is_mesh = solid.kind() == Expression::Kind::polyhedron;
  report_shapes(is_mesh ? solid.polyhedron()->vertices() : result.vertices, is_mesh ? solid.polyhedron()->triangles() : result.triangles, ".before", c);
  const double begun = c.statistics.count("cells") ? contouring_until : 0;   // was it contoured?
  double done = 0;
  if (!result.triangles.empty() && c.error_bound < error) {
    const auto go_on = [&](double share) {
      done = std::max(done, share);
      tell(begun + (rounding_from - begun) * done, stage);
      return clock.left() > 0;
    };
    const std::vector<Box3> meeting = change(result, error - c.error_bound, stage, how, go_on);
    if (!meeting.empty()) c.verdict = Verdict::unresolved;
    c.unresolved.insert(c.unresolved.end(), meeting.begin(), meeting.end());
  }
  count_topology(result.vertices, result.triangles, c);
  report_shapes(result.vertices, result.triangles, "", c);
  c.statistics["vertices"] = static_cast<double>(result.vertices.size());
  c.statistics["seconds"] = seconds_since(start);
  tell(1, "done");
  return result;
}

}  // namespace starcell
