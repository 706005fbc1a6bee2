#include "solids/smooth_surface.h"

#include <algorithm>
#include <cmath>

namespace starcell {
namespace {

Interval around_zero(double reach) { return {-reach, reach}; }

double magnitude(const Interval& x) { return std::max(-x.lower(), x.upper()); }

// Directions that differ by no more than this are worth measuring; others are not one surface.
constexpr double nearly_parallel = 1e-3;

// The angle between two axes, and the sense in which they agree.
double angle(const Vec3& a, const Vec3& b) { return a.cross(b).norm(); }

std::optional<double> round_distance(const RoundShape& f, const RoundShape& g, const Box3& box) {
  if (f.kind != g.kind) return std::nullopt;
  const double scale = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  const double rounding = 1e-13 * (scale + f.point.cwiseAbs().maxCoeff() + std::abs(f.a));
  const double apart = (f.point - g.point).norm();
  if (f.kind == RoundShape::Kind::sphere) return apart + std::abs(f.a - g.a) + rounding;
  const double turn = angle(f.axis, g.axis);
  if (turn > nearly_parallel) return std::nullopt;
  // How far the box reaches from the point that both surfaces turn about.
  double reach = 0;
  for (int k = 0; k < 8; ++k) reach = std::max(reach, (box.corner(static_cast<Box3::CornerType>(k)) - f.point).norm());
  switch (f.kind) {
    case RoundShape::Kind::cylinder:
      return (g.point - f.point).cross(f.axis).norm() + 2 * turn * (reach + apart) + std::abs(f.a - g.a) + rounding;
    case RoundShape::Kind::cone:
      if (f.axis.dot(g.axis) < 0) return std::nullopt;
      return apart + 2 * turn * reach + std::abs(f.a - g.a) * reach + rounding;
    case RoundShape::Kind::torus:
      return apart + 2 * turn * (f.a + f.b) + std::abs(f.a - g.a) + std::abs(f.b - g.b) + rounding;
    case RoundShape::Kind::sphere: break;
  }
  return std::nullopt;
}

// The least that g d + h d^2 / 2 can be for |d| <= r: at the parabola's bottom if that is nearer than r.
double least(double g, double h, double r) {
  const Interval steep(g), bent(h), far(r);
  if (h > 0 && (far * bent).lower() > g) return -((squared(steep) / (2.0 * bent)).upper());
  return (0.5 * bent * squared(far) - steep * far).lower();
}

Interval parabola(const Interval& g, const Interval& h, double r) {
  const double steepest = magnitude(g);
  return {least(steepest, h.lower(), r), -least(steepest, -h.upper(), r)};
}

// The middle of a matrix, and in `wide` how far its entries reach from there.
IntervalSymmetric middled(const IntervalSymmetric& h, double& wide) {
  const auto middle_of = [&](const Interval& x) {
    const double m = middle(x);
    wide = std::max({wide, (Interval(x.upper()) - m).upper(), (Interval(m) - x.lower()).upper()});
    return Interval(m);
  };
  return {middle_of(h.xx), middle_of(h.yy), middle_of(h.zz), middle_of(h.xy), middle_of(h.xz), middle_of(h.yz)};
}

}  // namespace

Interval Expansion::range() const {
  const Interval dx = around_zero(reach.x()), dy = around_zero(reach.y()), dz = around_zero(reach.z());
  Interval first = value + slope.x * dx + slope.y * dy + slope.z * dz;
  if (std::isfinite(steepest)) {
    const double far = (norm(enclose(reach)) * steepest).upper();
    first = {std::max(first.lower(), (value - far).lower()), std::min(first.upper(), (value + far).upper())};
  }
  first = {std::max(first.lower(), bounds.lower()), std::min(first.upper(), bounds.upper())};
  if (!smooth) return first;
  const Interval products = hessian.xy * dx * dy + hessian.xz * dx * dz + hessian.yz * dy * dz;
  const Interval second = value + parabola(gradient.x, hessian.xx, reach.x()) + parabola(gradient.y, hessian.yy, reach.y()) +
                          parabola(gradient.z, hessian.zz, reach.z()) + products;
  return {std::max(first.lower(), second.lower()), std::min(first.upper(), second.upper())};
}

// With angle A of the cap and B between axis and u, v . u lies between |u| cos(A + B) and |u| cos(A - B), or is |u| if u is in the cap.
Interval SlopeCap::along(const Vec3& u) const {
  const Interval3 v = enclose(u), a = enclose(axis);
  const Interval length = norm(v);
  if (!(cosine.lower() > 0)) return {-length.upper(), length.upper()};
  const Interval straight = dot(a, v), aside = norm(cross(a, v));
  // The axis is a unit vector only to rounding.
  const Interval loss = length * Interval(-1e-14, 1e-14);
  const Interval low = straight * cosine - aside * sine + loss, high = straight * cosine + aside * sine + loss;
  const bool opposite = (straight * sine + aside * cosine).lower() < 0;       // -u may be in the cap: A + B > 180 degrees
  const bool within = (aside * cosine - straight * sine).lower() < 0;         // u may be: B < A
  return {opposite ? -length.upper() : std::max(-length.upper(), low.lower()), within ? length.upper() : std::min(length.upper(), high.upper())};
}

Interval Expansion::along(const Vec3& u) const {
  if (!slopes.empty()) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      Interval one = dot(slopes[i], u);
      if (!caps.empty()) {
        const Interval other = caps[i].along(u);
        const double l = std::max(one.lower(), other.lower()), h = std::min(one.upper(), other.upper());
        if (l <= h) one = Interval(l, h);
      }
      low = std::min(low, one.lower());
      high = std::max(high, one.upper());
    }
    return {low, high};
  }
  const Interval plain = dot(slope, u);
  if (!framed) return plain;
  const Interval other = dot(framed_slope, frame * enclose(u));
  return {std::max(plain.lower(), other.lower()), std::min(plain.upper(), other.upper())};
}

