// The octree's coordinates: cells and grid lines are integers, and every one of them is a float32 number.
//
// FreeCAD's meshes are float32. World coordinate = unit * integer with |integer| <= 2^24 and a power of two for the
// unit, so rounding a point of a cell's face to float32 (a monotone map) cannot carry it off that face (DESIGN §3).
#pragma once

#include <array>
#include <cstdint>

#include "numerics/vector.h"

namespace starcell {

using GridPoint = std::array<std::uint32_t, 3>;

struct Grid {
  double unit = 1.0;
  std::array<std::int64_t, 3> origin{};  ///< lower corner of the root, in units
  int depth = 0;                         ///< the root's side is 2^depth units

  double coordinate(int axis, std::uint32_t index) const {
    return unit * static_cast<double>(origin[axis] + static_cast<std::int64_t>(index));
  }
  Vec3 point(const GridPoint& p) const { return {coordinate(0, p[0]), coordinate(1, p[1]), coordinate(2, p[2])}; }
};

/// A cube of the octree: its lower corner and side in grid units.
struct Cell {
  GridPoint lower{};
  std::uint32_t size = 0;
  int level = 0;

  GridPoint upper() const { return {lower[0] + size, lower[1] + size, lower[2] + size}; }
  /// Corner 0..7: bit k set means the upper side along axis k.
  GridPoint corner(int index) const {
    return {lower[0] + (index & 1 ? size : 0), lower[1] + (index & 2 ? size : 0), lower[2] + (index & 4 ? size : 0)};
  }
  Cell child(int index) const {
    const std::uint32_t half = size / 2;
    return {{lower[0] + (index & 1 ? half : 0), lower[1] + (index & 2 ? half : 0), lower[2] + (index & 4 ? half : 0)},
            half, level + 1};
  }
};

inline Box3 box_of(const Grid& grid, const Cell& cell) { return {grid.point(cell.lower), grid.point(cell.upper())}; }

}  // namespace starcell
