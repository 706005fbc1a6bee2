#include "contouring/float_gaps.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "contouring/embedding.h"
#include "contouring/straight_motion.h"
#include "solids/disjoint_sets.h"
#include "solids/errors.h"
#include "solids/triangle_hierarchy.h"

namespace starcell {
namespace {

constexpr int most_rounds = 60;
constexpr int most_repairs = 4;
// More than this is no sliver here and there: there is not the room for so many sheets, and trying it takes long.
constexpr std::size_t most_pairs = 20000;
constexpr std::size_t most_pairs_in_reach = 100;   // to the triangle
constexpr double wanted_steps = 2.5;   // between triangles; rounding moves each by less than one

std::vector<MeetingPair> merged(const std::vector<std::vector<MeetingPair>>& lists) {
  std::vector<MeetingPair> all;
  for (const auto& some : lists) all.insert(all.end(), some.begin(), some.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

class Opener {
 public:
  Opener(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double most, double share,
         const GoOn& go_on)
      : start_(vertices), now_(vertices), triangles_(triangles), go_on_(go_on), most_(most), share_(share) {}

  bool open() {
    std::vector<MeetingPair> meeting = merged(meeting_pairs(now_, triangles_, every_rounding, go_on_));
    for (int repair = 0; repair <= most_repairs; ++repair) {
      if (meeting.size() > most_pairs || !take_near(meeting) || !push_apart()) return false;
      std::vector<RoundedAxes> all = every_rounding;
      all.push_back(no_axis);
      meeting = merged(meeting_pairs(now_, triangles_, all, go_on_));
      if (!meeting.empty()) continue;   // farther away: those come in too
      const std::vector<MeetingPair> unproved = without_isotopy();
      if (unproved.empty()) return true;
      move_as_one(unproved);
      meeting = unproved;
      share_ *= 0.5;
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
  // What is worked on: the triangles that meet, and all that come within reach of them. False if everything is near everything.
  bool take_near(const std::vector<MeetingPair>& meeting) {
    near_.resize(triangles_.size(), 0);
    std::vector<char> flagged(triangles_.size(), 0);
    for (const auto& [s, t] : meeting) flagged[s] = flagged[t] = 1;
    std::mutex mutex;
    std::atomic<std::size_t> pairs{0};
    const std::size_t most = most_pairs_in_reach * triangles_.size();
    TriangleHierarchy(now_, triangles_, most_).overlapping_pairs([&](std::uint32_t s, std::uint32_t t) {
      if (flagged[s] || flagged[t]) {
        const std::lock_guard lock(mutex);
        near_[s] = near_[t] = 1;
      }
      return ++pairs <= most;
    });
    if (pairs > most) return false;
    worked_.clear();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (near_[t] || flagged[t]) near_[t] = 1, worked_.push_back(t);
    return true;
  }

  // Those that meet among them once rounded.
  std::vector<MeetingPair> meeting_near() const {
    std::vector<std::uint32_t> ids;
    for (const std::uint32_t t : worked_) ids.insert(ids.end(), triangles_[t].begin(), triangles_[t].end());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    std::vector<Vec3> places;
    places.reserve(ids.size());
    for (const std::uint32_t v : ids) places.push_back(now_[v]);
    std::vector<Triangle> local;
    for (const std::uint32_t t : worked_) {
      Triangle& made = local.emplace_back();
      for (int k = 0; k < 3; ++k)
        made[k] = static_cast<std::uint32_t>(std::lower_bound(ids.begin(), ids.end(), triangles_[t][k]) - ids.begin());
    }
    std::vector<MeetingPair> found = merged(meeting_pairs(places, local, every_rounding, go_on_));
    for (auto& [s, t] : found) s = worked_[s], t = worked_[t];
    return found;
  }

  bool push_apart() {
    for (int round = 0; round < most_rounds; ++round) {
      if (go_on_ && !go_on_()) throw CancelledError("The run was cancelled.");
      const std::vector<MeetingPair> pairs = meeting_near();
      if (pairs.empty()) return true;
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

  // Triangles whose motions have no proof get a common one: they keep their places relative to each other.
  void move_as_one(const std::vector<MeetingPair>& pairs) {
    DisjointSets sets(now_.size());
    std::vector<char> moves(now_.size(), 0);
    for (const auto& [s, t] : pairs)
      for (const Triangle& x : {triangles_[s], triangles_[t]})
        for (const std::uint32_t v : x) sets.join(triangles_[s][0], v), moves[v] = 1;
    std::vector<Vec3> sum(now_.size(), Vec3::Zero());
    std::vector<int> count(now_.size(), 0);
    for (std::uint32_t v = 0; v < now_.size(); ++v)
      if (moves[v]) sum[sets.root(v)] += now_[v] - start_[v], ++count[sets.root(v)];
    for (std::uint32_t v = 0; v < now_.size(); ++v)
      if (moves[v]) now_[v] = start_[v] + sum[sets.root(v)] / count[sets.root(v)];
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

  // Every two triangles that come near each other on the way and of which it is not proved that they keep apart.
  std::vector<MeetingPair> without_isotopy() const {
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
    std::vector<MeetingPair> unproved;
    std::atomic<bool> stopped{false};
    std::mutex mutex;
    TriangleHierarchy(corners, boxes).overlapping_pairs([&](std::uint32_t s, std::uint32_t t) {
      if (stopped) return false;
      if ((!moves[s] && !moves[t]) || stay_apart(start_, now_, triangles_[s], triangles_[t])) return true;
      const std::lock_guard lock(mutex);
      unproved.emplace_back(s, t);
      if (go_on_ && !go_on_()) stopped = true;   // a proof that fails is what takes long
      return true;
    });
    if (stopped) throw CancelledError("The run was cancelled.");
    std::sort(unproved.begin(), unproved.end());
    return unproved;
  }

  const std::vector<Vec3>& start_;
  std::vector<Vec3> now_;
  const std::vector<Triangle>& triangles_;
  const GoOn& go_on_;
  const double most_;
  double share_;
  std::vector<char> near_;
  std::vector<std::uint32_t> worked_;
  std::vector<Vec3> push_;
  std::vector<int> pushes_;
};

}  // namespace

FloatGaps open_float_gaps(std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double most, const GoOn& go_on) {
  // Whole pushes first; smaller ones where those overshoot a layer that is itself being pushed.
  for (const double share : {1.0, 0.3}) {
    Opener opener(vertices, triangles, most, share, go_on);
    if (!opener.open()) continue;
    const FloatGaps result{opener.moved(), true};
    vertices = opener.vertices();
    return result;
  }
  return {};
}

}  // namespace starcell
