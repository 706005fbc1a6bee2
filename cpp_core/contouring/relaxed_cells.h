// Cells whose sheets lie nearer to each other than float32 can tell, over longer stretches than cells can be split for.
//
// Elsewhere crossings are kept float32 steps apart and off the corners (trace_points.h). Between such sheets that does harm:
// where they run along a grid line, moved points of one sheet come to lie beyond unmoved ones of the next. In and around
// these cells all points stay where E has them, to within double rounding; the finished mesh is tested in float32 as a whole.
#pragma once

#include <array>
#include <memory>

#include "subdivision/grid.h"
#include "subdivision/trace.h"

namespace starcell {

class RelaxedCells {
 public:
  /// `size`: of the octree's root cell, in grid units.
  explicit RelaxedCells(std::uint32_t size) : size_(size) {}

  void add(const Cell& cell);
  bool has(const Cell& cell) const;

  /// Does the cell, face or edge meet any of them, if only in a corner?
  bool touch(const Cell& cell) const { return touch(cell.lower, cell.upper()); }
  bool touch(const Face& face) const { return touch(face.corner(0, 0), face.corner(1, 1)); }
  bool touch(const Crossing& x) const;

 private:
  // An octree of the relaxed cells alone; they are leaves of one octree, so none contains another for long.
  struct Node {
    std::unique_ptr<std::array<Node, 8>> children;
    bool relaxed = false;
  };

  bool touch(const GridPoint& low, const GridPoint& high) const { return touch(root_, {{0, 0, 0}, size_, 0}, low, high); }
  static bool touch(const Node& node, const Cell& at, const GridPoint& low, const GridPoint& high);

  std::uint32_t size_;
  Node root_;
};

}  // namespace starcell
