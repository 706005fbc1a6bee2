#include "contouring/embedding.h"

#include <algorithm>
#include <mutex>

#include "solids/triangle_hierarchy.h"
#include "solids/triangle_pair.h"

namespace starcell {
namespace {

bool boxes_apart(const std::vector<Vec3>& v, const Triangle& s, const Triangle& t) {
  for (int k = 0; k < 3; ++k) {
    const auto [slow, shigh] = std::minmax({v[s[0]][k], v[s[1]][k], v[s[2]][k]});
    const auto [tlow, thigh] = std::minmax({v[t[0]][k], v[t[1]][k], v[t[2]][k]});
    if (shigh < tlow || thigh < slow) return true;
  }
  return false;
}

std::vector<Vec3> rounded_copy(const std::vector<Vec3>& vertices) {
  std::vector<Vec3> result;
  result.reserve(vertices.size());
  for (const Vec3& p : vertices) result.push_back(to_float(p));
  return result;
}

}  // namespace

bool fans_meet(const std::vector<Vec3>& vertices, const Triangle* a, std::size_t count_a, const Triangle* b,
               std::size_t count_b, bool rounded_too) {
  for (const bool rounded : {false, true}) {
    if (rounded && !rounded_too) continue;
    for (std::size_t i = 0; i < count_a; ++i)
      for (std::size_t j = 0; j < count_b; ++j) {
        if (!rounded) {
          if (!boxes_apart(vertices, a[i], b[j]) && meet_outside_shared(vertices, a[i], b[j])) return true;
          continue;
        }
        std::vector<Vec3> six;
        for (int k = 0; k < 3; ++k) six.push_back(to_float(vertices[a[i][k]]));
        for (int k = 0; k < 3; ++k) six.push_back(to_float(vertices[b[j][k]]));
        const Triangle s{0, 1, 2}, t{3, 4, 5};
        if (boxes_apart(six, s, t)) continue;
        if (has_no_area(six[0], six[1], six[2]) || has_no_area(six[3], six[4], six[5]) || meet_outside_shared(six, s, t))
          return true;
      }
  }
  return false;
}

std::vector<std::uint32_t> meeting_triangles(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                             bool rounded) {
  const std::vector<Vec3> copy = rounded ? rounded_copy(vertices) : std::vector<Vec3>();
  const std::vector<Vec3>& v = rounded ? copy : vertices;
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (has_no_area(v[triangles[t][0]], v[triangles[t][1]], v[triangles[t][2]])) found.push_back(t);
  std::vector<char> flat(triangles.size(), 0);
  for (const std::uint32_t t : found) flat[t] = 1;
  std::mutex mutex;
  const TriangleHierarchy hierarchy(v, triangles);
  hierarchy.overlapping_pairs([&](std::uint32_t s, std::uint32_t t) {
    if (flat[s] || flat[t] || !meet_outside_shared(v, triangles[s], triangles[t])) return true;
    const std::lock_guard lock(mutex);
    found.push_back(s);
    found.push_back(t);
    return true;
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace starcell
