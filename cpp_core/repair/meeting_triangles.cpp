#include "repair/meeting_triangles.h"

#include <algorithm>
#include <mutex>

#include "solids/triangle_hierarchy.h"
#include "solids/triangle_pair.h"

namespace starcell {

std::vector<std::pair<std::uint32_t, std::uint32_t>> meeting_triangles(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, std::size_t most) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::mutex guard;
  TriangleHierarchy(vertices, triangles).overlapping_pairs([&](std::uint32_t s, std::uint32_t t) {
    Triangle a = triangles[s], b = triangles[t];
    bool meet = meet_outside_shared(vertices, a, b);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    meet = meet || a == b;
    const std::lock_guard<std::mutex> lock(guard);
    if (meet) pairs.emplace_back(s, t);
    return pairs.size() < most;
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace starcell
