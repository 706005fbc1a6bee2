// Points, vectors and boxes of the model's space, in model units.
#pragma once

#include <Eigen/Geometry>

namespace starcell {

using Vec3 = Eigen::Vector3d;
using Box3 = Eigen::AlignedBox3d;

/// Longest side of a box; 0 for an empty one.
inline double longest_side(const Box3& box) { return box.isEmpty() ? 0.0 : box.sizes().maxCoeff(); }

}  // namespace starcell
