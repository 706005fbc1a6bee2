#include "repair/pulled_apart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Geometry>

#include "numerics/linear_program.h"
#include "repair/rounding_motion.h"
#include "solids/disjoint_sets.h"
#include "solids/errors.h"

namespace starcell {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;   // the smaller point first

struct Side {
  std::uint32_t triangle;
  std::uint32_t corner;   ///< the edge runs from it to the next
};

using Sides = std::map<Edge, std::vector<Side>>;

// Gaps that are tried, in shares of the widest.
constexpr double gap_shares[] = {1, 0.1, 0.01, 1e-3, 1e-4};

Sides sides_of(const std::vector<Triangle>& triangles) {
  Sides sides;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) sides[std::minmax(triangles[t][k], triangles[t][(k + 1) % 3])].push_back({t, k});
  return sides;
}

// In two, where more than two triangles meet: then the ends may stay one vertex each, and there are still two edges.
void halve_shared_edges(ExactSurface& surface) {
  std::map<Edge, std::uint32_t> middles;
  for (const auto& [edge, sides] : sides_of(surface.triangles)) {
    if (sides.size() == 2) continue;
    middles.emplace(edge, static_cast<std::uint32_t>(surface.points.size()));
    surface.points.push_back(CGAL::midpoint(surface.points[edge.first], surface.points[edge.second]));
  }
  if (middles.empty()) return;
  std::vector<Triangle> all;
  for (const Triangle& t : surface.triangles) {
    std::vector<std::uint32_t> around;   // corners and middles; a corner follows and leads every middle
    std::vector<std::size_t> at;
    for (std::size_t k = 0; k < 3; ++k) {
      around.push_back(t[k]);
      const auto middle = middles.find(std::minmax(t[k], t[(k + 1) % 3]));
      if (middle != middles.end()) at.push_back(around.size()), around.push_back(middle->second);
    }
    const std::size_t n = around.size();
    if (at.empty()) {
      all.push_back(t);
    } else if (at.size() == 3) {
      for (std::size_t k = 0; k < 3; ++k) all.push_back({around[at[k]], around[(at[k] + 1) % n], around[at[(k + 1) % 3]]});
      all.push_back({around[at[0]], around[at[1]], around[at[2]]});
    } else {   // a fan from a middle; with two of them no three corners of its triangles are on one side
      for (std::size_t k = 1; k + 1 < n; ++k) all.push_back({around[at[0]], around[(at[0] + k) % n], around[(at[0] + k + 1) % n]});
    }
  }
  surface.triangles = std::move(all);
}

// CGAL's own conversion of what is not evaluated yet is content with five digits.
double to_last_digit(const ExactKernel::FT& x) {
  constexpr double share = 1e-15;
  const auto [low, high] = CGAL::to_interval(x);
  return high - low <= share * std::abs(low) ? low + 0.5 * (high - low) : CGAL::to_double(x.exact());
}

class Pulling {
 public:
  explicit Pulling(const ExactSurface& surface) : surface_(surface), corners_(3 * surface.triangles.size()) {
    for (auto& [edge, sides] : sides_of(surface.triangles)) {
      if (sides.size() > 2) sort_about(edge, sides);
      for (std::size_t i = 0; i + 1 < sides.size(); i += 2) join(sides[i], sides[i + 1]);
    }
  }

