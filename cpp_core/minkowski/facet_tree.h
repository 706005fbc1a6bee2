// A bounding-box tree over a mesh's facets, for tests of one mesh against another that is moved.
//
// Guarantees: boxes contain their facets; the same tree for any number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

class FacetTree {
 public:
  struct Node {
    Box3 box;
    std::uint32_t first = 0, last = 0;   ///< order()[first .. last)
    std::uint32_t child = 0;             ///< and child + 1; 0: a leaf
  };

  FacetTree(const std::vector<Vec3>& points, const std::vector<Triangle>& facets);

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace starcell
