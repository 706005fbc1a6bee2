// What the trace theorem (DESIGN §3) needs to know of E on the boundary of a cell: crossings of grid edges, and the arcs
// that pair them on the faces. A face may also carry closed curves (the tip of a corner that reaches through it): a disk
// that one of them bounds is as unique as any other, so the theorem holds with them, as long as A's curves lie between the
// same arcs as E's.
//
// Notation: E the true surface, f a face, e an edge. On a face with normal axis a, b = a+1 and c = a+2 (cyclic) are its
// own axes; seen from +a, b points right and c up. Arcs are directed so that the solid lies on their right, seen from +a.
#pragma once

#include <cstdint>
#include <vector>

#include "subdivision/grid.h"

namespace starcell {

/// Stands for "on no known plane".
constexpr std::uint32_t no_surface = UINT32_MAX;

/// A crossing of E with a grid line. A plane meets a line once, so line and surface identify it for every cell; of a smooth
/// surface's crossings each lies in an interval of its own, finer than the grid's.
struct Crossing {
  std::uint8_t axis = 0;         ///< the line's direction
  std::uint32_t i = 0, j = 0;    ///< the line's grid coordinates on axes axis+1 and axis+2
  std::uint32_t surface = 0;
  std::uint64_t root = 0;        ///< smooth surfaces: between root and root + 1 times 2^-Grid::finer units; planes: 0
  std::uint32_t low = 0, high = 0;  ///< the crossing is proved to lie between these grid coordinates
  double at = 0;                 ///< where it is, in world coordinates, to rounding
  std::uint8_t patch = UINT8_MAX;  ///< its patch in the cell that found it; no part of its identity

  friend bool operator==(const Crossing& x, const Crossing& y) {
    return x.axis == y.axis && x.i == y.i && x.j == y.j && x.surface == y.surface && x.root == y.root;
  }
  friend bool operator<(const Crossing& x, const Crossing& y) {
    if (x.axis != y.axis) return x.axis < y.axis;
    if (x.i != y.i) return x.i < y.i;
    if (x.j != y.j) return x.j < y.j;
    if (x.surface != y.surface) return x.surface < y.surface;
    return x.root < y.root;
  }
};

/// Where a crossing is, to rounding.
inline Vec3 place_of(const Crossing& x, const Grid& grid) {
  Vec3 p;
  p[x.axis] = x.at;
  p[(x.axis + 1) % 3] = grid.coordinate((x.axis + 1) % 3, x.i);
  p[(x.axis + 2) % 3] = grid.coordinate((x.axis + 2) % 3, x.j);
  return p;
}

/// A square of a grid plane.
struct Face {
  int axis = 0;
  std::uint32_t at = 0;              ///< its coordinate along axis
  std::uint32_t b = 0, c = 0;        ///< lower corner on axes axis+1, axis+2
  std::uint32_t size = 0;

  int b_axis() const { return (axis + 1) % 3; }
  int c_axis() const { return (axis + 2) % 3; }
  GridPoint corner(int bit_b, int bit_c) const {
    GridPoint p{};
    p[axis] = at;
    p[b_axis()] = b + (bit_b ? size : 0);
    p[c_axis()] = c + (bit_c ? size : 0);
    return p;
  }
  /// One of its four squares; bit 0: upper half along b, bit 1: along c.
  Face quarter(int index) const {
    Face square = *this;
    square.size = size / 2;
    if (index & 1) square.b += square.size;
    if (index & 2) square.c += square.size;
    return square;
  }
  friend bool operator==(const Face&, const Face&) = default;
};

/// Side 0, 1: axis a lower and upper; 2, 3: next axis; 4, 5: last.
inline Face face_of(const Cell& cell, int side) {
  const int axis = side / 2;
  return {axis, cell.lower[axis] + (side % 2 ? cell.size : 0), cell.lower[(axis + 1) % 3], cell.lower[(axis + 2) % 3],
          cell.size};
}


/// One arc of E on a face, from crossing to crossing: surfaces[k] carries the piece between bend k-1 and bend k. Or a closed
/// curve, without crossings: surfaces[k] carries the piece from bend k to the next.
struct Arc {
  Crossing start, end;
  std::vector<Vec3> bends;
  std::vector<std::uint32_t> surfaces;   ///< bends.size() + 1; of a closed curve bends.size()
  bool closed = false;
  std::uint32_t facet = 0;               ///< a facet under the first piece
  bool contact = false;                  ///< sheets that touch were pulled apart on this arc (DESIGN §4)
  bool concurrent = false;               ///< rests on planes taken to pass through one point: F-cone
  double sway = 0;                       ///< E's arc is this far from the polyline at most, point by point (Fréchet)
  Vec3 along = Vec3::Zero();             ///< the direction in which it sways, of unit length; zero: any
};

/// Takes an arc that came back to its start on the same piece for the closed curve that it is; false if it is none.
inline bool close(Arc& arc) {
  if (arc.bends.size() < 3) return false;
  arc.closed = true;
  arc.surfaces.erase(arc.surfaces.begin());
  return true;
}

}  // namespace starcell
