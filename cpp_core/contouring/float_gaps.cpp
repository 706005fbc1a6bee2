#include "contouring/float_gaps.h"

#include <algorithm>
#include <cmath>
#include <atomic>

#include "contouring/embedding.h"
#include "contouring/straight_motion.h"
#include "solids/triangle_hierarchy.h"

namespace starcell {
namespace {

constexpr int most_rounds = 60;
constexpr double wanted_steps = 2.5;   // between triangles; rounding moves each by less than one

class Opener {
 public:
  Opener(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double most, double share)
      : start_(vertices), now_(vertices), triangles_(triangles), most_(most), share_(share) {}

  bool open() {
    for (int round = 0; round < most_rounds; ++round) {
      const std::vector<MeetingPair> pairs = meeting_if_rounded();
      if (pairs.empty()) return meeting_pairs(now_, triangles_, {no_axis}).front().empty() && is_isotopy();
      push_.assign(now_.size(), Vec3::Zero());
      pushes_.assign(now_.size(), 0);
      for (const auto& [s, t] : pairs) {
        if (s == t)
          widen(triangles_[s]);
        else
          part(triangles_[s], triangles_[t]);
      }
      bool any = false;
      for (std::size_t v = 0; v < now_.size(); ++v) {
        if (pushes_[v] == 0) continue;
        now_[v] += share_ * push_[v] / pushes_[v];
        any = any || push_[v].norm() > 0;
        if ((now_[v] - start_[v]).norm() > most_) return false;
      }
      if (!any) return false;
    }
    return false;
  }

  const std::vector<Vec3>& vertices() const { return now_; }

  double moved() const {
    double most = 0;
    for (std::size_t v = 0; v < now_.size(); ++v) most = std::max(most, (now_[v] - start_[v]).norm());
    return most;
  }

 private:
  // Also with single coordinates rounded: compilers drop roundings now and then (g++ 12 does), and a gap that depends on
  // all three being done is none.
  std::vector<MeetingPair> meeting_if_rounded() const {
    std::vector<MeetingPair> all;
    for (const auto& some : meeting_pairs(now_, triangles_, {all_axes, 1, 2, 4})) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  // The float32 step at a triangle's coordinates.
  double step(const Triangle& t) const {
    double reach = 0;
    for (const std::uint32_t v : t) reach = std::max(reach, now_[v].cwiseAbs().maxCoeff());
    return std::ldexp(1.0, std::ilogb(std::max(reach, 1e-300)) - 23);
  }

  void push(std::uint32_t v, const Vec3& move) {
    push_[v] += move;
    ++pushes_[v];
  }

  // Along the normal that separated them at the start, until they are far enough apart.
  void part(const Triangle& s, const Triangle& t) {
    const Vec3 n = separating_normal(start_, s, t);
    if (n.isZero()) return;
    const double want = wanted_steps * step(s);
    const auto is_in = [](const Triangle& x, std::uint32_t v) { return std::find(x.begin(), x.end(), v) != x.end(); };
    double low = std::numeric_limits<double>::infinity(), high = -low, level = 0;
    int shared = 0;
    for (const std::uint32_t v : t) {
      if (is_in(s, v)) level += n.dot(now_[v]), ++shared;
      low = std::min(low, n.dot(now_[v]));
    }
    for (const std::uint32_t v : s) high = std::max(high, n.dot(now_[v]));
    level = shared ? level / shared : 0.5 * (low + high);
    const double reach = shared ? want : 0.5 * want;
    // A little more each time: rounding acts in all three directions.
    for (const std::uint32_t v : t)
      if (!is_in(s, v)) push(v, (std::max(0.0, level + reach - n.dot(now_[v])) + 0.25 * want) * n);
    for (const std::uint32_t v : s)
      if (!is_in(t, v)) push(v, -(std::max(0.0, n.dot(now_[v]) - level + reach) + 0.25 * want) * n);
  }

  // Rounding left it without area: its shortest edge, or else its height over the longest, is stretched.
  void widen(const Triangle& t) {
    int longest = 0, shortest = 0;
    double length[3];
    for (int k = 0; k < 3; ++k) {
      length[k] = (now_[t[(k + 1) % 3]] - now_[t[k]]).norm();
      if (length[k] > length[longest]) longest = k;
      if (length[k] < length[shortest]) shortest = k;
    }
    const double want = wanted_steps * step(t);
    if (length[shortest] < want) {
      const std::uint32_t p = t[shortest], q = t[(shortest + 1) % 3];
      const Vec3 along = start_[q] - start_[p];
      if (along.norm() > 0) push(q, 0.5 * want * along.normalized()), push(p, -0.5 * want * along.normalized());
      return;
    }
    const std::uint32_t p = t[longest], q = t[(longest + 1) % 3], a = t[(longest + 2) % 3];
    const Vec3 e = (start_[q] - start_[p]).normalized(), x = start_[a] - start_[p];
    const Vec3 height = x - x.dot(e) * e;
    if (height.norm() > 0) push(a, 0.5 * want * height.normalized()), push(p, -0.25 * want * height.normalized()), push(q, -0.25 * want * height.normalized());
  }

  // Every two triangles that come near each other on the way.
  bool is_isotopy() const {
    std::vector<char> moves(triangles_.size(), 0);
    std::vector<Vec3> corners;
    std::vector<Triangle> boxes;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      Box3 box;
      for (const std::uint32_t v : triangles_[t]) {
        box.extend(start_[v]).extend(now_[v]);
        moves[t] |= start_[v] != now_[v];
      }
      corners.push_back(box.min());
      corners.push_back(box.max());
      boxes.push_back({2 * t, 2 * t + 1, 2 * t});
    }
    std::atomic<bool> proved{true};
    TriangleHierarchy(corners, boxes).overlapping_pairs([&](std::uint32_t s, std::uint32_t t) {
      if ((moves[s] || moves[t]) && !stay_apart(start_, now_, triangles_[s], triangles_[t])) proved = false;
      return proved.load();
    });
    return proved;
  }

  const std::vector<Vec3>& start_;
  std::vector<Vec3> now_;
  const std::vector<Triangle>& triangles_;
  const double most_, share_;
  std::vector<Vec3> push_;
  std::vector<int> pushes_;
};

}  // namespace

FloatGaps open_float_gaps(std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double most) {
  // Whole pushes first; smaller ones where those overshoot a layer that is itself being pushed.
  for (const double share : {1.0, 0.3, 0.1}) {
    Opener opener(vertices, triangles, most, share);
    if (!opener.open()) continue;
    const FloatGaps result{opener.moved(), true};
    vertices = opener.vertices();
    return result;
  }
  return {};
}

}  // namespace starcell
