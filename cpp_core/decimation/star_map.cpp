#include "decimation/star_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace starcell {
namespace {

// What is less than this part of the size is rounding.
constexpr double rounding = 1e-12;
// Shadows have at least this part of a triangle's own extent: heights over them are then well defined.
constexpr double least_shadow = 0.05;
constexpr double least_length = 1e-8;
constexpr double least_aspect = 1e-4;

// A corner in the plane, and its height over it.
struct Seen {
  double x, y, height;
};

using SeenTriangle = std::array<Seen, 3>;

double cross(const Seen& o, const Seen& a, const Seen& b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

class View {
 public:
  View(const Vec3& along, const Vec3& origin) : along_(along), origin_(origin) {
    across_ = along.unitOrthogonal();
    up_ = along.cross(across_);
  }
  SeenTriangle of(const std::array<Vec3, 3>& corners) const {
    SeenTriangle seen;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 from = corners[k] - origin_;
      seen[k] = {from.dot(across_), from.dot(up_), from.dot(along_)};
    }
    return seen;
  }

 private:
  Vec3 along_, origin_, across_, up_;
};

// Facing the direction, and not nearly on edge.
bool faces(const SeenTriangle& t, const std::array<Vec3, 3>& corners) {
  const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
  return cross(t[0], t[1], t[2]) > least_shadow * area && area > 0;
}

// Heights are continued over it, so it must not be all but a line.
bool well_shaped(const std::array<Vec3, 3>& corners, double size) {
  const Vec3 a = corners[1] - corners[0], b = corners[2] - corners[1], c = corners[0] - corners[2];
  const double longest = std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}));
  return longest > least_length * size && a.cross(c).norm() > least_aspect * longest * longest;
}

// The height over (x, y), continued linearly.
double height_at(const SeenTriangle& t, double x, double y) {
  const Seen p{x, y, 0};
  const double whole = cross(t[0], t[1], t[2]);
  const double b = cross(t[0], p, t[2]) / whole, c = cross(t[0], t[1], p) / whole;
  return t[0].height + b * (t[1].height - t[0].height) + c * (t[2].height - t[0].height);
}

// What rounding may do to a height over it: more, the thinner its shadow.
double loss_of(const SeenTriangle& t, double size) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, std::hypot(t[(k + 1) % 3].x - t[k].x, t[(k + 1) % 3].y - t[k].y));
  return rounding * size * (10 + 0.05 * longest * longest / cross(t[0], t[1], t[2]));
}

// Where the two shadows overlap, touch or nearly touch, the largest difference of heights: it is at a corner of the common polygon.
std::optional<double> apart(const SeenTriangle& s, const SeenTriangle& t, double slack) {
  std::array<Seen, 10> polygon, next;
  std::size_t n = 3;
  std::copy(s.begin(), s.end(), polygon.begin());
  for (std::size_t k = 0; k < 3 && n > 0; ++k) {
    const Seen &a = t[k], &b = t[(k + 1) % 3];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    std::array<double, 10> depth;
    for (std::size_t i = 0; i < n; ++i) depth[i] = cross(a, b, polygon[i]) / length + slack;
    std::size_t m = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      if (depth[i] >= 0) next[m++] = polygon[i];
      if ((depth[i] >= 0) == (depth[j] >= 0)) continue;
      const double w = depth[i] / (depth[i] - depth[j]);
      const auto between = [w](double from, double to) { return from + w * (to - from); };
      next[m++] = {between(polygon[i].x, polygon[j].x), between(polygon[i].y, polygon[j].y), between(polygon[i].height, polygon[j].height)};
    }
    polygon = next;
    n = m;
  }
  if (n == 0) return std::nullopt;
  double most = 0;
  for (std::size_t i = 0; i < n; ++i) most = std::max(most, std::abs(polygon[i].height - height_at(t, polygon[i].x, polygon[i].y)));
  return most;
}

// The part of the segment from p to q, as parameters, that is over the triangle.
std::pair<double, double> part_over(const Seen& p, const Seen& q, const SeenTriangle& t, double slack) {
  double from = 0, to = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Seen &a = t[k], &b = t[(k + 1) % 3];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double at_p = cross(a, b, p) / length + slack, at_q = cross(a, b, q) / length + slack;
    if (at_p < 0 && at_q < 0) return {1, 0};
    if (at_p < 0) from = std::max(from, at_p / (at_p - at_q));
    if (at_q < 0) to = std::min(to, at_p / (at_p - at_q));
  }
  return {from, to};
}

// Is the triangle's shadow within that of the fan? That has no holes, so it is if its sides are.
bool within(const SeenTriangle& t, const std::vector<SeenTriangle>& fan, double slack) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Seen &p = t[k], &q = t[(k + 1) % 3];
    std::vector<std::pair<double, double>> parts;
    for (const SeenTriangle& f : fan) parts.push_back(part_over(p, q, f, slack));
    std::sort(parts.begin(), parts.end());
    double reached = 0;
    const double gap = slack / std::max(slack, std::hypot(q.x - p.x, q.y - p.y));
    for (const auto& [from, to] : parts)
      if (from <= to && from <= reached + gap) reached = std::max(reached, to);
    if (reached < 1 - gap) return false;
  }
  return true;
}

}  // namespace

// A fan whose triangles all face the direction and go once round has a star-shaped shadow with a simple rim. A disc with that rim
// covers it, as its shadow winds once about each of its points; if all its triangles face the direction, once and no more. Points that
// are over each other are matched: every point of either disc with at least one of the other.
std::optional<std::vector<double>> match(const std::vector<MovedTriangle>& before, const std::vector<std::array<Vec3, 3>>& fan, const Vec3& along) {
  const Vec3& origin = fan.front()[0];
  const View view(along, origin);
  double size = origin.cwiseAbs().maxCoeff(), turned = 0;
  std::vector<SeenTriangle> old_seen, new_seen;
  for (const auto& corners : fan) {
    new_seen.push_back(view.of(corners));
    const SeenTriangle& t = new_seen.back();
    if (!faces(t, corners)) return std::nullopt;
    turned += std::atan2(cross(t[0], t[1], t[2]), (t[1].x - t[0].x) * (t[2].x - t[0].x) + (t[1].y - t[0].y) * (t[2].y - t[0].y));
    for (const Vec3& p : corners) size = std::max(size, p.cwiseAbs().maxCoeff());
  }
  if (turned > 7) return std::nullopt;   // twice round
  if (!std::all_of(fan.begin(), fan.end(), [&](const auto& t) { return well_shaped(t, size); })) return std::nullopt;
  bool folded = false;
  for (const MovedTriangle& t : before) {
    old_seen.push_back(view.of(t.corners));
    folded = folded || !faces(old_seen.back(), t.corners);
  }
  if (folded && !std::all_of(old_seen.begin(), old_seen.end(), [&](const SeenTriangle& t) { return within(t, new_seen, rounding * size); })) return std::nullopt;
  std::vector<double> moved(fan.size(), 0.0);
  for (std::size_t i = 0; i < fan.size(); ++i)
    for (std::size_t j = 0; j < before.size(); ++j)
      if (const auto by = apart(old_seen[j], new_seen[i], rounding * size))
        moved[i] = std::max(moved[i], before[j].moved + *by + loss_of(new_seen[i], size));
  return moved;
}

}  // namespace starcell
