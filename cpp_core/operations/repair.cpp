#include "operations/repair.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <unordered_map>

#include "operations/changed_mesh.h"
#include "operations/evaluate_in_few.h"
#include "operations/operand_mesh.h"
#include "operations/tolerances.h"
#include "repair/flat_points.h"
#include "repair/meeting_triangles.h"
#include "repair/pulled_apart.h"
#include "repair/winding_solid.h"
#include "solids/connectivity.h"
#include "solids/errors.h"
#include "solids/triangle_pair.h"
#include "solids/upward_ray.h"

namespace starcell {
namespace {

constexpr double widest_hole = 10;   // in errors
constexpr double gap_share = 0.25;   // of the contact tolerance: how far what touches itself is pulled apart
// Of the error: what decimation may take, if it has to.
constexpr double decimation_shares[] = {0, 0.01, 1};
constexpr std::size_t most_cells = 100000;
// More are not listed: then which of them are depends on the order in which they were found.
constexpr std::size_t most_crossings = 100000;

struct Shell {
  std::vector<Triangle> triangles;
  double volume = 0;
};

std::vector<Shell> shells_of(const ClosedSoup& soup) {
  std::vector<Shell> shells(soup.pieces);
  const Vec3 origin = soup.vertices.front();
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& [a, b, c] = soup.triangles[t];
    shells[soup.piece[t]].triangles.push_back(soup.triangles[t]);
    shells[soup.piece[t]].volume += (soup.vertices[a] - origin).dot((soup.vertices[b] - origin).cross(soup.vertices[c] - origin));
  }
  return shells;
}

bool holds(const ClosedSoup& soup, const Shell& shell, const Vec3& x) {
  bool inside = false;
  for (const auto& [a, b, c] : shell.triangles) inside ^= is_above(soup.vertices[a], soup.vertices[b], soup.vertices[c], x);
  return inside;
}

// With the vertices that it uses.
PolyhedronPtr by_itself(const std::vector<Vec3>& points, std::vector<Triangle> triangles) {
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  std::vector<Vec3> own;
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) {
      const auto [at, fresh] = number.try_emplace(v, static_cast<std::uint32_t>(own.size()));
      if (fresh) own.push_back(points[v]);
      v = at->second;
    }
  return Polyhedron::make(std::move(own), std::move(triangles));
}

// The pieces as sound solids, each cavity with the smallest solid about it; none if some piece is not sound.
std::optional<std::vector<Expression>> sound_solids(const ClosedSoup& soup) {
  const std::vector<Shell> shells = shells_of(soup);
  std::vector<std::vector<Triangle>> solids(shells.size());
  for (std::size_t s = 0; s < shells.size(); ++s)
    if (shells[s].volume > 0) solids[s] = shells[s].triangles;
  for (const Shell& cavity : shells) {
    if (cavity.volume > 0) continue;
    const Shell* about = nullptr;
    for (const Shell& shell : shells)
      if (shell.volume > 0 && (!about || shell.volume < about->volume) && holds(soup, shell, soup.vertices[cavity.triangles.front()[0]])) about = &shell;
    if (!about) return std::nullopt;
    auto& solid = solids[about - shells.data()];
    solid.insert(solid.end(), cavity.triangles.begin(), cavity.triangles.end());
  }
  std::vector<Expression> result;
  for (const auto& triangles : solids) {
    if (triangles.empty()) continue;
    try {
      result.emplace_back(by_itself(soup.vertices, triangles));
    } catch (const InvalidSolidError&) {
      return std::nullopt;
    }
  }
  return result;
}

// Where triangles meet outside shared vertices and edges, doubled ones among them.
std::vector<Box3> crossings(const ClosedSoup& soup) {
  std::vector<Triangle> triangles = soup.triangles;
  std::erase_if(triangles, [&](const Triangle& t) { return has_no_area(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]); });
  const auto pairs = meeting_triangles(soup.vertices, triangles, most_crossings);
  const auto box = [&](std::uint32_t t) { return Box3(soup.vertices[triangles[t][0]]).extend(soup.vertices[triangles[t][1]]).extend(soup.vertices[triangles[t][2]]); };
  std::vector<Box3> places;
  places.reserve(pairs.size());
  for (const auto& [s, t] : pairs) places.push_back(box(s).intersection(box(t)));
  return places;
}

