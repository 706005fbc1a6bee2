// Quadrics: (x - o) . A (x - o) + 2 b . (x - o) + c = 0. Spheres, ellipsoids, cylinders and whatever a 4x4 matrix describes.
//
// Coefficients are intervals, kept as middles and radii: an expansion is evaluated in doubles, with an a priori bound of what that
// loses. Guarantees: the second-order enclosure is the function itself, up to that loss and the coefficients' radii.
#pragma once

#include "solids/smooth_surface.h"

namespace starcell {

class QuadricSurface final : public SmoothSurface {
 public:
  /// Needs a Rounding object.
  QuadricSurface(const Vec3& origin, const IntervalSymmetric& a, const Interval3& b, const Interval& c, double least_slope,
                 std::optional<RoundShape> shape = std::nullopt);

  Expansion expand(const Vec3& center, const Vec3& reach) const override;
  Interval slope_along(const Vec3& center, const Vec3& reach, const Vec3& u) const override;
  double value(const Vec3& x, Vec3* gradient) const override;
  SmoothSurfacePtr translated(const Vec3& by) const override;
  std::optional<RoundShape> round_shape() const override { return shape_; }
  double least_slope() const override { return least_slope_; }

 private:
  Vec3 origin_;
  Eigen::Matrix3d a_;
  Vec3 b_;
  double c_ = 0;
  double a_radius_ = 0, b_radius_ = 0, c_radius_ = 0;   // of any entry
  double least_slope_;
  std::optional<RoundShape> shape_;
};

}  // namespace starcell
