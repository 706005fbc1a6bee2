// Triangles of a mesh that changes, found by where they are: one hashed grid per size class.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "numerics/vector.h"

namespace starcell {

class TriangleGrid {
 public:
  /// Boxes of side `finest` and less share the finest grid.
  explicit TriangleGrid(double finest) : finest_(finest) {}

  void add(std::uint32_t triangle, const Box3& box);
  /// With the box it was added with.
  void remove(std::uint32_t triangle, const Box3& box);
  /// All triangles whose boxes may meet this one, each once, ascending.
  std::vector<std::uint32_t> near(const Box3& box) const;

 private:
  using Key = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& k) const;
  };
  using Cells = std::unordered_map<Key, std::vector<std::uint32_t>, Hash>;

  int level_of(const Box3& box) const;
  double cell_size(int level) const;
  template <class F>
  void for_cells(const Box3& box, int level, const F& f) const;

  double finest_;
  std::vector<Cells> levels_;
};

}  // namespace starcell
