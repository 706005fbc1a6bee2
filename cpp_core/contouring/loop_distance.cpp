#include "contouring/loop_distance.h"

#include <algorithm>
#include <limits>

namespace starcell {
namespace {

// A part of a closed polyline: points first to first + steps.
struct Run {
  const std::vector<Vec3>& points;
  std::size_t first, steps;

  const Vec3& at(std::size_t k) const { return points[(first + k) % points.size()]; }
  std::vector<double> shares() const {
    std::vector<double> shares{0};
    for (std::size_t k = 0; k < steps; ++k) shares.push_back(shares.back() + (at(k + 1) - at(k)).norm());
    const double length = shares.back();
    for (double& share : shares) share = length > 0 ? share / length : 1;
    shares.front() = 0;
    return shares;
  }
};

double run_distance(const Run& p, const Run& q) {
  const std::vector<double> s = p.shares(), t = q.shares();
  double farthest = std::max((p.at(0) - q.at(0)).norm(), (p.at(p.steps) - q.at(q.steps)).norm());
  // The point of `on` when `share` of it is done.
  const auto place = [](const Run& on, const std::vector<double>& shares, double share) {
    const auto next = static_cast<std::size_t>(std::upper_bound(shares.begin() + 1, shares.end() - 1, share) - shares.begin());
    const double part = shares[next] - shares[next - 1];
    return Vec3(on.at(next - 1) + (on.at(next) - on.at(next - 1)) * (part > 0 ? std::clamp((share - shares[next - 1]) / part, 0.0, 1.0) : 1.0));
  };
  for (std::size_t k = 1; k < p.steps; ++k) farthest = std::max(farthest, (p.at(k) - place(q, t, s[k])).norm());
  for (std::size_t k = 1; k < q.steps; ++k) farthest = std::max(farthest, (q.at(k) - place(p, s, t[k])).norm());
  return farthest;
}

}  // namespace

double loop_distance(const std::vector<Vec3>& p, const std::vector<Vec3>& q, double same) {
  const auto close = [&](std::size_t i, std::size_t j) { return (p[i % p.size()] - q[j % q.size()]).squaredNorm() <= same * same; };
  for (std::size_t start = 0; start < p.size(); ++start)
    for (std::size_t turn = 0; turn < q.size(); ++turn) {
      if (!close(start, turn)) continue;
      double farthest = 0;
      std::size_t i = 0, j = 0;   // where they were together last
      for (std::size_t next = 1; next <= q.size(); ++next) {
        std::size_t reached = i + 1;
        if (next == q.size()) reached = p.size();
        else
          while (reached < p.size() && !close(start + reached, turn + next)) ++reached;
        if (next < q.size() && reached == p.size()) continue;
        farthest = std::max(farthest, run_distance({p, start + i, reached - i}, {q, turn + j, next - j}));
        i = reached;
        j = next;
      }
      return farthest;
    }
  return std::numeric_limits<double>::infinity();
}

}  // namespace starcell
