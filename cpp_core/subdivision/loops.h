// The closed curves that the arcs of a cell's faces form on its boundary.
#pragma once

#include <optional>
#include <vector>

#include "subdivision/leaf.h"

namespace starcell {

struct LoopArc {
  const Arc* arc;
  int side;        ///< the cell's side it lies on
  bool reversed;   ///< run from end to start
};

/// Counter-clockwise around E's outward normal. Upper sides' arcs run as they are, lower sides' are reversed.
using Loop = std::vector<LoopArc>;

/// None if the arcs do not close up: they were traced on inconsistent faces.
std::optional<std::vector<Loop>> form_loops(const std::vector<LoopArc>& arcs);

/// The loops of a leaf's own arcs.
std::optional<std::vector<Loop>> leaf_loops(const Leaf& leaf);

/// The crossings that a loop passes, ascending.
std::vector<Crossing> crossings_of(const Loop& loop);

}  // namespace starcell
