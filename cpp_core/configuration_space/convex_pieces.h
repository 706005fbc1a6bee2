// A polygon as a tree of convex pieces, each coarser one exact wherever nothing comes near its pockets.
//
// At a reflex corner one of its two sides is prolonged until it meets the polygon again, which cuts the polygon in two, and so on until all is convex (the naive
// decomposition of Chazelle & Dobkin 1985; among several corners the one whose cut is shortest). A node of the tree is the convex hull of what was there before the
// cut, with its *pockets*, what the hull has too much. What is apart from all pockets meets the hull exactly where it meets the polygon: so seams between pieces matter
// only to what reaches into the pocket that made them. A hole is joined to what is about it by a first cut, along one of its sides: a pocket as others.
// Guarantees: exact; corners that are not the polygon's are enclosed; a pocket is in its convex hull, which stands for it. Does not guarantee fewest pieces.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "numerics/interval.h"

namespace starcell {

using Point2 = std::array<double, 2>;
using Ring = std::vector<Point2>;

struct PlanarPolygon {
  Ring outer;
  std::vector<Ring> holes;
  PlanarPolygon(Ring outer, std::vector<Ring> holes = {}) : outer(std::move(outer)), holes(std::move(holes)) {}
};

struct PieceCorner {
  Interval x, y;
  std::uint32_t id;     ///< the same corner of another piece has the same one
};

/// The line of sides; from one corner to another.
struct PlaneLine {
  PieceCorner from, to;
};

/// Convex, anticlockwise. Side k runs from corner k to corner k + 1.
struct ConvexPiece {
  struct Side {
    std::uint32_t line;
    bool along;          ///< the way its line runs: what is inside the piece lies to its left; else against it
  };
  std::vector<PieceCorner> corners;
  std::vector<Side> sides;
  Point2 center{};       ///< of a circle that contains the piece
  double radius = 0;
};

struct PieceNode {
  ConvexPiece hull;
  std::vector<ConvexPiece> pockets;                 ///< none: it is the hull
  std::array<std::uint32_t, 2> children{};          ///< the two that it was cut into, if it was
};

/// Where a cut ends in a side: two pieces that have a part of the side each, and the node that stands for both. It has pockets, and no children.
struct Seam {
  std::uint32_t first, second, both;
};

struct PieceTree {
  std::vector<PlaneLine> lines;
  std::vector<PieceNode> nodes;
  std::vector<Seam> seams;
  std::vector<std::uint32_t> roots;                 ///< one a polygon
};

/// The union of simple polygons with holes, rings in either sense. Throws InvalidSolidError, which names `what`, the polygon's number and the place, for one of which a ring has
/// fewer than three corners, crosses or touches itself or another, has no area, or is not finite, or a hole is not in it.
PieceTree piece_tree(const std::vector<PlanarPolygon>& polygons, const char* what);

/// A straight link from the origin to (length, 0): a piece of two corners and two sides.
PieceTree segment_piece(double length);

}  // namespace starcell