// With barycentric coordinates w and edges e, interpolation exceeds a quadratic function by the sum over edges of
// w_i w_j e . H e / 2 (Waldron 1998). The sum of all w_i w_j is at most `pairs` (1/3 on a triangle, 1/4 on a segment), each at
// most 1/4. Where H varies by D about its middle, |D| times the same sum over |e|^2 is added. (By Taylor's theorem at x the excess
// is the sum of w_i d_i . H_i d_i / 2, d_i from x to corner i, and the sum of w_i |d_i|^2 is that of w_i w_j |e|^2.)
Interval Expansion::excess(const std::array<Vec3, 3>& edges, double pairs) const {
  // To first order: with slopes g_i towards the corners, the excess is the sum over edges of w_i w_j e . (g_i - g_j).
  double widest = 0;
  for (const Vec3& e : edges) {
    const Interval rise = along(e);
    widest = std::max(widest, (Interval(rise.upper()) - rise.lower()).upper());
  }
  const double first = (Interval(widest) * pairs * (1 + 1e-9)).upper();
  double up = first, down = first, squares = 0;
  for (const Vec3& edge : edges) squares = std::max(squares, (dot(enclose(edge), enclose(edge)) * (1 + 1e-9)).upper());
  // A function that bends no more than m|x|^2 / 2 exceeds interpolation no more than that one does.
  if (std::isfinite(bend.upper())) up = std::min(up, std::max(0.0, (Interval(bend.upper()) * squares * pairs * 0.5).upper()));
  if (std::isfinite(bend.lower())) down = std::min(down, std::max(0.0, (Interval(-bend.lower()) * squares * pairs * 0.5).upper()));
  if (!smooth) return {-down, up};
  double wide = 0;
  const IntervalSymmetric h = middled(framed ? framed_hessian : hessian, wide);
  double most = 0, least = 0, sum_up = 0, sum_down = 0, framed_squares = squares;
  for (const Vec3& edge : edges) {
    const Interval3 along = framed ? frame * enclose(edge) : enclose(edge);
    const Interval e = dot(along, h * along);
    most = std::max(most, e.upper());
    least = std::min(least, e.lower());
    sum_up += std::max(0.0, e.upper());
    sum_down += std::max(0.0, -e.lower());
    if (framed) framed_squares = std::max(framed_squares, (dot(along, along) * (1 + 1e-9)).upper());
  }
  const double sum_wide = (Interval(3 * wide) * framed_squares).upper();
  // The edges are rounded differences: far less than the billionth part that is added.
  const double rest = (Interval(sum_wide) * pairs * 0.5 + 1e-9 * (Interval(most) - least)).upper();
  up = std::min({up, (Interval(most) * pairs * 0.5 + rest).upper(), (Interval(sum_up) * 0.125 + rest).upper()});
  down = std::min({down, (Interval(-least) * pairs * 0.5 + rest).upper(), (Interval(sum_down) * 0.125 + rest).upper()});
  if (framed) {
    // Whatever H is at each corner, its form lies between the extreme eigenvalues.
    up = std::min(up, std::max(0.0, (Interval(curvature.upper()) * framed_squares * pairs * 0.5).upper()));
    down = std::min(down, std::max(0.0, (Interval(-curvature.lower()) * framed_squares * pairs * 0.5).upper()));
  }
  return {-down, up};
}

