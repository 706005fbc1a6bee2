#include "numerics/predicates.h"

#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace starcell {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Shewchuk's bounds for the one-stage filters: (3 + 16 u) u and (7 + 56 u) u with u = 2^-53, rounded up.
constexpr double turn_bound = 3.3306690738754716e-16;
constexpr double side_bound = 7.7715611723761027e-16;
// Below this a product may have lost bits to underflow and the relative bounds no longer hold.
constexpr double underflow_guard = 1e-280;

int exact_turn(const Vec2& p, const Vec2& q, const Vec2& r) {
  return CGAL::orientation(Kernel::Point_2(p.x, p.y), Kernel::Point_2(q.x, q.y), Kernel::Point_2(r.x, r.y));
}

int exact_side(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  return CGAL::orientation(Kernel::Point_3(p.x(), p.y(), p.z()), Kernel::Point_3(q.x(), q.y(), q.z()),
                           Kernel::Point_3(r.x(), r.y(), r.z()), Kernel::Point_3(s.x(), s.y(), s.z()));
}

int sign(double x) { return (x > 0) - (x < 0); }

}  // namespace

int turn(const Vec2& p, const Vec2& q, const Vec2& r) {
  const double left = (p.x - r.x) * (q.y - r.y);
  const double right = (p.y - r.y) * (q.x - r.x);
  const double det = left - right;
  const double bound = turn_bound * (std::abs(left) + std::abs(right));
  if (std::abs(det) > bound && std::abs(det) > underflow_guard) return sign(det);
  return exact_turn(p, q, r);
}

int side(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  const double px = p.x() - s.x(), py = p.y() - s.y(), pz = p.z() - s.z();
  const double qx = q.x() - s.x(), qy = q.y() - s.y(), qz = q.z() - s.z();
  const double rx = r.x() - s.x(), ry = r.y() - s.y(), rz = r.z() - s.z();
  const double qxry = qx * ry, rxqy = rx * qy, rxpy = rx * py, pxry = px * ry, pxqy = px * qy, qxpy = qx * py;
  const double det = pz * (qxry - rxqy) + qz * (rxpy - pxry) + rz * (pxqy - qxpy);
  const double permanent = (std::abs(qxry) + std::abs(rxqy)) * std::abs(pz) +
                           (std::abs(rxpy) + std::abs(pxry)) * std::abs(qz) +
                           (std::abs(pxqy) + std::abs(qxpy)) * std::abs(rz);
  if (std::abs(det) > side_bound * permanent && std::abs(det) > underflow_guard) return -sign(det);
  return exact_side(p, q, r, s);
}

int turn_grid(const Vec2& p, const Vec2& q, const Vec2& r, int axis_x, int axis_y) {
  if (const int exact = turn(p, q, r)) return exact;
  // d/dr of the determinant is (-(q.y - p.y), q.x - p.x); the coordinate on the lower axis moves infinitely more.
  const int by_x = sign(p.y - q.y), by_y = sign(q.x - p.x);
  if (axis_x < axis_y) return by_x != 0 ? by_x : by_y;
  return by_y != 0 ? by_y : by_x;
}

int side_grid(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  if (const int exact = side(p, q, r, s)) return exact;
  // d/ds of the determinant is the normal; its components are 2D orientations of the projections.
  for (int axis = 0; axis < 3; ++axis)
    if (const int n = turn(project(p, axis), project(q, axis), project(r, axis))) return n;
  return 0;
}

}  // namespace starcell
