#include "decimation/quadric_error.h"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace starcell {

// How weakly the minimum is tied to where it starts, beside the planes.
constexpr double tie = 1e-3;

QuadricError::QuadricError(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double area = normal.norm();
  if (!(area > 0)) return;
  const Vec3 n = normal / area;
  const double d = -n.dot(a);
  a_ = area * n * n.transpose();
  b_ = area * d * n;
  c_ = area * d * d;
}

QuadricError& QuadricError::operator+=(const QuadricError& other) {
  a_ += other.a_;
  b_ += other.b_;
  c_ += other.c_;
  return *this;
}

double QuadricError::at(const Vec3& x) const { return std::max(0.0, x.dot(a_ * x) + 2 * b_.dot(x) + c_); }

Vec3 QuadricError::least(const Vec3& start) const {
  const double weight = tie * a_.trace();
  if (!(weight > 0)) return start;
  return (a_ + weight * Eigen::Matrix3d::Identity()).llt().solve(weight * start - b_);
}

}  // namespace starcell
