// Distances of a point by school geometry, for tests that need an oracle.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "numerics/vector.h"

namespace starcell::sample {

inline double to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - a - t * (b - a)).norm();
}

inline double to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const bool over = n.cross(b - a).dot(x - a) >= 0 && n.cross(c - b).dot(x - b) >= 0 && n.cross(a - c).dot(x - c) >= 0;
  if (over) return std::abs(n.dot(x - a)) / n.norm();
  return std::min({to_segment(x, a, b), to_segment(x, b, c), to_segment(x, c, a)});
}

}  // namespace starcell::sample
