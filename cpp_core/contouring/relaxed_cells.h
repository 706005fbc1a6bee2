// Cells whose sheets lie nearer to each other than float32 can tell, over longer stretches than cells can be split for.
//
// Elsewhere crossings are kept float32 steps apart and off the corners (trace_points.h). Between such sheets that does harm:
// where they run along a grid line, moved points of one sheet come to lie beyond unmoved ones of the next. In and around
// these cells all points stay where E has them, to within double rounding; the finished mesh is tested in float32 as a whole.
#pragma once

#include <algorithm>
#include <vector>

#include "subdivision/grid.h"
#include "subdivision/trace.h"

namespace starcell {

class RelaxedCells {
 public:
  void add(const Cell& cell) {
    if (cells_.empty()) low_ = cell.lower, high_ = cell.upper();
    const GridPoint upper = cell.upper();
    for (int k = 0; k < 3; ++k) low_[k] = std::min(low_[k], cell.lower[k]), high_[k] = std::max(high_[k], upper[k]);
    cells_.push_back(cell);
  }
  bool has(const Cell& cell) const {
    return std::any_of(cells_.begin(), cells_.end(), [&](const Cell& c) { return c.lower == cell.lower && c.size == cell.size; });
  }
  /// Does the box of grid points meet any of them?
  bool touch(const GridPoint& low, const GridPoint& high) const {
    if (cells_.empty() || !meet(low, high, low_, high_)) return false;
    return std::any_of(cells_.begin(), cells_.end(), [&](const Cell& c) { return meet(low, high, c.lower, c.upper()); });
  }
  bool touch(const Cell& cell) const { return touch(cell.lower, cell.upper()); }
  bool touch(const Face& face) const { return touch(face.corner(0, 0), face.corner(1, 1)); }
  bool touch(const Crossing& x) const {
    GridPoint low, high;
    low[x.axis] = x.low, high[x.axis] = x.high;
    low[(x.axis + 1) % 3] = high[(x.axis + 1) % 3] = x.i;
    low[(x.axis + 2) % 3] = high[(x.axis + 2) % 3] = x.j;
    return touch(low, high);
  }

 private:
  static bool meet(const GridPoint& low, const GridPoint& high, const GridPoint& other_low, const GridPoint& other_high) {
    for (int k = 0; k < 3; ++k)
      if (low[k] > other_high[k] || other_low[k] > high[k]) return false;
    return true;
  }

  std::vector<Cell> cells_;
  GridPoint low_{}, high_{};
};

}  // namespace starcell
