#include "solids/quadric_surface.h"

namespace starcell {

Expansion QuadricSurface::expand(const Vec3& center, const Vec3& reach) const {
  const Interval3 d = enclose(center) - enclose(origin_);
  const Interval3 ad = a_ * d;
  Expansion e;
  e.reach = reach;
  e.value = dot(d, ad) + 2.0 * dot(d, b_) + c_;
  e.gradient = Interval(2.0) * (ad + b_);
  e.hessian = Interval(2.0) * a_;
  const Interval3 box{Interval(-reach.x(), reach.x()), Interval(-reach.y(), reach.y()), Interval(-reach.z(), reach.z())};
  e.slope = e.gradient + e.hessian * box;
  return e;
}

SmoothSurfacePtr QuadricSurface::translated(const Vec3& by) const {
  auto shape = shape_;
  if (shape) shape->point += by;
  return std::make_shared<QuadricSurface>(origin_ + by, a_, b_, c_, least_slope_, shape);
}

}  // namespace starcell