// All of it cut where it crosses, exactly, and pulled apart where it touches itself; none if that does not survive rounding, or time is out.
PolyhedronPtr cut_apart(const ClosedSoup& soup, const Options& options) {
  struct OutOfTime {};
  const Clock clock(options.budget.max_seconds);
  const auto pause = [&] {
    if (options.progress && !options.progress(0, "cutting")) throw CancelledError("The run was cancelled.");
    if (!(clock.left() > 0)) throw OutOfTime();
  };
  try {
    ExactSurface surface = boundary_of_winding(soup.vertices, soup.triangles, pause);
    take_out_flat_points(surface, static_cast<std::uint32_t>(soup.vertices.size()), pause);
    if (surface.triangles.empty()) throw InvalidSolidError("The triangles have no inside: they wind about nothing, as a sheet that is folded onto itself.");
    Box3 box;
    for (const Vec3& p : soup.vertices) box.extend(p);
    return pulled_apart(std::move(surface), gap_share * split_error(options, box, 0).contact, pause);
  } catch (const OutOfTime&) {
    return nullptr;
  }
}

// As it was cut, in the triangles that are left of the input's; decimated if needles of these do not survive float32.
Result mended(const ClosedSoup& soup, const std::optional<Expression>& sound, const Options& options, const Clock& clock) {
  std::optional<Result> result;
  if (const PolyhedronPtr solid = cut_apart(soup, options))
    for (const double share : decimation_shares) {
      Result next = changed_mesh(Expression(solid), clock.rest(options), "repairing", decimating(share));
      if (!result || next.certificate.unresolved.size() < result->certificate.unresolved.size()) result = std::move(next);
      if (result->certificate.unresolved.empty()) return *std::move(result);
    }
  // What differs by rounding is one for contouring, whereas cuts tell it apart; what could not be cut for another reason seldom ends.
  Options few_cells = clock.rest(options);
  if (few_cells.budget.max_cells == 0) few_cells.budget.max_cells = most_cells;
  const Expression solid = sound ? *sound : Expression(std::make_shared<const WindingSolid>(soup.vertices, soup.triangles));
  Result contoured = evaluate_in_few(solid, few_cells);
  if (!result || contoured.certificate.unresolved.empty()) return contoured;
  return *std::move(result);
}

}  // namespace

Repaired repair(std::vector<Vec3> vertices, std::vector<Triangle> triangles, const Options& options) {
  Box3 box;
  for (const Vec3& p : vertices)
    if (p.allFinite()) box.extend(p);
  const Clock clock(options.budget.max_seconds);
  Options with_error = options;
  with_error.error = error_for(options, box);
  if (!(*with_error.error > 0)) throw std::invalid_argument("error: must be greater than 0");
  if (options.progress && !options.progress(0, "closing")) throw CancelledError("The run was cancelled.");
  ClosedSoup soup = close(std::move(vertices), std::move(triangles), widest_hole * *with_error.error);
  const auto solids = sound_solids(soup);
  if (solids && solids->empty()) throw InvalidSolidError("The triangles have no inside: no piece of them winds about anything.");
  if (!solids)
    for (const Box3& place : crossings(soup)) soup.findings.emplace_back("crossing", place);
  std::optional<Expression> sound;
  if (solids) sound = Expression::set_union(*solids);
  Repaired repaired{mended(soup, sound, with_error, clock), std::move(soup.findings), sound};
  const Certificate& c = repaired.result.certificate;
  if (repaired.result.triangles.empty() && c.unresolved.empty())
    throw InvalidSolidError("The triangles have no inside: they wind about nothing, as a sheet that is folded onto itself.");
  if (repaired.result.triangles.empty() && clock.left() > 0 && options.budget.max_cells == 0 && options.budget.max_bytes == 0)
    throw InvalidSolidError("The triangles cannot be made a solid: they touch themselves, or nearly so, in " + std::to_string(c.unresolved.size()) +
                            (c.unresolved.size() == 1 ? " place" : " places") + " that cannot be told apart, as about " + place(c.unresolved.front().center()) +
                            "; move the parts that touch there off each other, or well into each other.");
  for (const auto& [what, where] : repaired.findings) repaired.result.certificate.statistics["repair." + what] += 1;
  return repaired;
}

}  // namespace starcell
