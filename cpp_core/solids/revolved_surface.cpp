#include "solids/revolved_surface.h"

namespace starcell {
namespace {

Interval3 spread(const Vec3& reach) { return {Interval(-reach.x(), reach.x()), Interval(-reach.y(), reach.y()), Interval(-reach.z(), reach.z())}; }

// The unit vector from the axis to (x, y): inside [-1, 1] whatever rounding or a box across the axis makes of the quotient.
Interval cosine(const Interval& x, const Interval& rho) {
  if (!(rho.lower() > 0)) return {-1, 1};
  const Interval q = x / rho;
  return {std::max(-1.0, q.lower()), std::min(1.0, q.upper())};
}

}  // namespace

Expansion RevolvedSurface::expand(const Vec3& center, const Vec3& reach) const {
  const Interval3 at = frame_.inverse * (enclose(center) - enclose(frame_.origin)) + frame_.rest;
  const Interval3 box = at + frame_.inverse * spread(reach);
  const IntervalMatrix pull = frame_.inverse.transposed();
  const Interval scale(frame_.scale);

  const auto rho_of = [](const Interval3& y) { return square_root(squared(y.x) + squared(y.y)); };
  const auto gradient = [&](const Interval3& y, const Interval& rho, const Profile& p) {
    return scale * (pull * Interval3{p.f_rho * cosine(y.x, rho), p.f_rho * cosine(y.y, rho), p.f_z});
  };
  Expansion e;
  e.reach = reach;
  const Interval rho_at = rho_of(at), rho = rho_of(box);
  const Profile here = profile(rho_at, at.z), over = profile(rho, box.z);
  e.value = scale * here.f;
  e.gradient = gradient(at, rho_at, here);
  e.framed = true;
  e.frame = frame_.inverse;
  e.framed_slope = scale * Interval3{over.f_rho * cosine(box.x, rho), over.f_rho * cosine(box.y, rho), over.f_z};
  e.slope = pull * e.framed_slope;
  e.smooth = rho.lower() > 0;
  if (e.smooth) {
    // By (x, y, z): with n the unit vector from the axis, f_rho_rho n n + f_rho (1 - n n) / rho, and so on.
    const Interval nx = cosine(box.x, rho), ny = cosine(box.y, rho), round = over.f_rho / rho;
    const Interval rest = over.f_rho_rho - round;
    const IntervalSymmetric h{round + rest * squared(nx), round + rest * squared(ny), over.f_z_z,
                              rest * nx * ny,             over.f_rho_z * nx,          over.f_rho_z * ny};
    e.hessian = scale * frame_.inverse.pull_back(h);
    e.framed_hessian = scale * h;
    // Across the meridian the second derivative is f_rho / rho; in its plane that of the profile (f_rho_z is 0 for both kinds).
    const Interval across = scale * round, meridian = scale * over.f_rho_rho, height = scale * over.f_z_z;
    e.curvature = Interval(std::min({across.lower(), meridian.lower(), height.lower()}),
                           std::max({across.upper(), meridian.upper(), height.upper()}));
    // The mean value form is narrower in small boxes.
    const Interval3 away = frame_.inverse * spread(reach);
    const auto narrowed = [](const Interval& a, const Interval& b) { return Interval(std::max(a.lower(), b.lower()), std::min(a.upper(), b.upper())); };
    const Interval3 mean = scale * (Interval3{here.f_rho * cosine(at.x, rho_at), here.f_rho * cosine(at.y, rho_at), here.f_z} + h * away);
    for (const auto& [whole, part] : {std::pair(&e.framed_slope.x, mean.x), {&e.framed_slope.y, mean.y}, {&e.framed_slope.z, mean.z}})
      *whole = narrowed(*whole, part);
    const Interval3 plain = pull * e.framed_slope, straight = e.gradient + e.hessian * spread(reach);
    e.slope = {narrowed(plain.x, straight.x), narrowed(plain.y, straight.y), narrowed(plain.z, straight.z)};
  }
  return e;
}

ConeSurface::ConeSurface(const BodyFrame& frame, const Interval& radius, const Interval& slope, double least_slope,
                         std::optional<RoundShape> shape)
    : RevolvedSurface(frame, least_slope, shape), radius_(radius), slope_(slope) {
  const Rounding rounding;
  steepness_ = square_root(1.0 + squared(slope_));
}

RevolvedSurface::Profile ConeSurface::profile(const Interval& rho, const Interval& z) const {
  return {(rho - radius_ - slope_ * z) / steepness_, Interval(1.0) / steepness_, -slope_ / steepness_, 0.0, 0.0, 0.0};
}

SmoothSurfacePtr ConeSurface::translated(const Vec3& by) const {
  return std::make_shared<ConeSurface>(moved(by), radius_, slope_, least_slope_, moved_shape(by));
}

RevolvedSurface::Profile TorusSurface::profile(const Interval& rho, const Interval& z) const {
  const Interval r(minor_), from = rho - major_;
  return {(squared(from) + squared(z) - squared(r)) / (2.0 * r), from / r, z / r, Interval(1.0) / r, 0.0, Interval(1.0) / r};
}

SmoothSurfacePtr TorusSurface::translated(const Vec3& by) const {
  return std::make_shared<TorusSurface>(moved(by), major_, minor_, least_slope_, moved_shape(by));
}

}  // namespace starcell
