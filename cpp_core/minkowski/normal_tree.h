// Which features of two operands have an outward normal in common? A pair of trees over caps of normals answers without looking
// at all pairs.
//
// Guarantees: every pair whose caps meet is visited, once, in an order that depends on the input alone.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "minkowski/sum_operand.h"

namespace starcell {

class NormalTree {
 public:
  explicit NormalTree(std::vector<NormalCap> caps);

  /// Calls visit(i, j) for items i of a and j of b whose caps meet.
  static void meeting(const NormalTree& a, const NormalTree& b, const std::function<void(std::uint32_t, std::uint32_t)>& visit);

 private:
  struct Node {
    NormalCap cap;
    std::uint32_t first = 0, last = 0;   // items_[first .. last)
    std::uint32_t child = 0;             // and child + 1; 0: a leaf
  };
  void build(std::uint32_t node);

  std::vector<NormalCap> caps_;
  std::vector<std::uint32_t> items_;
  std::vector<Node> nodes_;
};

}  // namespace starcell
