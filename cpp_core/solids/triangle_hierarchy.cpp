// Built top-down by the median of the centres along the longest side; the pairs come from walking the tree against
// itself, both halves at the same level, so that no pair is seen twice.
#include "solids/triangle_hierarchy.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace starcell {
namespace {

constexpr std::size_t kTrianglesPerLeaf = 4;
constexpr int kParallelLevels = 10;  // below this level a task is a few hundred triangles at least for big meshes

constexpr float kLargest = std::numeric_limits<float>::max();

float nearest(double x) { return static_cast<float>(std::clamp<double>(x, -kLargest, kLargest)); }
// One float further than the nearest, always: whether the nearest is already on the right side would have to be asked
// with a round trip from double to float to double, and g++ 12's vectoriser (-O2) takes such a round trip for nothing.
float rounded_down(double x) { return std::nextafterf(nearest(x), -INFINITY); }
float rounded_up(double x) { return std::nextafterf(nearest(x), INFINITY); }

}  // namespace

bool TriangleHierarchy::meet(const Bounds& a, const Bounds& b) {
  // & instead of &&: six cheap comparisons cost less than mispredicted branches
  return (a.lower[0] <= b.upper[0]) & (b.lower[0] <= a.upper[0]) & (a.lower[1] <= b.upper[1]) & (b.lower[1] <= a.upper[1]) &
         (a.lower[2] <= b.upper[2]) & (b.lower[2] <= a.upper[2]);
}

TriangleHierarchy::TriangleHierarchy(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double reach)
    : leaves_(triangles.size()) {
  tbb::parallel_for(std::size_t(0), triangles.size(), [&](std::size_t t) {
    const Vec3 &a = vertices[triangles[t][0]], &b = vertices[triangles[t][1]], &c = vertices[triangles[t][2]];
    leaves_[t].triangle = static_cast<std::uint32_t>(t);
    for (int axis = 0; axis < 3; ++axis) {
      leaves_[t].bounds.lower[axis] = rounded_down(std::min({a[axis], b[axis], c[axis]}) - reach);
      leaves_[t].bounds.upper[axis] = rounded_up(std::max({a[axis], b[axis], c[axis]}) + reach);
    }
  });
  while ((leaves_.size() >> depth_) > kTrianglesPerLeaf) ++depth_;
  nodes_.resize((std::size_t(2) << depth_) - 1);
  build(0, 0);
}

void TriangleHierarchy::build(int level, std::size_t j) {
  const std::size_t first = begin(level, j), last = begin(level, j + 1);
  const std::size_t node = (std::size_t(1) << level) - 1 + j;
  Bounds all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (std::size_t i = first; i < last; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      all.lower[axis] = std::min(all.lower[axis], leaves_[i].bounds.lower[axis]);
      all.upper[axis] = std::max(all.upper[axis], leaves_[i].bounds.upper[axis]);
    }
  nodes_[node] = all;
  if (level == depth_) return;
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (all.upper[axis] - all.lower[axis] > all.upper[longest] - all.lower[longest]) longest = axis;
  const auto centre = [longest](const Leaf& leaf) {
    // Never a NaN, which would break the sort: infinite bounds (of doubles beyond float32) are cut, and the sum is of halves.
    return 0.5f * std::max(leaf.bounds.lower[longest], -kLargest) + 0.5f * std::min(leaf.bounds.upper[longest], kLargest);
  };
  std::nth_element(leaves_.begin() + first, leaves_.begin() + begin(level + 1, 2 * j + 1), leaves_.begin() + last,
                   [&](const Leaf& a, const Leaf& b) {
                     const float x = centre(a), y = centre(b);
                     return x < y || (x == y && a.triangle < b.triangle);
                   });
  const auto lower_half = [&] { build(level + 1, 2 * j); };
  const auto upper_half = [&] { build(level + 1, 2 * j + 1); };
  if (level < kParallelLevels) {
    tbb::parallel_invoke(lower_half, upper_half);
  } else {
    lower_half();
    upper_half();
  }
}

class TriangleHierarchy::PairSearch {
 public:
  PairSearch(const TriangleHierarchy& tree, const std::function<bool(std::uint32_t, std::uint32_t)>& visit) : tree_(tree), visit_(visit) {}

  void within(int level, std::size_t j) {
    if (stop_.load(std::memory_order_relaxed)) return;
    if (level == tree_.depth_) {
      for (std::size_t i = tree_.begin(level, j); i < tree_.begin(level, j + 1); ++i)
        for (std::size_t k = i + 1; k < tree_.begin(level, j + 1); ++k) offer(i, k);
      return;
    }
    run(level, [=, this] { within(level + 1, 2 * j); }, [=, this] { within(level + 1, 2 * j + 1); },
        [=, this] { between(level + 1, 2 * j, 2 * j + 1); });
  }

 private:
  void between(int level, std::size_t i, std::size_t j) {
    const std::size_t level_begin = (std::size_t(1) << level) - 1;
    if (!meet(tree_.nodes_[level_begin + i], tree_.nodes_[level_begin + j]) || stop_.load(std::memory_order_relaxed)) return;
    if (level == tree_.depth_) {
      for (std::size_t a = tree_.begin(level, i); a < tree_.begin(level, i + 1); ++a)
        for (std::size_t b = tree_.begin(level, j); b < tree_.begin(level, j + 1); ++b) offer(a, b);
      return;
    }
    const auto down = [=, this](std::size_t a, std::size_t b) { return [=, this] { between(level + 1, 2 * i + a, 2 * j + b); }; };
    run(level, down(0, 0), down(0, 1), down(1, 0), down(1, 1));
  }

  template <class... Tasks>
  void run(int level, const Tasks&... tasks) {
    if (level < kParallelLevels) tbb::parallel_invoke(tasks...);
    else (tasks(), ...);
  }

  void offer(std::size_t a, std::size_t b) {
    const Leaf &x = tree_.leaves_[a], &y = tree_.leaves_[b];
    if (!meet(x.bounds, y.bounds)) return;
    if (!visit_(std::min(x.triangle, y.triangle), std::max(x.triangle, y.triangle))) stop_ = true;
  }

  const TriangleHierarchy& tree_;
  const std::function<bool(std::uint32_t, std::uint32_t)>& visit_;
  std::atomic<bool> stop_ = false;
};

void TriangleHierarchy::overlapping_pairs(const std::function<bool(std::uint32_t, std::uint32_t)>& visit) const {
  PairSearch(*this, visit).within(0, 0);
}

void TriangleHierarchy::above(const Vec3& p, const std::function<void(std::uint32_t)>& visit) const {
  const auto may_be_above = [&](const Bounds& b) {
    return b.lower[0] <= p[0] && p[0] <= b.upper[0] && b.lower[1] <= p[1] && p[1] <= b.upper[1] && p[2] <= b.upper[2];
  };
  struct Step {
    int level;
    std::size_t j;
  };
  std::vector<Step> stack = {{0, 0}};
  while (!stack.empty()) {
    const auto [level, j] = stack.back();
    stack.pop_back();
    if (!may_be_above(nodes_[(std::size_t(1) << level) - 1 + j])) continue;
    if (level < depth_) {
      stack.push_back({level + 1, 2 * j});
      stack.push_back({level + 1, 2 * j + 1});
      continue;
    }
    for (std::size_t i = begin(level, j); i < begin(level, j + 1); ++i)
      if (may_be_above(leaves_[i].bounds)) visit(leaves_[i].triangle);
  }
}

}  // namespace starcell
