// A half-space and its image under an affine map: the point moves with the map, the normal with its inverse transpose.
// Guarantees that what is made is finite and has a normal; the image is rounded like any other number.
#include "solids/half_space.h"

#include <cmath>
#include <stdexcept>

#include "solids/affine_map.h"

namespace starcell {

HalfSpace HalfSpace::make(const Vec3& point, const Vec3& normal) {
  if (!point.allFinite()) throw std::invalid_argument("point must be finite");
  if (!normal.allFinite()) throw std::invalid_argument("normal must be finite");
  if (normal.isZero(0.0)) throw std::invalid_argument("normal must not be zero");
  return {point, normal};
}

HalfSpace HalfSpace::transformed(const Eigen::Matrix4d& map) const {
  require_affine(map);
  const Eigen::Matrix3d linear = map.topLeftCorner<3, 3>();
  // The cofactor matrix is det times the inverse transpose. It needs no division; the sign of det keeps the normal outward.
  Eigen::Matrix3d cofactors;
  for (int i = 0; i < 3; ++i) cofactors.col(i) = linear.col((i + 1) % 3).cross(linear.col((i + 2) % 3));
  const Vec3 image = cofactors * normal * (reverses_orientation(map) ? -1.0 : 1.0);
  const double size = image.cwiseAbs().maxCoeff();
  const Vec3 moved = linear * point + map.topRightCorner<3, 1>();
  if (!moved.allFinite() || !std::isfinite(size) || size == 0.0)
    throw std::invalid_argument("matrix moves the half-space out of the range of floating-point numbers");
  return {moved, image / size};
}

}  // namespace starcell
