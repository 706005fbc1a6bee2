// Cones and tori: surfaces of revolution about the third axis of a frame of their own, that an affine map carries into place.
//
// In that frame, with rho the distance from the axis and z the height:
//   cone   F = (rho - a - m z) / sqrt(1 + m^2), one nappe only: the tip is where it ends;
//   torus  F = ((rho - R)^2 + z^2 - r^2) / (2 r).
// Guarantees: enclosures. On the axis of a cone F has no second derivatives; an expansion there is of first order.
#pragma once

#include "solids/smooth_surface.h"

namespace starcell {

/// From the model into a solid's own frame: y = inverse (x - origin) + rest, with a scale to keep gradients near 1.
struct BodyFrame {
  Vec3 origin;
  IntervalMatrix inverse;
  Interval3 rest;
  double scale = 1;
};

class RevolvedSurface : public SmoothSurface {
 public:
  RevolvedSurface(const BodyFrame& frame, double least_slope, std::optional<RoundShape> shape)
      : frame_(frame), least_slope_(least_slope), shape_(shape) {}

  Expansion expand(const Vec3& center, const Vec3& reach) const final;
  std::optional<RoundShape> round_shape() const final { return shape_; }
  double least_slope() const final { return least_slope_; }

 protected:
  /// Value, gradient and second derivatives of the profile by (rho, z).
  struct Profile {
    Interval f, f_rho, f_z, f_rho_rho, f_rho_z, f_z_z;
  };
  virtual Profile profile(const Interval& rho, const Interval& z) const = 0;

  BodyFrame moved(const Vec3& by) const {
    BodyFrame frame = frame_;
    frame.origin += by;
    return frame;
  }
  std::optional<RoundShape> moved_shape(const Vec3& by) const {
    auto shape = shape_;
    if (shape) shape->point += by;
    return shape;
  }

  BodyFrame frame_;
  double least_slope_;
  std::optional<RoundShape> shape_;
};

class ConeSurface final : public RevolvedSurface {
 public:
  /// Radius `radius` at height 0, growing by `slope` a unit of height.
  ConeSurface(const BodyFrame& frame, const Interval& radius, const Interval& slope, double least_slope, std::optional<RoundShape> shape);
  SmoothSurfacePtr translated(const Vec3& by) const override;

 private:
  Profile profile(const Interval& rho, const Interval& z) const override;
  Interval radius_, slope_, steepness_;
};

class TorusSurface final : public RevolvedSurface {
 public:
  TorusSurface(const BodyFrame& frame, double major, double minor, double least_slope, std::optional<RoundShape> shape)
      : RevolvedSurface(frame, least_slope, shape), major_(major), minor_(minor) {}
  SmoothSurfacePtr translated(const Vec3& by) const override;

 private:
  Profile profile(const Interval& rho, const Interval& z) const override;
  double major_, minor_;
};

}  // namespace starcell
