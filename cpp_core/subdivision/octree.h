// The octree: accepted leaves, and who lies beyond a side of a cell.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "subdivision/leaf.h"

namespace starcell {

/// A node without children and without a leaf is a cell that E does not meet.
struct OctreeNode {
  std::unique_ptr<std::array<OctreeNode, 8>> children;
  std::unique_ptr<Leaf> leaf;
};

struct Octree {
  OctreeNode root;
  std::uint32_t size = 0;   ///< of the root cell, in grid units

  /// Leaves that E meets, depth first: the same order for every run.
  std::vector<Leaf*> leaves() const;

  /// The node across a side of a cell: of the cell's size, or the larger leaf that contains it; null outside the root.
  const OctreeNode* across(const Cell& cell, int side, Cell& found) const;

  /// Replaces a leaf's node, found by its cell.
  OctreeNode* node_of(const Cell& cell);
};

}  // namespace starcell
