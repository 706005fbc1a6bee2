#include "subdivision/candidate_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace starcell {
namespace {

// Normals are looked up in cubes of this size; facets so small that the tolerance turns them farther stay on their own.
constexpr double cube = 1e-6;

using Key = std::array<int, 3>;

}  // namespace

void find_candidate_surfaces(FacetTable& table, std::uint32_t first, std::uint32_t last, double tolerance) {
  const std::size_t n = last - first;
  std::vector<Vec3> normal(n);
  std::vector<double> area(n);
  std::vector<std::uint32_t> order(n);
  struct Placed {
    double height;   // along its own normal
    std::uint32_t facet;
  };
  std::map<Key, std::vector<Placed>> unassigned;   // by normals
  double scale = 0;
  const auto key_of = [](const Vec3& v) { return Key{static_cast<int>(std::floor(v.x() / cube)), static_cast<int>(std::floor(v.y() / cube)), static_cast<int>(std::floor(v.z() / cube))}; };
  for (std::uint32_t k = 0; k < n; ++k) {
    order[k] = k;
    const Vec3 v = table.area_vector(first + k);
    area[k] = v.norm();
    normal[k] = area[k] > 0 ? Vec3(v / area[k]) : Vec3::UnitX();
    for (int c = 0; c < 3; ++c) scale = std::max(scale, table.corner(first + k, c).norm());
    unassigned[key_of(normal[k])].push_back({normal[k].dot(table.corner(first + k, 0)), k});
  }
  for (auto& [key, placed] : unassigned) std::stable_sort(placed.begin(), placed.end(), [](const Placed& x, const Placed& y) { return x.height < y.height; });
  // Normals in neighbouring cubes: heights of one plane differ by this at most.
  const double window = 4 * cube * scale + tolerance;
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
            const double height = sense * plane.offset;
            auto from = std::lower_bound(at->second.begin(), at->second.end(), height - window, [](const Placed& x, double h) { return x.height < h; });
            for (; from != at->second.end() && from->height <= height + window; ++from)
              if (table.surface[first + from->facet] == UINT32_MAX && table.distance(plane, first + from->facet) <= tolerance) table.surface[first + from->facet] = id;
          }
    }
    table.surface[first + seed] = id;
    table.surfaces.push_back(plane);
  }
}

}  // namespace starcell
