#include "isotopy/star_map.h"

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
// How often a direction is turned towards what it faces least.
constexpr int turns = 8;

struct Seen {
  double x, y;
};

using SeenTriangle = std::array<Seen, 3>;

double cross(const Seen& o, const Seen& a, const Seen& b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

class View {
 public:
  View(const Vec3& along, const Vec3& origin) : origin_(origin) {
    across_ = along.unitOrthogonal();
    up_ = along.cross(across_);
  }
  SeenTriangle of(const Corners& corners) const {
    SeenTriangle seen;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 from = corners[k] - origin_;
      seen[k] = {from.dot(across_), from.dot(up_)};
    }
    return seen;
  }

 private:
  Vec3 origin_, across_, up_;
};

// Facing the direction, and not nearly on edge.
bool faces(const SeenTriangle& t, const Corners& corners) {
  const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
  return cross(t[0], t[1], t[2]) > least_shadow * area && area > 0;
}

// A shadow that is all but a line tells nothing.
bool well_shaped(const Corners& corners, double size) {
  const Vec3 a = corners[1] - corners[0], b = corners[2] - corners[1], c = corners[0] - corners[2];
  const double longest = std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}));
  return longest > least_length * size && a.cross(c).norm() > least_aspect * longest * longest;
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

// A direction that no triangle is turned away from, if there is one: large triangles have no more say in it than small ones.
Vec3 facing_all(const std::vector<Corners>& triangles) {
  std::vector<Vec3> normals;
  Vec3 sum = Vec3::Zero();
  for (const Corners& t : triangles) {
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    if (n.norm() > 0) normals.push_back(n.normalized()), sum += normals.back();
  }
  for (int step = 0; step < turns && !normals.empty(); ++step) {   // towards the one it faces least
    const auto least = std::min_element(normals.begin(), normals.end(), [&](const Vec3& m, const Vec3& n) { return m.dot(sum) < n.dot(sum); });
    sum = sum.normalized() + 0.25 * *least;
  }
  return sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(Vec3::UnitZ());
}

}  // namespace

// A fan whose triangles all face the direction and go once round has a star-shaped shadow with a simple rim. A disc with that rim
// covers it, as its shadow winds once about each of its points; if all its triangles face the direction, once and no more.
bool is_graph_over(const std::vector<Corners>& before, const std::vector<Corners>& fan, const Vec3& along) {
  const Vec3& origin = fan.front()[0];
  const View view(along, origin);
  double size = origin.cwiseAbs().maxCoeff(), turned = 0;
  std::vector<SeenTriangle> old_seen, new_seen;
  for (const Corners& corners : fan) {
    new_seen.push_back(view.of(corners));
    const SeenTriangle& t = new_seen.back();
    if (!faces(t, corners)) return false;
    turned += std::atan2(cross(t[0], t[1], t[2]), (t[1].x - t[0].x) * (t[2].x - t[0].x) + (t[1].y - t[0].y) * (t[2].y - t[0].y));
    for (const Vec3& p : corners) size = std::max(size, p.cwiseAbs().maxCoeff());
  }
  if (turned > 7) return false;   // twice round
  if (!std::all_of(fan.begin(), fan.end(), [&](const Corners& t) { return well_shaped(t, size); })) return false;
  bool folded = false;
  for (const Corners& t : before) {
    old_seen.push_back(view.of(t));
    folded = folded || !faces(old_seen.back(), t);
  }
  return !folded || std::all_of(old_seen.begin(), old_seen.end(), [&](const SeenTriangle& t) { return within(t, new_seen, rounding * size); });
}

bool is_graph_over(const std::vector<Corners>& before, const std::vector<Corners>& fan) {
  Vec3 along = Vec3::Zero();
  for (const Corners& t : before) along += (t[1] - t[0]).cross(t[2] - t[0]);
  return along.norm() > 0 && (is_graph_over(before, fan, along.normalized()) || is_graph_over(before, fan, facing_all(fan)));
}

}  // namespace starcell
