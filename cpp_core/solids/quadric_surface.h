// Quadrics: (x - o) . A (x - o) + 2 b . (x - o) + c = 0. Spheres, ellipsoids, cylinders and whatever a 4x4 matrix describes.
//
// Guarantees: the second-order enclosure is the function itself, up to rounding.
#pragma once

#include "solids/smooth_surface.h"

namespace starcell {

class QuadricSurface final : public SmoothSurface {
 public:
  QuadricSurface(const Vec3& origin, const IntervalSymmetric& a, const Interval3& b, const Interval& c, double least_slope,
                 std::optional<RoundShape> shape = std::nullopt)
      : origin_(origin), a_(a), b_(b), c_(c), least_slope_(least_slope), shape_(shape) {}

  Expansion expand(const Vec3& center, const Vec3& reach) const override;
  SmoothSurfacePtr translated(const Vec3& by) const override;
  std::optional<RoundShape> round_shape() const override { return shape_; }
  double least_slope() const override { return least_slope_; }

 private:
  Vec3 origin_;
  IntervalSymmetric a_;
  Interval3 b_;
  Interval c_;
  double least_slope_;
  std::optional<RoundShape> shape_;
};

}  // namespace starcell
