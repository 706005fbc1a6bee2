#include "isotopy/triangle_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace starcell {
namespace {

// A triangle's least height that is certainly no rounding, in slacks.
constexpr double least_height = 1000;

}  // namespace

// By the region of the plane that x is over (Ericson 2005, section 5.1.5).
Vec3 nearest_on_triangle(const Vec3& x, const Corners& t) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], w = x - t[0];
  const double d1 = u.dot(w), d2 = v.dot(w);
  if (d1 <= 0 && d2 <= 0) return t[0];
  const Vec3 w1 = x - t[1];
  const double d3 = u.dot(w1), d4 = v.dot(w1);
  if (d3 >= 0 && d4 <= d3) return t[1];
  const double c = d1 * d4 - d3 * d2;
  if (c <= 0 && d1 >= 0 && d3 <= 0) return t[0] + d1 / (d1 - d3) * u;
  const Vec3 w2 = x - t[2];
  const double d5 = u.dot(w2), d6 = v.dot(w2);
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double b = d5 * d2 - d1 * d6;
  if (b <= 0 && d2 >= 0 && d6 <= 0) return t[0] + d2 / (d2 - d6) * v;
  const double a = d3 * d6 - d5 * d4;
  if (a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
  const double whole = a + b + c;
  return t[0] + b / whole * u + c / whole * v;
}

double distance_to_triangle(const Vec3& x, const Corners& t) { return (x - nearest_on_triangle(x, t)).norm(); }

TriangleCover::TriangleCover(const Corners& t, double slack, double give) : origin_(t[0]), slack_(slack) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], normal = u.cross(v);
  const double longest = std::max({u.norm(), v.norm(), (t[2] - t[1]).norm()});
  whole_ = 0.5 * normal.norm();
  if (!(2 * whole_ > least_height * slack * longest)) return;
  const double perimeter = u.norm() + v.norm() + (t[2] - t[1]).norm();
  const double per_width = longest * perimeter / (2 * whole_);   // towards the middle of the circle in T, as far as its sides move in
  const double seam = std::max(slack, give / per_width);
  shrunk_ = seam * per_width;
  const double left = 1 - seam * perimeter / (2 * whole_);   // of the radius of that circle
  has_plane_ = left > 0.5;
  whole_ *= left * left;
  across_ = u.normalized();
  along_ = normal.normalized();
  up_ = along_.cross(across_);
  std::array<Flat, 3> corner{flat(t[0]), flat(t[1]), flat(t[2])};
  for (int k = 0; k < 3; ++k) {
    const Flat &p = corner[k], &q = corner[(k + 1) % 3];
    const double length = std::hypot(q.x - p.x, q.y - p.y);
    side_x_[k] = (p.y - q.y) / length;
    side_y_[k] = (q.x - p.x) / length;
    side_d_[k] = -seam - side_x_[k] * p.x - side_y_[k] * p.y;
  }
}

TriangleCover::Flat TriangleCover::flat(const Vec3& p) const {
  const Vec3 from = p - origin_;
  return {from.dot(across_), from.dot(up_)};
}

// The degree is a whole number: what is far from one has a boundary over T.
bool TriangleCover::is_whole() const {
  const double degree = area_ / whole_;
  return std::abs(degree) > 0.5 && std::abs(degree - std::round(degree)) < 0.01;
}

// Heights go along: a point of T is at most as far from s as from what of s is straight over it, and mostly that says enough.
TriangleCover::Look TriangleCover::add(const Corners& s) {
  struct Point {
    double x, y, height;
    std::array<double, 3> depth;   // inside each side
  };
  std::array<Point, 3> corner;
  for (int k = 0; k < 3; ++k) {
    const Flat p = flat(s[k]);
    corner[k] = {p.x, p.y, along_.dot(s[k] - origin_), {}};
    for (int side = 0; side < 3; ++side) corner[k].depth[side] = inside(side, p);
  }
  Look look;
  bool within = true;
  for (int side = 0; side < 3; ++side) {
    const int out = (corner[0].depth[side] < 0) + (corner[1].depth[side] < 0) + (corner[2].depth[side] < 0);
    if (out == 3) return look;
    within = within && out == 0;
  }
  for (int k = 0; k < 3; ++k) {
    double from = 0, to = 1;
    for (int side = 0; side < 3; ++side) {
      const double at_p = corner[k].depth[side], at_q = corner[(k + 1) % 3].depth[side];
      if (at_p < 0 && at_q < 0) to = -1;
      else if (at_p < 0) from = std::max(from, at_p / (at_p - at_q));
      else if (at_q < 0) to = std::min(to, at_p / (at_p - at_q));
    }
    if (from <= to) look.edges |= 1 << k;
  }
  std::array<Point, 10> one, two;
  std::array<Point, 10>*polygon = &one, *next = &two;
  std::copy(corner.begin(), corner.end(), polygon->begin());
  int n = 3;
  for (int side = 0; side < 3 && n > 0 && !within; ++side) {
    int m = 0;
    for (int i = 0; i < n; ++i) {
      const Point &p = (*polygon)[i], &q = (*polygon)[(i + 1) % n];
      if (p.depth[side] >= 0) (*next)[m++] = p;
      if ((p.depth[side] >= 0) == (q.depth[side] >= 0)) continue;
      const double w = p.depth[side] / (p.depth[side] - q.depth[side]);
      Point& cut = (*next)[m++];
      cut = {p.x + w * (q.x - p.x), p.y + w * (q.y - p.y), p.height + w * (q.height - p.height), {}};
      for (int other = side + 1; other < 3; ++other) cut.depth[other] = inside(other, {cut.x, cut.y});
    }
    std::swap(polygon, next);
    n = m;
  }
  if (n == 0) return look;
  look.over = true;
  double area = 0;
  for (int i = 0; i < n; ++i) {
    const Point &p = (*polygon)[i], &q = (*polygon)[(i + 1) % n];
    area += p.x * q.y - q.x * p.y;
    if (std::abs(p.height) > bound_) bound_ = std::max(bound_, distance_to_triangle(origin_ + p.x * across_ + p.y * up_, s));
  }
  area_ += 0.5 * area;
  return look;
}

Nearness nearness(const Corners& t, const std::vector<Corners>& others) {
  Vec3 nearest = Vec3::Constant(std::numeric_limits<double>::infinity());
  Nearness near{nearest[0], 0, 0};
  for (std::size_t k = 0; k < others.size(); ++k) {
    const Vec3 distances(distance_to_triangle(t[0], others[k]), distance_to_triangle(t[1], others[k]), distance_to_triangle(t[2], others[k]));
    nearest = nearest.cwiseMin(distances);
    if (distances.maxCoeff() < near.to_one) near.to_one = distances.maxCoeff(), near.one = k;
  }
  near.of_a_corner = nearest.maxCoeff();
  return near;
}

std::array<Corners, 2> halves(const Corners& t) {
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if ((t[(k + 1) % 3] - t[k]).squaredNorm() > (t[(longest + 1) % 3] - t[longest]).squaredNorm()) longest = k;
  std::array<Corners, 2> result{t, t};
  result[0][longest] = result[1][(longest + 1) % 3] = 0.5 * (t[longest] + t[(longest + 1) % 3]);
  return result;
}

}  // namespace starcell
