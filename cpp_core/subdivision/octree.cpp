#include "subdivision/octree.h"

namespace starcell {
namespace {

void collect(const OctreeNode& node, std::vector<Leaf*>& leaves) {
  if (node.leaf) leaves.push_back(node.leaf.get());
  if (node.children)
    for (const OctreeNode& child : *node.children) collect(child, leaves);
}

int child_towards(const Cell& cell, const GridPoint& p) {
  int index = 0;
  for (int k = 0; k < 3; ++k) index |= (p[k] >= cell.lower[k] + cell.size / 2) << k;
  return index;
}

}  // namespace

std::vector<Leaf*> Octree::leaves() const {
  std::vector<Leaf*> result;
  collect(root, result);
  return result;
}

const OctreeNode* Octree::across(const Cell& cell, int side, Cell& found) const {
  const int axis = side / 2;
  if (side % 2 ? cell.lower[axis] + cell.size >= size : cell.lower[axis] == 0) return nullptr;
  GridPoint target = cell.lower;
  target[axis] += side % 2 ? cell.size : -cell.size;
  const OctreeNode* node = &root;
  found = {{0, 0, 0}, size, 0};
  while (node->children && found.size > cell.size) {
    const int index = child_towards(found, target);
    node = &(*node->children)[index];
    found = found.child(index);
  }
  return node;
}

OctreeNode* Octree::node_of(const Cell& cell) {
  OctreeNode* node = &root;
  Cell at{{0, 0, 0}, size, 0};
  while (node->children && at.size > cell.size) {
    const int index = child_towards(at, cell.lower);
    node = &(*node->children)[index];
    at = at.child(index);
  }
  return node;
}

}  // namespace starcell
