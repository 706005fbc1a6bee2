#include "subdivision/candidate_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace starcell {
namespace {

// Normals are looked up in cubes of this size; facets so small that the tolerance turns them farther stay on their own.
constexpr double cube = 1e-3;

using Key = std::array<int, 3>;

}  // namespace

void find_candidate_surfaces(FacetTable& table, std::uint32_t first, std::uint32_t last, double tolerance) {
  const std::size_t n = last - first;
  std::vector<Vec3> normal(n);
  std::vector<double> area(n);
  std::vector<std::uint32_t> order(n);
  std::map<Key, std::vector<std::uint32_t>> unassigned;   // a normal and its opposite are one
  const auto key_of = [](const Vec3& v) { return Key{static_cast<int>(std::floor(v.x() / cube)), static_cast<int>(std::floor(v.y() / cube)), static_cast<int>(std::floor(v.z() / cube))}; };
  for (std::uint32_t k = 0; k < n; ++k) {
    order[k] = k;
    const Vec3 v = table.area_vector(first + k);
    area[k] = v.norm();
    normal[k] = area[k] > 0 ? Vec3(v / area[k]) : Vec3::UnitX();
    unassigned[key_of(normal[k])].push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return area[a] > area[b]; });
  table.surface.resize(last, UINT32_MAX);
  for (const std::uint32_t seed : order) {
    if (table.surface[first + seed] != UINT32_MAX) continue;
    Surface plane;
    plane.normal = normal[seed];
    plane.offset = plane.normal.dot((table.corner(first + seed, 0) + table.corner(first + seed, 1) + table.corner(first + seed, 2)) / 3);
    const auto id = static_cast<std::uint32_t>(table.surfaces.size());
    for (const double sense : {1.0, -1.0}) {
      const Key middle = key_of(sense * plane.normal);
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          for (int k = -1; k <= 1; ++k) {
            const auto at = unassigned.find({middle[0] + i, middle[1] + j, middle[2] + k});
            if (at == unassigned.end()) continue;
            std::erase_if(at->second, [&](std::uint32_t f) {
              if (table.surface[first + f] != UINT32_MAX) return true;
              if (f != seed && table.distance(plane, first + f) > tolerance) return false;
              table.surface[first + f] = id;
              return true;
            });
          }
    }
    table.surface[first + seed] = id;
    table.surfaces.push_back(plane);
  }
}

}  // namespace starcell
