#include "subdivision/face_pieces.h"

#include <algorithm>
#include <cmath>

#include "numerics/predicates.h"
#include "subdivision/grid_line.h"

namespace starcell {
namespace {

class Clipper {
 public:
  Clipper(const Restriction& restriction, const Face& face)
      : table_(restriction.table()), grid_(restriction.grid()), face_(face), a_(face.axis), b_(face.b_axis()),
        c_(face.c_axis()) {
    const Vec3 low = grid_.point(face.corner(0, 0)), high = grid_.point(face.corner(1, 1));
    at_ = low[a_];
    limit_ = {low[b_], high[b_], low[c_], high[c_]};
  }

  bool clip(std::uint32_t facet, Piece& piece) const {
    const Triangle& t = table_.corners[facet];
    std::array<bool, 3> under;
    for (int k = 0; k < 3; ++k) under[k] = below(table_.points[t[k]][a_], at_);
    if (under[0] == under[1] && under[1] == under[2]) return false;
    int up = 0, down = 0;
    for (int k = 0; k < 3; ++k) {
      if (under[k] && !under[(k + 1) % 3]) up = k;
      if (!under[k] && under[(k + 1) % 3]) down = k;
    }
    // Bit s: the end lies beyond side s. The piece runs from the upward to the downward mesh edge.
    const unsigned from = beyond(table_.points[t[up]], table_.points[t[(up + 1) % 3]]);
    const unsigned to = beyond(table_.points[t[(down + 1) % 3]], table_.points[t[down]]);
    if (from & to) return false;
    piece.facet = facet;
    piece.surface = table_.surface[facet];
    if (!end(facet, from, to, table_.neighbours[facet][up], piece.from)) return false;
    return end(facet, to, from, table_.neighbours[facet][down], piece.to);
  }

 private:
  // Which sides the mesh edge's intersection with the plane lies beyond; p is under the plane, q above.
  unsigned beyond(const Vec3& p, const Vec3& q) const {
    unsigned code = 0;
    for (int s = 0; s < 4; ++s) {
      const int axis = s < 2 ? b_ : c_;
      const bool lies_below = below_limit(p, q, axis, limit_[s]);
      if (lies_below == (s % 2 == 0)) code |= 1u << s;
    }
    return code;
  }

  bool below_limit(const Vec3& p, const Vec3& q, int axis, double limit) const {
    if (std::max(p[axis], q[axis]) <= limit) return true;
    if (std::min(p[axis], q[axis]) > limit) return false;
    // p -> q runs towards +a, so a limit on its left is above the intersection point.
    return turn_grid({p[a_], p[axis]}, {q[a_], q[axis]}, {at_, limit}, a_, axis) > 0;
  }

  // The end that lies `beyond` (0: inside), clipped where the piece enters the face; `other` is the far end's code.
  bool end(std::uint32_t facet, unsigned beyond, unsigned other, std::uint32_t neighbour, PieceEnd& result) const {
    if (beyond == 0) {
      result.side = -1;
      result.neighbour = neighbour;
      return true;
    }
    for (int s = 0; s < 4; ++s)
      if ((beyond >> s & 1) && !(other >> s & 1) && crosses_side(facet, s, result)) return true;
    return false;
  }

  // The facet meets the line of side s once; is that between the face's corners?
  bool crosses_side(std::uint32_t facet, int s, PieceEnd& result) const {
    const int axis = s < 2 ? c_ : b_;  // the side runs along this axis
    const int sign = turn(project(table_.corner(facet, 0), axis), project(table_.corner(facet, 1), axis),
                          project(table_.corner(facet, 2), axis));
    const GridPoint low = s < 2 ? face_.corner(s, 0) : face_.corner(0, s - 2);
    const GridPoint high = s < 2 ? face_.corner(s, 1) : face_.corner(1, s - 2);
    const Vec3 p = grid_.point(low), q = grid_.point(high);
    if (crossing_below(table_, facet, sign, p) || !crossing_below(table_, facet, sign, q)) return false;
    result.side = s;
    result.crossing = side_crossing(table_, grid_, face_, s, table_.surface[facet]);
    return true;
  }

  const FacetTable& table_;
  const Grid& grid_;
  const Face& face_;
  const int a_, b_, c_;
  double at_;
  std::array<double, 4> limit_;
};

}  // namespace

Crossing side_crossing(const FacetTable& table, const Grid& grid, const Face& face, int side, std::uint32_t surface) {
  const int axis = side < 2 ? face.c_axis() : face.b_axis();
  const GridPoint low = side < 2 ? face.corner(side, 0) : face.corner(0, side - 2);
  const Vec3 p = grid.point(low);
  Crossing x;
  x.axis = static_cast<std::uint8_t>(axis);
  x.i = low[(axis + 1) % 3];
  x.j = low[(axis + 2) % 3];
  x.surface = surface;
  x.low = low[axis];
  x.high = low[axis] + face.size;
  const Surface& plane = table.surfaces[surface];
  const double rest = plane.offset - plane.normal[(axis + 1) % 3] * p[(axis + 1) % 3] -
                      plane.normal[(axis + 2) % 3] * p[(axis + 2) % 3];
  const double at = plane.normal[axis] != 0 ? rest / plane.normal[axis] : p[axis];
  x.at = std::clamp(std::isfinite(at) ? at : p[axis], p[axis], grid.coordinate(axis, x.high));
  return x;
}

std::vector<Piece> face_pieces(const Restriction& restriction, const CellProblem& problem,
                               const std::vector<std::uint32_t>& facets, const Face& face) {
  const FacetTable& table = restriction.table();
  const Clipper clipper(restriction, face);
  std::vector<Piece> pieces;
  std::uint32_t slot = 0;
  for (const std::uint32_t f : facets) {
    if (problem.slots() > 1)
      while (f >= table.first[problem.expression.solids()[slot] + 1]) ++slot;
    Piece piece;
    if (!clipper.clip(f, piece)) continue;
    piece.slot = slot;
    pieces.push_back(piece);
  }
  return pieces;
}

Vec3 pierce_point(const Restriction& restriction, const Face& face, std::uint32_t facet, std::uint32_t neighbour) {
  const FacetTable& table = restriction.table();
  int k = 0;
  while (table.neighbours[facet][k] != neighbour && k < 2) ++k;
  std::uint32_t ip = table.corners[facet][k], iq = table.corners[facet][(k + 1) % 3];
  if (ip > iq) std::swap(ip, iq);  // the same arithmetic from both sides of the edge
  const Vec3 &p = table.points[ip], &q = table.points[iq];
  const Vec3 low = restriction.grid().point(face.corner(0, 0)), high = restriction.grid().point(face.corner(1, 1));
  const int a = face.axis;
  const double t = std::clamp((low[a] - p[a]) / (q[a] - p[a]), 0.0, 1.0);
  Vec3 x = p + t * (q - p);
  for (int axis = 0; axis < 3; ++axis) x[axis] = std::clamp(x[axis], low[axis], high[axis]);
  return x;
}

}  // namespace starcell
