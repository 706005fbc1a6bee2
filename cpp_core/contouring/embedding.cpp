#include "contouring/embedding.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include <tbb/parallel_for.h>

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

// Two triangles as a mesh of their own, rounded along some axes, with shared vertices still shared.
struct RoundedPair {
  std::vector<Vec3> six;
  Triangle s, t;

  RoundedPair(const std::vector<Vec3>& v, const Triangle& first, const Triangle& second, RoundedAxes axes) {
    const auto add = [&](std::uint32_t vertex) {
      six.push_back(to_float(v[vertex]));
      for (int k = 0; k < 3; ++k)
        if (!(axes >> k & 1)) six.back()[k] = v[vertex][k];
      return static_cast<std::uint32_t>(six.size() - 1);
    };
    for (int k = 0; k < 3; ++k) s[k] = add(first[k]);
    for (int k = 0; k < 3; ++k) {
      const auto same = std::find(first.begin(), first.end(), second[k]);
      t[k] = same != first.end() ? static_cast<std::uint32_t>(same - first.begin()) : add(second[k]);
    }
  }
  bool is_empty(const Triangle& x) const { return has_no_area(six[x[0]], six[x[1]], six[x[2]]); }
};

// In double, or once rounded.
bool pair_meets(const std::vector<Vec3>& v, const Triangle& s, const Triangle& t, bool rounded_too) {
  if (!boxes_apart(v, s, t) && (has_no_area(v[s[0]], v[s[1]], v[s[2]]) || has_no_area(v[t[0]], v[t[1]], v[t[2]]) || meet_outside_shared(v, s, t)))
    return true;
  if (!rounded_too) return false;
  const RoundedPair pair(v, s, t, all_axes);
  return !boxes_apart(pair.six, pair.s, pair.t) && (pair.is_empty(pair.s) || pair.is_empty(pair.t) || meet_outside_shared(pair.six, pair.s, pair.t));
}

}  // namespace

bool meets_once_rounded(const std::vector<Vec3>& vertices, const Triangle& fresh, const Triangle& other) {
  return std::any_of(every_rounding.begin(), every_rounding.end(), [&](RoundedAxes axes) {
    const RoundedPair pair(vertices, fresh, other, axes);
    return pair.is_empty(pair.s) || (!boxes_apart(pair.six, pair.s, pair.t) && !pair.is_empty(pair.t) && meet_outside_shared(pair.six, pair.s, pair.t));
  });
}

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

std::vector<std::vector<MeetingPair>> meeting_pairs(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                                    const std::vector<RoundedAxes>& roundings, const GoOn& go_on) {
  struct Version {
    std::vector<Vec3> copy;
    const std::vector<Vec3>* vertices;
    std::vector<char> empty;   // per triangle: without area
    std::vector<MeetingPair> found;
  };
  std::vector<Version> versions(roundings.size());
  for (std::size_t k = 0; k < roundings.size(); ++k) {
    Version& v = versions[k];
    if (roundings[k] != no_axis) v.copy = rounded_copy(vertices, roundings[k]);
    v.vertices = roundings[k] == no_axis ? &vertices : &v.copy;
    v.empty.assign(triangles.size(), 0);
    tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t t) {
      const auto& p = *v.vertices;
      v.empty[t] = has_no_area(p[triangles[t][0]], p[triangles[t][1]], p[triangles[t][2]]);
    });
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      if (v.empty[t]) v.found.emplace_back(t, t);
  }
  std::mutex mutex;
  std::atomic<bool> stopped{false};
  // Its boxes reach one float32 step beyond the nearest float32 on every side: they hold for all roundings.
  const TriangleHierarchy hierarchy(vertices, triangles);
  hierarchy.overlapping_pairs([&](std::uint32_t s, std::uint32_t t) {
    if (go_on && t % 1024 == 0) {
      const std::unique_lock lock(mutex, std::try_to_lock);
      if (lock && !go_on()) stopped = true;
    }
    if (stopped.load(std::memory_order_relaxed)) return false;
    for (Version& v : versions) {
      if (v.empty[s] || v.empty[t] || !meet_outside_shared(*v.vertices, triangles[s], triangles[t])) continue;
      const std::lock_guard lock(mutex);
      v.found.emplace_back(s, t);
    }
    return true;
  });
  if (stopped) throw CancelledError("The run was cancelled.");
  std::vector<std::vector<MeetingPair>> found;
  for (Version& v : versions) {
    std::sort(v.found.begin(), v.found.end());
    found.push_back(std::move(v.found));
  }
  return found;
}

std::vector<std::uint32_t> triangles_of(const std::vector<MeetingPair>& pairs) {
  std::vector<std::uint32_t> found;
  for (const auto& [s, t] : pairs) found.push_back(s), found.push_back(t);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace starcell
