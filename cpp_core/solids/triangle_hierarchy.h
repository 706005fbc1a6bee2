// A bounding-box tree over triangles, for two questions: which pairs of them may meet, and which of them may lie above a
// point.
// Guarantees: conservative (boxes are float32, rounded outward); the same tree for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

class TriangleHierarchy {
 public:
  /// Coordinates must be finite. Boxes are widened by `reach` on every side.
  TriangleHierarchy(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double reach = 0);

  /// Calls visit(s, t), in parallel, for every pair s < t whose boxes meet, once. A visit that returns false asks to
  /// stop soon; further visits may still come.
  void overlapping_pairs(const std::function<bool(std::uint32_t, std::uint32_t)>& visit) const;

  /// Calls visit(t) for every triangle whose box meets the vertical ray upward from p.
  void above(const Vec3& p, const std::function<void(std::uint32_t)>& visit) const;

 private:
  struct Bounds {
    float lower[3], upper[3];
  };
  struct Leaf {
    Bounds bounds;
    std::uint32_t triangle;
  };
  class PairSearch;

  // A complete binary tree in heap order: node i has children 2i+1 and 2i+2, and all leaves are on level depth_.
  // Node j of level d owns the triangles leaves_[begin(d, j) ... begin(d, j+1)).
  std::size_t begin(int level, std::size_t j) const { return leaves_.size() * j >> level; }
  void build(int level, std::size_t j);
  static bool meet(const Bounds& a, const Bounds& b);

  int depth_ = 0;
  std::vector<Bounds> nodes_;
  std::vector<Leaf> leaves_;
};

}  // namespace starcell
