#include "configuration_space/angle_function.h"

#include <cmath>

#include "numerics/trigonometry.h"

namespace starcell {
namespace {

// The doubles on either side of pi.
Interval pi() { return {M_PI, std::nextafter(M_PI, 4)}; }

}  // namespace

Expansion AngleFunction::expand(const Vec3& center, const Vec3& reach) const {
  const Interval none(0.0), per_unit(1 / unit_);
  const Interval3 at = enclose(center) - enclose(shift_), slope = enclose(slope_);
  Expansion e;
  e.reach = reach;
  e.value = dot(slope, at) + Interval(half_turns_) * pi() * Interval(unit_) + Interval(offset_);
  e.gradient = e.slope = slope;
  e.hessian = {none, none, none, none, none, none};
  for (const AngleWave& wave : waves_) {
    const Interval3 m = enclose(wave.multiples);
    const Interval angle = dot(m, at) * per_unit, far = dot(enclose(wave.multiples.cwiseAbs()), enclose(reach)) * per_unit;
    const Turn here = turn_by(angle), over = turn_by(angle + Interval(-far.upper(), far.upper()));
    const Interval a(wave.amplitude), first = a * per_unit, second = -a * per_unit * per_unit * over.sine;
    e.value += a * here.sine;
    e.gradient = e.gradient + (first * here.cosine) * m;
    e.slope = e.slope + (first * over.cosine) * m;
    e.hessian = e.hessian + IntervalSymmetric{second * m.x * m.x, second * m.y * m.y, second * m.z * m.z, second * m.x * m.y, second * m.x * m.z, second * m.y * m.z};
  }
  e.steepest = norm(e.slope).upper();
  return e;
}

SmoothSurfacePtr AngleFunction::translated(const Vec3& by) const {
  auto moved = std::make_shared<AngleFunction>(*this);
  moved->shift_ += by;
  return moved;
}

// Of the same sign as the exact one: two doubles differ by 0 only if they are one.
std::optional<double> AngleFunction::constant_difference(const SmoothSurface& other) const {
  const auto* o = dynamic_cast<const AngleFunction*>(&other);
  if (!o || unit_ != o->unit_ || waves_ != o->waves_ || slope_ != o->slope_ || shift_ != o->shift_ || half_turns_ != o->half_turns_) return std::nullopt;
  return offset_ - o->offset_;
}

}  // namespace starcell
