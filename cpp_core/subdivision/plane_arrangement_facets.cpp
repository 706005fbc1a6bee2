// What facets cover of a plane's polygons, and what candidate solids say beside them and between their walls.
#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/predicates.h"
#include "subdivision/plane_arrangement.h"

namespace starcell {
namespace {

// How wide a seam between candidate facets may be, of the coordinates.
constexpr double seam_scale = 2e-12;

// Is the point in the facet's shadow, or no farther than the seam from it?
bool nearly_covers(const FacetTable& table, std::uint32_t facet, int axis, const Vec2& at, double seam) {
  const std::array<Vec2, 3> p{project(table.corner(facet, 0), axis), project(table.corner(facet, 1), axis), project(table.corner(facet, 2), axis)};
  const auto turn = [](const Vec2& a, const Vec2& b, const Vec2& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); };
  const double sense = turn(p[0], p[1], p[2]) < 0 ? -1 : 1;
  for (int k = 0; k < 3; ++k) {
    const Vec2 &a = p[k], &b = p[(k + 1) % 3];
    if (sense * turn(a, b, at) < -seam * std::hypot(b.x - a.x, b.y - a.y)) return false;
  }
  return true;
}

}  // namespace

// Candidates' facets meet in seams that rounding may leave open: they count as covering to within that, and membership decides.
PlaneArrangement::Cover PlaneArrangement::covering(int plane, const Vec3& x) const {
  const FacetTable& table = restriction_.table();
  const Vec3& normal = table.surfaces[surfaces_[plane]].normal;
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  const Vec2 at = project(x, axis);
  const Membership candidates = problem_.candidates(table);
  const double seam = seam_scale * std::max(box_.min().cwiseAbs().maxCoeff(), box_.max().cwiseAbs().maxCoeff());
  Membership mask = 0, along = 0, against = 0;
  for (const std::uint32_t f : problem_.facets) {
    if (surface_of(f) != surfaces_[plane]) continue;
    const Membership bit = Membership{1} << restriction_.slot_of(problem_, f);
    if (candidates & bit) {
      if (!nearly_covers(table, f, axis, at, seam)) continue;
      mask |= bit;
      (table.area_vector(f).dot(normal) > 0 ? along : against) |= bit;
      continue;
    }
    const Vec2 p = project(table.corner(f, 0), axis), q = project(table.corner(f, 1), axis),
               r = project(table.corner(f, 2), axis);
    const int s = turn_grid(p, q, at, a, b);
    if (s == 0 || turn_grid(q, r, at, a, b) != s || turn_grid(r, p, at, a, b) != s) continue;
    mask ^= bit;
  }
  return {mask, along & against};
}

// One membership for certain as far as planes of one surface, and the lines and points in which such cross, may lie from x: then nothing
// is between them.
bool PlaneArrangement::holds_around(std::size_t slot, const Vec3& x) const {
  if (!local_.empty()) return false;
  const FacetTable& table = restriction_.table();
  double thickest = 0;
  for (const std::uint32_t id : surfaces_) thickest = std::max(thickest, table.surfaces[id].thickness);
  const std::uint32_t solid = problem_.expression.solids()[slot];
  const Vec3 half = Vec3::Constant(8 * thickest), at = x - table.shifts[solid];
  return table.candidates[solid]->constant(Box3(at - half, at + half)).has_value();
}

// Walls of one candidate solid that face each other on all of these planes at x, with room for something between them?
bool PlaneArrangement::opposed_at(const Vec3& x, std::initializer_list<int> planes) const {
  Membership opposed = ~Membership{0};
  for (const int plane : planes) opposed &= covering(plane, x).opposed;
  for (std::size_t slot = 0; slot < problem_.slots(); ++slot)
    if ((opposed >> slot & 1) && !holds_around(slot, x)) return true;
  return false;
}

// What is as thin as rounding in two directions lies along the line of two planes, in three at a point: no polygon sees it.
void PlaneArrangement::look_between_walls() {
  const FacetTable& table = restriction_.table();
  const Membership candidates = problem_.candidates(table);
  if (candidates == 0 || touching_) return;
  std::vector<std::array<bool, 2>> senses(surfaces_.size(), {false, false});
  for (const std::uint32_t f : problem_.facets) {
    if (!table.candidate(table.operand_of(f))) continue;
    const auto i = static_cast<std::size_t>(std::lower_bound(surfaces_.begin(), surfaces_.end(), surface_of(f)) - surfaces_.begin());
    senses[i][table.area_vector(f).dot(table.surfaces[surfaces_[i]].normal) > 0] = true;
  }
  const auto both = [&](int plane) { return plane < count() && senses[plane][0] && senses[plane][1]; };
  for (const PlanePolygon& polygon : polygons_) {
    if (!both(polygon.plane)) continue;
    const std::size_t n = polygon.corner.size();
    for (std::size_t k = 0; k < n && !touching_; ++k) {
      if (!both(polygon.edge[k])) continue;
      const Vec3 from = place(polygon.corner[k]), to = place(polygon.corner[(k + 1) % n]);
      const int before = polygon.edge[(k + n - 1) % n];
      touching_ = opposed_at(0.5 * (from + to), {polygon.plane, polygon.edge[k]}) || (both(before) && opposed_at(from, {polygon.plane, polygon.edge[k], before}));
    }
  }
}

// Candidate facets flip their solid where it is on one side of them only: `flips` loses the others, `around` learns membership on the
// side of the cell's lower corner.
bool PlaneArrangement::candidates_beside(const PlanePolygon& polygon, const Vec3& middle, Membership opposed, Membership& around, Membership& flips) {
  const Membership candidates = problem_.candidates(restriction_.table());
  if (candidates == 0) return true;
  // Off the plane by half the way to the nearest of the others: still in the region beside the polygon.
  double room = std::numeric_limits<double>::infinity();
  std::array<Vec3, 2> beside;   // on the negative side, on the positive
  {
    const Rounding rounding;
    const Interval3 x{Interval(middle.x()), Interval(middle.y()), Interval(middle.z())};
    for (int j = 0; j < count() + 6; ++j)
      if (j != polygon.plane) room = std::min(room, std::abs(starcell::middle(value(planes_[j], x))));
    const Vec3 n = restriction_.table().surfaces[surfaces_[polygon.plane]].normal;
    for (const int sense : {0, 1}) {
      beside[sense] = middle + (sense ? 0.5 : -0.5) * room * n;
      const Interval3 y{Interval(beside[sense].x()), Interval(beside[sense].y()), Interval(beside[sense].z())};
      for (int j = 0; j < count() + 6; ++j) {
        const int wanted = j == polygon.plane ? (sense ? 1 : -1) : j < count() ? polygon.side[j] : (j - count()) % 2 ? -1 : 1;
        if (certain_sign(value(planes_[j], y)) != wanted) return false;
      }
    }
  }
  for (std::size_t slot = 0; slot < problem_.slots(); ++slot) {
    const Membership bit = Membership{1} << slot;
    if (!(candidates & bit)) continue;
    std::array<bool, 2> inside;
    for (const int sense : {0, 1}) {
      const auto known = restriction_.candidate_contains(problem_, slot, beside[sense] + box_.min());
      if (!known) return false;
      inside[sense] = *known;
    }
    if (inside[0] == inside[1]) {
      flips &= ~bit;
      touching_ = touching_ || ((opposed & bit) && !holds_around(slot, middle + box_.min()));
    }
    else if (!(flips & bit)) return false;   // E off its facets: rounding
    if (inside[corner_sign_[polygon.plane] > 0]) around |= bit;
  }
  return true;
}

}  // namespace starcell
