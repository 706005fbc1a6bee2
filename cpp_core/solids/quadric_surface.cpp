#include "solids/quadric_surface.h"

#include <algorithm>

namespace starcell {
namespace {

// What a term may lose, relative to its size: no term below goes through more than twelve operations, each of which loses
// 2^-52 at most in any rounding mode.
constexpr double loss = 24 * 1.1102230246251565e-16;

double middled(const Interval& x, double& radius) {
  const double m = middle(x);
  radius = std::max({radius, (Interval(x.upper()) - m).upper(), (Interval(m) - x.lower()).upper()});
  return m;
}

Interval around(double x, double radius) { return {-(radius - x), x + radius}; }

}  // namespace

QuadricSurface::QuadricSurface(const Vec3& origin, const IntervalSymmetric& a, const Interval3& b, const Interval& c, double least_slope,
                               std::optional<RoundShape> shape)
    : origin_(origin), least_slope_(least_slope), shape_(shape) {
  a_(0, 0) = middled(a.xx, a_radius_), a_(1, 1) = middled(a.yy, a_radius_), a_(2, 2) = middled(a.zz, a_radius_);
  a_(0, 1) = a_(1, 0) = middled(a.xy, a_radius_);
  a_(0, 2) = a_(2, 0) = middled(a.xz, a_radius_);
  a_(1, 2) = a_(2, 1) = middled(a.yz, a_radius_);
  b_ = {middled(b.x, b_radius_), middled(b.y, b_radius_), middled(b.z, b_radius_)};
  c_ = middled(c, c_radius_);
}

Expansion QuadricSurface::expand(const Vec3& center, const Vec3& reach) const {
  // The magnitudes of all terms beside the terms themselves: their loss is a share of them. The difference from the origin
  // itself is rounded, which moves every term by another such share.
  const Vec3 d = center - origin_, ad = a_ * d, size = d.cwiseAbs(), a_size = a_.cwiseAbs() * size, b_size = b_.cwiseAbs();
  const double spread = a_radius_ * size.sum() + b_radius_;
  Expansion e;
  e.reach = reach;
  const double value = d.dot(ad + 2 * b_) + c_;
  e.value = around(value, loss * (size.dot(a_size + 2 * b_size) + std::abs(c_)) + (1 + loss) * (2 * size.sum() * spread + c_radius_));
  const Vec3 bend = 2 * (a_.cwiseAbs() * reach);
  const auto component = [&](int k, Interval& gradient, Interval& slope) {
    const double at = 2 * (ad[k] + b_[k]), lost = loss * 2 * (a_size[k] + b_size[k]) + (1 + loss) * 2 * spread;
    gradient = around(at, lost);
    slope = around(at, (1 + loss) * (lost + bend[k] + 2 * a_radius_ * reach.sum()));
  };
  component(0, e.gradient.x, e.slope.x);
  component(1, e.gradient.y, e.slope.y);
  component(2, e.gradient.z, e.slope.z);
  const double radius = 2 * a_radius_;
  e.hessian = {around(2 * a_(0, 0), radius), around(2 * a_(1, 1), radius), around(2 * a_(2, 2), radius),
               around(2 * a_(0, 1), radius), around(2 * a_(0, 2), radius), around(2 * a_(1, 2), radius)};
  return e;
}

// 2 (A d + b) . u at the centre, and as much as 2 A u changes it over the box.
Interval QuadricSurface::slope_along(const Vec3& center, const Vec3& reach, const Vec3& u) const {
  const Vec3 d = center - origin_, size = d.cwiseAbs(), u_size = u.cwiseAbs();
  const Vec3 a_u_size = a_.cwiseAbs() * u_size;   // A is symmetric: the terms' sizes on either side
  const double at = 2 * u.dot(a_ * d + b_);
  const double lost = loss * 2 * (size.dot(a_u_size) + b_.cwiseAbs().dot(u_size)) + (1 + loss) * 2 * u_size.sum() * (a_radius_ * size.sum() + b_radius_);
  const double bend = 2 * (reach.dot((a_ * u).cwiseAbs()) + loss * reach.dot(a_u_size) + (1 + loss) * a_radius_ * reach.sum() * u_size.sum());
  return around(at, (1 + loss) * (lost + bend));
}

double QuadricSurface::value(const Vec3& x, Vec3* gradient) const {
  const Vec3 d = x - origin_, half = a_ * d + b_;
  if (gradient) *gradient = 2 * half;
  return d.dot(half + b_) + c_;
}

SmoothSurfacePtr QuadricSurface::translated(const Vec3& by) const {
  auto moved = std::make_shared<QuadricSurface>(*this);
  moved->origin_ += by;
  if (moved->shape_) moved->shape_->point += by;
  return moved;
}

}  // namespace starcell
