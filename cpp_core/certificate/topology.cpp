#include "certificate/topology.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace starcell {

void count_topology(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, Certificate& certificate) {
  std::vector<std::uint32_t> parent(vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : triangles)
    for (int k = 0; k < 2; ++k) {
      const std::uint32_t a = root(t[k]), b = root(t[k + 1]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  struct Component {
    int chi = 0;
    double volume = 0;
    std::size_t triangles = 0;
  };
  std::vector<Component> all(vertices.size());
  for (const Triangle& t : triangles) {
    Component& c = all[root(t[0])];
    ++c.triangles;
    c.volume += vertices[t[0]].dot(vertices[t[1]].cross(vertices[t[2]])) / 6;
  }
  for (std::uint32_t v = 0; v < vertices.size(); ++v) ++all[root(v)].chi;
  std::vector<Component> components;
  for (const Component& c : all)
    if (c.triangles > 0) components.push_back(c);
  // A closed mesh has three half-edges a triangle: F - E = -F / 2.
  for (Component& c : components) c.chi -= static_cast<int>(c.triangles / 2);
  std::stable_sort(components.begin(), components.end(),
                   [](const Component& a, const Component& b) { return std::abs(a.volume) > std::abs(b.volume); });
  certificate.components = static_cast<int>(components.size());
  certificate.genus.clear();
  certificate.euler_characteristic = 0;
  for (const Component& c : components) {
    certificate.genus.push_back((2 - c.chi) / 2);
    certificate.euler_characteristic += c.chi;
  }
}

}  // namespace starcell