  PolyhedronPtr polyhedron(double gap, bool all_move, const std::function<void()>& pause) {
    std::map<std::uint32_t, std::uint32_t> number;             // of each cycle of corners
    std::map<std::uint32_t, std::vector<std::uint32_t>> cycles;   // of each point
    std::vector<Vec3> places;
    std::vector<std::vector<Vec3>> normals;
    std::vector<Triangle> triangles = surface_.triangles;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const Triangle& points = surface_.triangles[t];
      const Vec3 normal = (place(points[1]) - place(points[0])).cross(place(points[2]) - place(points[0]));
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto [at, fresh] = number.emplace(corners_.root(3 * t + k), static_cast<std::uint32_t>(places.size()));
        if (fresh) {
          places.push_back(place(points[k]));
          normals.emplace_back();
          cycles[points[k]].push_back(at->second);
        }
        if (normal.norm() > 0) normals[at->second].push_back(normal.normalized());
        triangles[t][k] = at->second;
      }
    }
    Provenance provenance;
    for (const auto& [point, copies] : cycles) {
      if (copies.size() == 1) continue;
      provenance.moved = gap;
      provenance.contacts.emplace_back(places[copies[0]] - Vec3::Constant(gap), places[copies[0]] + Vec3::Constant(gap));
      // One may stay: that with the least room, as a fin, or a cycle that faces all ways and has none.
      std::vector<Vec3> inward;
      std::vector<double> room;
      for (const std::uint32_t v : copies) {
        inward.push_back(-widest_direction(normals[v]).value_or(Vec3::Zero()).normalized());
        room.push_back(-std::numeric_limits<double>::infinity());
        for (const Vec3& n : normals[v]) room.back() = std::max(room.back(), n.dot(inward.back()));
      }
      const auto stays = static_cast<std::size_t>(std::max_element(room.begin(), room.end()) - room.begin());
      for (std::size_t i = 0; i < copies.size(); ++i)
        if (all_move || i != stays) places[copies[i]] += gap * inward[i];
    }
    if (provenance.contacts.empty()) {
      std::vector<Vec3> rounded;
      rounded.reserve(surface_.points.size());
      for (std::uint32_t v = 0; v < surface_.points.size(); ++v) rounded.push_back(place(v));
      provenance.contacts = not_proved_to_keep(surface_, rounded, pause);
    }
    try {
      return Polyhedron::make(std::move(places), std::move(triangles), std::move(provenance));
    } catch (const InvalidSolidError&) {
      return nullptr;
    }
  }

 private:
  Vec3 place(std::uint32_t v) const {
    const ExactPoint& p = surface_.points[v];
    return {to_last_digit(p.x()), to_last_digit(p.y()), to_last_digit(p.z())};
  }

  void join(const Side& a, const Side& b) {
    corners_.join(3 * a.triangle + a.corner, 3 * b.triangle + (b.corner + 1) % 3);
    corners_.join(3 * a.triangle + (a.corner + 1) % 3, 3 * b.triangle + b.corner);
  }

  bool forward(const Side& s, const Edge& edge) const { return surface_.triangles[s.triangle][s.corner] == edge.first; }
  const ExactPoint& apex(const Side& s) const { return surface_.points[surface_.triangles[s.triangle][(s.corner + 2) % 3]]; }

  // Anticlockwise about the edge, so that those in places 2i and 2i + 1 have inside between them: first one that runs backward.
  void sort_about(const Edge& edge, std::vector<Side>& sides) const {
    const ExactPoint &a = surface_.points[edge.first], &b = surface_.points[edge.second];
    const auto start = std::find_if(sides.begin(), sides.end(), [&](const Side& s) { return !forward(s, edge); });
    std::iter_swap(sides.begin(), start);
    const ExactPoint& zero = apex(sides.front());
    const auto half = [&](const Side& s) {   // 0: up to half a turn, 1: half a turn, 2: beyond; no two triangles are at one angle
      const CGAL::Orientation turn = CGAL::orientation(a, b, zero, apex(s));
      return turn == CGAL::POSITIVE ? 0 : turn == CGAL::COPLANAR ? 1 : 2;
    };
    std::sort(sides.begin() + 1, sides.end(), [&](const Side& s, const Side& t) {
      const int hs = half(s), ht = half(t);
      return hs != ht ? hs < ht : hs != 1 && CGAL::orientation(a, b, apex(s), apex(t)) == CGAL::POSITIVE;
    });
  }

  const ExactSurface& surface_;
  DisjointSets corners_;
};

}  // namespace

PolyhedronPtr pulled_apart(ExactSurface surface, double gap, const std::function<void()>& pause) {
  halve_shared_edges(surface);
  Pulling pulling(surface);
  for (const double share : gap_shares)
    for (const bool all_move : {false, true})
      if (PolyhedronPtr solid = pulling.polyhedron(share * gap, all_move, pause)) return solid;
  return nullptr;
}

}  // namespace starcell
