// Candidates from the hierarchy, decided one by one by triangle_pair. The search runs in parallel but its answer does
// not depend on it: either all pairs were found, and the first is the smallest; or there are too many to count, and
// no first place is named.
#include "solids/self_intersection.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "solids/triangle_pair.h"

namespace starcell {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// A point in both triangles' boxes: near where they meet.
Vec3 between(const std::vector<Vec3>& vertices, const Triangle& s, const Triangle& t) {
  const auto box = [&](const Triangle& x) { return Box3(vertices[x[0]]).extend(vertices[x[1]]).extend(vertices[x[2]]); };
  const Box3 common = box(s).intersection(box(t));
  return 0.5 * common.min() + 0.5 * common.max();
}

}  // namespace

SelfIntersections find_self_intersections(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                          const TriangleHierarchy& hierarchy) {
  SelfIntersections result;
  std::vector<char> flat(triangles.size());
  tbb::parallel_for(std::size_t(0), triangles.size(), [&](std::size_t t) {
    flat[t] = has_no_area(vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]);
  });
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (flat[t] && result.zero_area.count++ == 0) result.zero_area.first = place(vertices[triangles[t][0]]);

  tbb::enumerable_thread_specific<std::vector<Pair>> found;
  std::atomic<std::size_t> total = 0;
  hierarchy.overlapping_pairs([&](std::uint32_t s, std::uint32_t t) {
    if (flat[s] || flat[t] || !meet_outside_shared(vertices, triangles[s], triangles[t])) return true;
    found.local().emplace_back(s, t);
    return ++total <= SelfIntersections::kMostPairs;
  });
  std::vector<Pair> pairs;
  for (const std::vector<Pair>& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  if (pairs.empty()) return result;
  std::sort(pairs.begin(), pairs.end());
  result.pairs.count = std::min(pairs.size(), SelfIntersections::kMostPairs);
  result.all_found = pairs.size() <= SelfIntersections::kMostPairs;
  const auto [s, t] = pairs.front();
  // Which pairs were found before the search stopped depends on the threads: name a place only if it does not.
  if (result.all_found) result.pairs.first = place(between(vertices, triangles[s], triangles[t]));
  return result;
}

}  // namespace starcell
