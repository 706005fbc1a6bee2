// The octree's coordinates: cells and grid lines are integers; those of all but the smallest cells are float32 numbers.
//
// FreeCAD's meshes are float32. World coordinate = unit * integer with a power of two for the unit. Planes of cells of at
// least `step` are multiples of it, and those are float32 numbers: rounding a point of such a cell's face to float32 (a
// monotone map) cannot carry it off that face (DESIGN §3). Smaller cells exist because E may have slivers thinner than a
// float32 step; what rounding does to them is tested on the finished mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "numerics/vector.h"

namespace starcell {

using GridPoint = std::array<std::uint32_t, 3>;

struct Grid {
  double unit = 1.0;
  double step = 1.0;                     ///< multiples of it in the root box are float32 numbers; a multiple of unit
  std::array<std::int64_t, 3> origin{};  ///< lower corner of the root, in units
  int depth = 0;                         ///< the root's side is 2^depth units
  int finer = 0;                         ///< crossings of lines are told apart down to unit / 2^finer: doubles hold such coordinates

  double coordinate(int axis, std::uint32_t index) const {
    return unit * static_cast<double>(origin[axis] + static_cast<std::int64_t>(index));
  }
  /// Of a point between grid points, `fraction` in units / 2^finer.
  double coordinate(int axis, std::uint32_t index, std::uint64_t fraction) const {
    return unit * (static_cast<double>(origin[axis] + static_cast<std::int64_t>(index)) + std::ldexp(static_cast<double>(fraction), -finer));
  }
  double length(std::uint32_t size) const { return unit * static_cast<double>(size); }
  /// Room for a point on an edge or a face of this size: two float32 steps where the size allows.
  double margin(std::uint32_t size) const { return std::min(2 * step, length(size) / 16); }
  /// How far apart crossings of one line are kept: enough for the sheets through them to stay apart in float32.
  double gap(std::uint32_t size) const { return std::min(8 * step, length(size) / 16); }
  /// Far above double rounding, far below float32's: points this far apart are surely in order, and proofs about them have room.
  double least_gap() const {
    double reach = 0;
    for (const std::int64_t o : origin) reach = std::max({reach, std::abs(unit * static_cast<double>(o)), std::abs(unit * static_cast<double>(o + (std::int64_t{1} << depth)))});
    return 16384 * 2.220446049250313e-16 * reach;
  }
  /// Is the size large enough for sheets to be kept apart in float32 too, at a cost that is worth it?
  bool holds_floats(std::uint32_t size) const { return length(size) >= 512 * step; }
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
