#include "subdivision/local_planes.h"

#include <algorithm>
#include <map>

namespace starcell {
namespace {

Interval joined(const Interval& x, const Interval& y) {
  return {std::min(x.lower(), y.lower()), std::max(x.upper(), y.upper())};
}

constexpr double thinness = 1e-5;   // of the slab, as a share of the cell

bool nearly_one(const Surface& s, const Surface& t, const Box3& box) {
  const Vec3 turn = s.normal - t.normal;
  const Vec3 c = box.center();
  const double apart = std::abs((s.normal.dot(c) - s.offset) - (t.normal.dot(c) - t.offset));
  return apart + 0.5 * turn.norm() * box.diagonal().norm() <= thinness * box.sizes().maxCoeff();
}

}  // namespace

LocalPlanes::LocalPlanes(const FacetTable& table, const std::vector<std::uint32_t>& facets, const Box3& box) {
  std::map<std::uint32_t, std::uint32_t> parent;
  const auto root = [&](std::uint32_t id) {
    for (auto it = parent.find(id); it != parent.end(); it = parent.find(id)) id = it->second;
    return id;
  };
  for (const std::uint32_t f : facets)
    for (const std::uint32_t g : table.neighbours[f]) {
      const std::uint32_t s = table.surface[f], t = table.surface[g];
      if (g < f || s == t || !std::binary_search(facets.begin(), facets.end(), g)) continue;
      if (!nearly_one(table.surfaces[s], table.surfaces[t], box)) continue;
      const std::uint32_t a = root(s), b = root(t);
      if (a != b) parent[std::max(a, b)] = std::min(a, b);
    }
  for (const auto& [id, up] : parent) joined_.emplace_back(id, root(id));
}

std::uint32_t LocalPlanes::of(std::uint32_t surface) const {
  const auto it = std::lower_bound(joined_.begin(), joined_.end(), std::pair(surface, 0u));
  return it != joined_.end() && it->first == surface ? it->second : surface;
}

bool LocalPlanes::alone(std::uint32_t surface) const {
  return std::none_of(joined_.begin(), joined_.end(),
                      [&](const auto& j) { return j.first == surface || j.second == surface; });
}

void LocalPlanes::enclose(const FacetTable& table, std::uint32_t surface, const Vec3& origin, Interval (&n)[3], Interval& d) const {
  const auto one = [&](std::uint32_t id, bool first) {
    const Surface& s = table.surfaces[id];
    Interval dot(0.0);
    for (int k = 0; k < 3; ++k) dot += Interval(s.normal[k]) * Interval(origin[k]);
    const Interval offset = Interval(s.offset) - dot + Interval(-s.thickness, s.thickness);
    for (int k = 0; k < 3; ++k) n[k] = first ? Interval(s.normal[k]) : joined(n[k], Interval(s.normal[k]));
    d = first ? offset : joined(d, offset);
  };
  one(surface, true);
  for (const auto& [id, stands] : joined_)
    if (stands == surface) one(id, false);
}

}  // namespace starcell
