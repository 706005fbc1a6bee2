#include "contouring/minimal_faces.h"

#include <algorithm>

namespace starcell {
namespace {

bool has_cone(const Leaf& leaf) {
  return std::any_of(leaf.sheets.begin(), leaf.sheets.end(), [](const Sheet& sheet) {
    return sheet.shape == Sheet::Shape::planar || sheet.shape == Sheet::Shape::crease || sheet.shape == Sheet::Shape::corner ||
           sheet.shape == Sheet::Shape::flats;
  });
}

void add(const Leaf& owner, int owner_side, int side, bool every_bend, std::vector<MinimalFace>& faces) {
  if (!owner.arcs[owner_side].empty()) faces.push_back({&owner, owner_side, side, every_bend});
}

void add_finer(const OctreeNode& node, int side, bool cone, std::vector<MinimalFace>& faces) {
  if (node.children) {
    for (int i = 0; i < 8; ++i)
      if ((i >> side / 2 & 1) == (side % 2 ? 0 : 1)) add_finer((*node.children)[i], side, cone, faces);
  } else if (node.leaf) {
    add(*node.leaf, side ^ 1, side, cone || has_cone(*node.leaf), faces);
  }
}

}  // namespace

std::vector<MinimalFace> minimal_faces(const Octree& tree, const Leaf& leaf) {
  std::vector<MinimalFace> faces;
  const Cell& cell = leaf.problem.cell;
  const bool cone = has_cone(leaf);
  for (int side = 0; side < 6; ++side) {
    Cell found;
    const OctreeNode* beyond = tree.across(cell, side, found);
    const Leaf* other = beyond ? beyond->leaf.get() : nullptr;
    if (beyond && beyond->children)
      add_finer(*beyond, side, cone, faces);
    else if (other && found.size == cell.size && side % 2 == 0)
      add(*other, side + 1, side, cone || has_cone(*other), faces);
    else
      add(leaf, side, side, cone || (other && has_cone(*other)), faces);
  }
  return faces;
}

}  // namespace starcell
