#include "contouring/relaxed_cells.h"

namespace starcell {
namespace {

bool meet(const GridPoint& low, const GridPoint& high, const GridPoint& other_low, const GridPoint& other_high) {
  for (int k = 0; k < 3; ++k)
    if (low[k] > other_high[k] || other_low[k] > high[k]) return false;
  return true;
}

int child_towards(const Cell& cell, const GridPoint& p) {
  int index = 0;
  for (int k = 0; k < 3; ++k) index |= (p[k] >= cell.lower[k] + cell.size / 2) << k;
  return index;
}

}  // namespace

void RelaxedCells::add(const Cell& cell) {
  Node* node = &root_;
  for (Cell at{{0, 0, 0}, size_, 0}; at.size > cell.size;) {
    if (!node->children) node->children = std::make_unique<std::array<Node, 8>>();
    const int index = child_towards(at, cell.lower);
    node = &(*node->children)[index];
    at = at.child(index);
  }
  node->relaxed = true;
}

bool RelaxedCells::has(const Cell& cell) const {
  const Node* node = &root_;
  for (Cell at{{0, 0, 0}, size_, 0}; at.size > cell.size;) {
    if (!node->children) return false;
    const int index = child_towards(at, cell.lower);
    node = &(*node->children)[index];
    at = at.child(index);
  }
  return node->relaxed;
}

bool RelaxedCells::touch(const Crossing& x) const {
  GridPoint low, high;
  low[x.axis] = x.low, high[x.axis] = x.high;
  low[(x.axis + 1) % 3] = high[(x.axis + 1) % 3] = x.i;
  low[(x.axis + 2) % 3] = high[(x.axis + 2) % 3] = x.j;
  return touch(low, high);
}

bool RelaxedCells::touch(const Node& node, const Cell& at, const GridPoint& low, const GridPoint& high) {
  if (node.relaxed) return meet(low, high, at.lower, at.upper());
  if (!node.children || !meet(low, high, at.lower, at.upper())) return false;
  for (int i = 0; i < 8; ++i)
    if (touch((*node.children)[i], at.child(i), low, high)) return true;
  return false;
}

}  // namespace starcell
