// An open half of space: everything on the inner side of a plane. Unbounded, so only usable inside a bounded expression.
#pragma once

#include "numerics/vector.h"

namespace starcell {

struct HalfSpace {
  Vec3 point;   ///< on the plane
  Vec3 normal;  ///< outward, of any positive length

  /// Throws std::invalid_argument for values that are not finite or a zero normal.
  static HalfSpace make(const Vec3& point, const Vec3& normal);
  HalfSpace transformed(const Eigen::Matrix4d& map) const;
};

}  // namespace starcell
