// The sum of squared distances from planes, weighted by area (Garland & Heckbert 1997): where a collapsed edge's vertex goes.
#pragma once

#include "numerics/vector.h"

namespace starcell {

class QuadricError {
 public:
  QuadricError() = default;
  /// Of a triangle's plane. Coordinates far from the origin lose digits: the caller moves it near.
  QuadricError(const Vec3& a, const Vec3& b, const Vec3& c);

  QuadricError& operator+=(const QuadricError& other);
  double at(const Vec3& x) const;
  /// The sum of all weights.
  double weight() const { return a_.trace(); }
  /// The point of least error; `start` decides where the planes leave it open, and ties weakly to it elsewhere.
  Vec3 least(const Vec3& start) const;

 private:
  Eigen::Matrix3d a_ = Eigen::Matrix3d::Zero();
  Vec3 b_ = Vec3::Zero();
  double c_ = 0;
};

}  // namespace starcell
