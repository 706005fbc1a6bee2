// Minimal faces: the squares of grid planes on which neighbouring leaves agree. Where a leaf's side meets smaller cells,
// theirs count; between equals, the cell below the side owns it. So every arc of E between leaves is drawn once and used from
// both sides, which is what closes the mesh.
#pragma once

#include <vector>

#include "subdivision/octree.h"

namespace starcell {

struct MinimalFace {
  const Leaf* owner;    ///< whose arcs count
  int owner_side;       ///< on which of its sides
  int side;             ///< the side of the leaf that was asked about
  bool every_bend;      ///< a fan on either side is exact as long as its loop is

  Face face() const { return face_of(owner->problem.cell, owner_side); }
  const std::vector<Arc>& arcs() const { return owner->arcs[owner_side]; }
};

/// The minimal faces around a leaf that carry arcs, ordered by side.
std::vector<MinimalFace> minimal_faces(const Octree& tree, const Leaf& leaf);

}  // namespace starcell
