#include "isotopy/triangle_grid.h"

#include <algorithm>
#include <cmath>

namespace starcell {

std::size_t TriangleGrid::Hash::operator()(const Key& k) const {
  std::uint64_t h = 0;
  for (const std::int64_t x : k) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
  return h;
}

double TriangleGrid::cell_size(int level) const { return std::ldexp(finest_, level); }

// A box spans at most two cells of its level along each axis.
int TriangleGrid::level_of(const Box3& box) const {
  const double size = box.sizes().maxCoeff();
  return size <= finest_ ? 0 : static_cast<int>(std::ceil(std::log2(size / finest_)));
}

template <class F>
void TriangleGrid::for_cells(const Box3& box, int level, const F& f) const {
  const double size = cell_size(level);
  const auto index = [size](double x) { return static_cast<std::int64_t>(std::floor(x / size)); };
  Key k;
  for (k[0] = index(box.min().x()); k[0] <= index(box.max().x()); ++k[0])
    for (k[1] = index(box.min().y()); k[1] <= index(box.max().y()); ++k[1])
      for (k[2] = index(box.min().z()); k[2] <= index(box.max().z()); ++k[2]) f(k);
}

void TriangleGrid::add(std::uint32_t triangle, const Box3& box) {
  const int level = level_of(box);
  if (levels_.size() <= static_cast<std::size_t>(level)) levels_.resize(static_cast<std::size_t>(level) + 1);
  for_cells(box, level, [&](const Key& k) { levels_[static_cast<std::size_t>(level)][k].push_back(triangle); });
}

void TriangleGrid::remove(std::uint32_t triangle, const Box3& box) {
  const int level = level_of(box);
  Cells& cells = levels_[static_cast<std::size_t>(level)];
  for_cells(box, level, [&](const Key& k) {
    const auto cell = cells.find(k);
    std::erase(cell->second, triangle);
    if (cell->second.empty()) cells.erase(cell);
  });
}

std::vector<std::uint32_t> TriangleGrid::near(const Box3& box) const {
  std::vector<std::uint32_t> found;
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    const Cells& cells = levels_[level];
    if (cells.empty()) continue;
    const double size = cell_size(static_cast<int>(level));
    const double spanned = (box.sizes() / size + Vec3::Ones()).prod();
    if (spanned < static_cast<double>(cells.size())) {
      for_cells(box, static_cast<int>(level), [&](const Key& k) {
        if (const auto cell = cells.find(k); cell != cells.end()) found.insert(found.end(), cell->second.begin(), cell->second.end());
      });
      continue;
    }
    for (const auto& [k, triangles] : cells) {
      const Vec3 low = size * Vec3(static_cast<double>(k[0]), static_cast<double>(k[1]), static_cast<double>(k[2]));
      if (Box3(low - Vec3::Constant(1e-9 * size), low + Vec3::Constant(size * (1 + 1e-9))).intersects(box)) found.insert(found.end(), triangles.begin(), triangles.end());
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace starcell