// On the piece F is at least its least corner less the excess: so far off it bends by no more than the inverse, which bounds the
// excess again (it is below the corners for F < 0 the same way).
Interval Expansion::excess(const std::array<Vec3, 3>& edges, double pairs, const Interval& values) const {
  const Interval known = excess(edges, pairs);
  if (source == 0) return known;
  double squares = 0, most = source > 0 ? known.upper() : -known.lower();
  for (const Vec3& edge : edges) squares = std::max(squares, (dot(enclose(edge), enclose(edge)) * (1 + 1e-9)).upper());
  const Interval at_corners(source > 0 ? (Interval(values.lower()) + source).lower() : -(Interval(values.upper()) + source).upper());
  for (int turn = 0; turn < 4; ++turn) {
    const double far = (at_corners - most).lower();
    if (!(far > 0)) break;
    most = std::min(most, (Interval(squares) * pairs * 0.5 / far).upper());
  }
  return source > 0 ? Interval(known.lower(), most) : Interval(-most, known.upper());
}

Interval Expansion::excess(const Vec3& p, const Vec3& q, const Vec3& r, const Interval& values) const {
  return excess({q - p, r - q, p - r}, 0.33333333333333337, values);
}

Interval Expansion::excess(const Vec3& p, const Vec3& q, const Interval& values) const {
  return excess({q - p, Vec3::Zero(), Vec3::Zero()}, 0.25, values);
}

Interval Expansion::excess(const Vec3& p, const Vec3& q, const Vec3& r) const { return excess({q - p, r - q, p - r}, 0.33333333333333337); }

Interval Expansion::excess(const Vec3& p, const Vec3& q) const { return excess({q - p, Vec3::Zero(), Vec3::Zero()}, 0.25); }

Expansion combine(double a, const Expansion& f, double b, const Expansion& g) {
  const Interval s(a), t(b);
  Expansion sum;
  sum.reach = f.reach;
  sum.value = s * f.value + t * g.value;
  sum.gradient = s * f.gradient + t * g.gradient;
  sum.slope = s * f.slope + t * g.slope;
  sum.smooth = f.smooth && g.smooth;
  if (sum.smooth) sum.hessian = s * f.hessian + t * g.hessian;
  return sum;
}

int SmoothSurface::sign(const Vec3& x) const {
  const Rounding rounding;
  return certain_sign(expand(x, Vec3::Zero()).value);
}

double SmoothSurface::value(const Vec3& x, Vec3* gradient) const {
  const Rounding rounding;
  const Expansion e = expand(x, Vec3::Zero());
  if (gradient) *gradient = e.gradient.middle();
  return middle(e.value);
}

std::optional<double> surface_distance(const SmoothSurface& f, const SmoothSurface& g, const Box3& box) {
  if (f.same_as(g)) return 0;
  const auto a = f.round_shape(), b = g.round_shape();
  if (a && b) return round_distance(*a, *b, box);
  // Where |F - G| <= d and |grad F| >= s along the way to it, the zero of F is within d / s; half of the slope on the surface
  // is left for the curvature on such a short way.
  const double slope = 0.5 * std::min(f.least_slope(), g.least_slope());
  if (!(slope > 0)) return std::nullopt;
  const Rounding rounding;
  const Vec3 center = box.center(), reach = 0.5 * box.sizes() * (1 + 1e-12);
  const Interval difference = combine(1, f.expand(center, reach), -1, g.expand(center, reach)).range();
  return magnitude(difference) / slope;
}

}  // namespace starcell
