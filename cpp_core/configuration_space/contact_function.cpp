#include "configuration_space/contact_function.h"

#include <cmath>

namespace starcell {
namespace {

// Angles are told by the C library's atan2; what is this near to the end of a corner's angles belongs to both.
constexpr double angle_slack = 1e-9;

struct Normal {
  Interval x, y;
};

// Outward, of about unit length: to the right of the way its line runs, or to the left for the other sense.
Normal outward(const PieceTree& pieces, const ConvexPiece::Side& side) {
  const PlaneLine& l = pieces.lines[side.line];
  const Interval dx = l.to.x - l.from.x, dy = l.to.y - l.from.y;
  const Interval scale((side.along ? 1 : -1) / std::hypot(middle(dx), middle(dy)));
  return {scale * dy, -scale * dx};
}

double angle_of(const PieceTree& pieces, const ConvexPiece::Side& side) {
  const Normal n = outward(pieces, side);
  return std::atan2(middle(n.y), middle(n.x));
}

double positive(double angle) { return angle - 2 * M_PI * std::floor(angle / (2 * M_PI)); }

// The corner's outward normals: from that of the side that arrives, anticlockwise to that of the one that leaves.
struct Cone {
  double middle, width;
};

Cone normals_at(const PieceTree& pieces, const ConvexPiece& piece, std::size_t corner) {
  const std::size_t n = piece.corners.size();
  const double from = angle_of(pieces, piece.sides[(corner + n - 1) % n]), turn = positive(angle_of(pieces, piece.sides[corner]) - from);
  return {from + 0.5 * turn, 0.5 * turn + angle_slack};
}

void applies_where(ContactFunction& c, double angle, const Cone& normals, int sense) {
  c.middle = angle + sense * normals.middle;
  c.width = normals.width;
}

const FrameFunction& function(const FrameFunctions& f, const ContactFunction& c, std::size_t k) {
  using F = FrameFunctions;
  static constexpr std::array<F::Name, 4> of_corner{F::x, F::y, F::cosine, F::sine}, of_side{F::cosine, F::sine, F::seen_x, F::seen_y};
  return f.of[(c.kind == ContactFunction::Kind::moving_corner ? of_corner : of_side)[k]];
}

}  // namespace

Expansion ContactFunction::expand(const FrameFunctions& f, const Vec3& reach) const {
  Expansion e;
  e.reach = reach;
  e.value = constant;
  for (std::size_t k = 0; k < 4; ++k) {
    const FrameFunction& g = function(f, *this, k);
    const Interval& a = coefficients[k];
    e.value += a * g.value;
    e.gradient = e.gradient + a * g.gradient;
    e.slope = e.slope + a * g.slope;
    e.hessian = e.hessian + a * g.hessian;
  }
  return e;
}

Interval ContactFunction::range(const FrameFunctions& f, const Vec3& reach) const {
  Interval value = constant;
  Interval3 slope;
  for (std::size_t k = 0; k < 4; ++k) {
    const FrameFunction& g = function(f, *this, k);
    value += coefficients[k] * g.value;
    slope = slope + coefficients[k] * g.slope;
  }
  for (int axis = 0; axis < 3; ++axis) value += slope[axis] * Interval(-reach[axis], reach[axis]);
  return value;
}

double ContactFunction::value(const FrameFunctions& f, Vec3* gradient) const {
  double value = starcell::middle(constant);
  if (gradient) gradient->setZero();
  for (std::size_t k = 0; k < 4; ++k) {
    const FrameFunction& g = function(f, *this, k);
    const double a = starcell::middle(coefficients[k]);
    value += a * starcell::middle(g.value);
    if (gradient) *gradient += a * g.gradient.middle();
  }
  return value;
}

bool ContactFunction::applies(const Interval& angle) const {
  const double reach = 0.5 * (angle.upper() - angle.lower()) + width + angle_slack;
  if (reach >= M_PI) return true;
  const double off = positive(starcell::middle(angle) - middle);
  return off <= reach || 2 * M_PI - off <= reach;
}

ContactFunction moving_corner(std::uint32_t body, const ConvexPiece& moving, std::size_t corner, const PieceTree& fixed, const ConvexPiece& piece, std::size_t side,
                              const PieceTree& of_moving) {
  const ConvexPiece::Side& s = piece.sides[side];
  const PieceCorner& p = moving.corners[corner];
  const Normal n = outward(fixed, s);
  const PieceCorner& a = fixed.lines[s.line].from;
  ContactFunction c{ContactFunction::Kind::moving_corner, s.along, body, s.line, p.id, {}, {}, 0, 0};
  c.coefficients = {n.x, n.y, n.x * p.x + n.y * p.y, n.y * p.x - n.x * p.y};
  c.constant = -(n.x * a.x + n.y * a.y);
  // Farthest against n: with R q a normal there, R q = -n.
  applies_where(c, angle_of(fixed, s) + M_PI, normals_at(of_moving, moving, corner), -1);
  return c;
}

ContactFunction moving_side(std::uint32_t body, const PieceTree& moving, const ConvexPiece& piece, std::size_t side, const ConvexPiece& fixed, std::size_t corner,
                            const PieceTree& of_fixed) {
  const ConvexPiece::Side& s = piece.sides[side];
  const PieceCorner& o = fixed.corners[corner];
  const Normal m = outward(moving, s);
  const PieceCorner& b = moving.lines[s.line].from;
  ContactFunction c{ContactFunction::Kind::moving_side, s.along, body, s.line, o.id, {}, {}, 0, 0};
  // (R m) . o = cos (m . o) + sin (m_x o_y - m_y o_x), and (R m) . t = m . R^T t.
  c.coefficients = {m.x * o.x + m.y * o.y, m.x * o.y - m.y * o.x, -m.x, -m.y};
  c.constant = -(m.x * b.x + m.y * b.y);
  applies_where(c, M_PI - angle_of(moving, s), normals_at(of_fixed, fixed, corner), 1);
  return c;
}

}  // namespace starcell
