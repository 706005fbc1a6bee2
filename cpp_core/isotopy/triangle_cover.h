// How far is a triangle T from a surface, at most? A certified answer that looks only at the part of the surface beside T.
//
// Seen along T's normal, a patch U of the surface is taken that grows across every edge over T: so no edge of U's boundary is over T, and
// the number of times U covers a point of T, counted with sign, is the same for all of them (the degree of the projection): the signed
// area of what is over T tells it. If it is not 0, every point of T has a point of U over it. Each triangle s of U is over a convex part Q of T,
// and the distance from s is a convex function: its largest value on Q is at a corner. So the largest of these distances bounds that of
// T from the surface. (Of T, all but a seam along its sides: what lies along a side, as a wall below it, is then not over T.) Where T ends at a sharp edge, s may fall away steeply below Q: its distance is still that to the edge.
// Guarantees: bound() holds up to rounding, which it includes. Does not guarantee to be tight where the surface folds over T.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "numerics/vector.h"

namespace starcell {

using Corners = std::array<Vec3, 3>;

Vec3 nearest_on_triangle(const Vec3& x, const Corners& t);
double distance_to_triangle(const Vec3& x, const Corners& t);

class TriangleCover {
 public:
  /// `slack`: what rounding may do to a coordinate. `give`: how far points may be from those that are looked at instead.
  TriangleCover(const Corners& t, double slack, double give);

  /// A triangle so thin that it has no plane to look along has none.
  bool has_plane() const { return has_plane_; }

  /// What a triangle of the surface adds. `edges`: bit k, the edge from corner k is over T: the triangle across belongs to U.
  struct Look {
    bool over = false;
    int edges = 0;
  };
  Look add(const Corners& s);

  double bound() const { return bound_ + shrunk_ + 2 * slack_; }
  /// Is U once over T, or more often?
  bool is_whole() const;

 private:
  struct Flat {
    double x, y;
  };
  Flat flat(const Vec3& p) const;
  double inside(int side, const Flat& p) const { return side_x_[side] * p.x + side_y_[side] * p.y + side_d_[side]; }

  Vec3 origin_, across_, up_, along_;
  std::array<double, 3> side_x_, side_y_, side_d_;   // depth inside each side, less slack
  double slack_, shrunk_ = 0, whole_ = 0, area_ = 0, bound_ = 0;
  bool has_plane_ = false;
};

/// How far T is from some triangles.
struct Nearness {
  double to_one;        ///< of all of T from the nearest one (the distance being convex, that of the farthest corner)
  std::size_t one;      ///< that one
  double of_a_corner;   ///< of T's farthest corner from whichever is nearest to it
};
Nearness nearness(const Corners& t, const std::vector<Corners>& others);

/// T's halves, cut across the longest side.
std::array<Corners, 2> halves(const Corners& t);

/// Covers T by the surface, from seeds on. `corners(s)`: a triangle's; `across(s, k)`: the one beyond its edge from corner k. Adds the triangles of U to
/// `used`. `seen`: of each triangle the stamp of the last question that reached it; `stamp` is a new one. Infinite if there is no proof of `most` or less.
template <class OfTriangle, class Across>
double cover(const Corners& t, const std::vector<std::uint32_t>& seeds, const OfTriangle& corners, const Across& across, double most, double slack, double give,
             std::vector<std::uint32_t>& used, std::vector<std::uint64_t>& seen, std::uint64_t stamp) {
  TriangleCover over(t, slack, give);
  constexpr double too_far = std::numeric_limits<double>::infinity();
  if (!over.has_plane()) return too_far;
  std::vector<std::uint32_t>& stack = used;   // what was reached, in this order
  const std::size_t first = stack.size();
  for (const std::uint32_t s : seeds)
    if (seen[s] != stamp) seen[s] = stamp, stack.push_back(s);
  std::size_t kept = first;
  for (std::size_t k = first; k < stack.size(); ++k) {
    const std::uint32_t s = stack[k];
    const TriangleCover::Look look = over.add(corners(s));
    if (over.bound() > most) return too_far;
    for (int edge = 0; edge < 3; ++edge)
      if (look.edges >> edge & 1)
        if (const std::uint32_t next = across(s, edge); seen[next] != stamp) seen[next] = stamp, stack.push_back(next);
    if (look.over) stack[kept++] = s;   // never ahead of k
  }
  stack.resize(kept);
  return over.is_whole() ? over.bound() : too_far;
}

/// As cover(), but where that says nothing T is halved, again and again: of each part it is asked again, and whether all of it is near one of the seeds,
/// as beside a sharp edge that it reaches beyond. With a seam of up to `give`.
template <class OfTriangle, class Across>
double cover_by_parts(const Corners& t, const std::vector<std::uint32_t>& seeds, const OfTriangle& corners, const Across& across, double most, double slack,
                      double give, std::vector<std::uint32_t>& used, std::vector<std::uint64_t>& seen, std::uint64_t& stamp) {
  constexpr int most_parts = 48;
  used.clear();
  const double whole = cover(t, seeds, corners, across, most, slack, 0, used, seen, ++stamp);
  if (whole <= most) return whole;
  used.clear();
  std::vector<Corners> others, parts{t};
  for (const std::uint32_t s : seeds) others.push_back(corners(s));
  double bound = 0;
  for (int tried = 0; !parts.empty(); ++tried) {
    if (tried > most_parts) return std::numeric_limits<double>::infinity();
    const Corners part = parts.back();
    parts.pop_back();
    std::vector<std::uint32_t> over;
    double far = cover(part, seeds, corners, across, most, slack, give, over, seen, ++stamp);
    if (!(far <= most)) {
      const Nearness near = nearness(part, others);
      if (near.of_a_corner > most) return std::numeric_limits<double>::infinity();   // nothing here is near: no parts will be
      far = near.to_one + 2 * slack;
      over.assign(1, seeds[near.one]);
    }
    if (far <= most) {
      bound = std::max(bound, far);
      used.insert(used.end(), over.begin(), over.end());
      continue;
    }
    for (const Corners& half : halves(part)) parts.push_back(half);
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return bound;
}

}  // namespace starcell
