#include "contouring/embedding.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "solids/errors.h"
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

std::vector<Vec3> rounded_copy(const std::vector<Vec3>& vertices, int axes) {
  std::vector<Vec3> result;
  result.reserve(vertices.size());
  for (const Vec3& p : vertices) {
    result.push_back(to_float(p));
    for (int k = 0; k < 3; ++k)
      if (!(axes >> k & 1)) result.back()[k] = p[k];
  }
  return result;
}

// In double, or once rounded.
bool pair_meets(const std::vector<Vec3>& v, const Triangle& s, const Triangle& t, bool rounded_too) {
  if (!boxes_apart(v, s, t) && (has_no_area(v[s[0]], v[s[1]], v[s[2]]) || has_no_area(v[t[0]], v[t[1]], v[t[2]]) || meet_outside_shared(v, s, t)))
    return true;
  if (!rounded_too) return false;
  // A small mesh of their own, with shared vertices still shared.
  std::vector<Vec3> six;
  Triangle rs, rt;
  for (int k = 0; k < 3; ++k) rs[k] = static_cast<std::uint32_t>(k), six.push_back(to_float(v[s[k]]));
  for (int k = 0; k < 3; ++k) {
    const auto same = std::find(s.begin(), s.end(), t[k]);
    rt[k] = same != s.end() ? static_cast<std::uint32_t>(same - s.begin()) : static_cast<std::uint32_t>(six.size());
    if (same == s.end()) six.push_back(to_float(v[t[k]]));
  }
  const auto empty = [&](const Triangle& x) { return has_no_area(six[x[0]], six[x[1]], six[x[2]]); };
  return !boxes_apart(six, rs, rt) && (empty(rs) || empty(rt) || meet_outside_shared(six, rs, rt));
}

}  // namespace

bool fans_meet(const std::vector<Vec3>& vertices, const Triangle* a, std::size_t count_a, const Triangle* b,
               std::size_t count_b, bool rounded_too) {
  for (std::size_t i = 0; i < count_a; ++i)
    for (std::size_t j = 0; j < count_b; ++j)
      if (pair_meets(vertices, a[i], b[j], rounded_too)) return true;
  return false;
}

bool sheet_folds(const std::vector<Vec3>& vertices, const Triangle* triangles, std::size_t count, bool rounded_too) {
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      if (pair_meets(vertices, triangles[i], triangles[j], rounded_too)) return true;
  return false;
}

std::vector<MeetingPair> meeting_pairs(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, bool rounded,
                                       const GoOn& go_on) {
  return meeting_pairs_rounded(vertices, triangles, rounded ? 7 : 0, go_on);
}

std::vector<MeetingPair> meeting_pairs_rounded(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, int axes,
                                               const GoOn& go_on) {
  const std::vector<Vec3> copy = axes ? rounded_copy(vertices, axes) : std::vector<Vec3>();
  const std::vector<Vec3>& v = axes ? copy : vertices;
  std::vector<MeetingPair> found;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (has_no_area(v[triangles[t][0]], v[triangles[t][1]], v[triangles[t][2]])) found.emplace_back(t, t);
  std::vector<char> flat(triangles.size(), 0);
  for (const MeetingPair& pair : found) flat[pair.first] = 1;
  std::mutex mutex;
  std::atomic<bool> stopped{false};
  std::atomic<std::size_t> tested{0};
  const TriangleHierarchy hierarchy(v, triangles);
  hierarchy.overlapping_pairs([&](std::uint32_t s, std::uint32_t t) {
    if (go_on && tested.fetch_add(1, std::memory_order_relaxed) % 20000 == 0) {
      const std::unique_lock lock(mutex, std::try_to_lock);
      if (lock && !go_on()) stopped = true;
    }
    if (stopped) return false;
    if (flat[s] || flat[t] || !meet_outside_shared(v, triangles[s], triangles[t])) return true;
    const std::lock_guard lock(mutex);
    found.emplace_back(s, t);
    return true;
  });
  if (stopped) throw CancelledError("The run was cancelled.");
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint32_t> meeting_triangles(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                             bool rounded, const GoOn& go_on) {
  std::vector<std::uint32_t> found;
  for (const auto& [s, t] : meeting_pairs(vertices, triangles, rounded, go_on)) found.push_back(s), found.push_back(t);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace starcell
