// The exact test is CGAL's filtered predicates. In front of it stand floating-point separation proofs, each with a
// bound on its own error, which settle nearly all pairs of an ordinary mesh, flat and nearly flat parts included,
// where exact predicates are slowest. Why few cases suffice:
//   one shared edge: two triangles on one line meet outside it only if coplanar and folded over onto one side;
//   one shared vertex v: the common part is convex and contains v; if it is more than v, a segment from v in it goes on
//     until it leaves one of the triangles, through the edge opposite v: so one of these edges meets the other triangle.
#include "solids/triangle_pair.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>

namespace starcell {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

// Error of a dot product of computed differences: each product passes through at most 2 + 1 + 2 roundings (difference,
// product, sums) of 2^-53, so 8 * 2^-53 of the absolute sum covers it. kTiny covers underflow of the products.
constexpr double kError = 8 * 0x1p-53;
constexpr double kTiny = 1e-280;

Point exact(const Vec3& p) { return {p[0], p[1], p[2]}; }

// Certainly n·(p - o) > 0 ? Any n will do: it only chooses the separating plane, and is taken as exactly what it is.
bool surely_positive(const Vec3& n, const Vec3& p, const Vec3& o) {
  const Vec3 d = p - o;
  return n.dot(d) > kError * n.cwiseAbs().dot(d.cwiseAbs()) + kTiny;
}
bool surely_negative(const Vec3& n, const Vec3& p, const Vec3& o) { return surely_positive(-n, p, o); }

// Does the plane through v with normal n separate triangles (v, a, b) and (v, c, d) but for v?
bool separates_at(const Vec3& n, const Vec3& v, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return surely_positive(n, a, v) && surely_positive(n, b, v) && surely_negative(n, c, v) && surely_negative(n, d, v);
}

// Does some plane across n separate the two triangles? Distances are measured from s[0]. A value and its error bound
// are intervals that hold the true dot product; disjoint hulls of three are proof.
bool separates(const Vec3& n, const Vec3* const s[3], const Vec3* const t[3]) {
  const Vec3 weight = n.cwiseAbs();
  const auto range = [&](const Vec3* const triangle[3], double& low, double& high) {
    low = INFINITY;
    high = -INFINITY;
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = *triangle[i] - *s[0];
      const double value = n.dot(d), error = 2 * kError * weight.dot(d.cwiseAbs()) + kTiny;  // twice: value ± error rounds too
      if (!(error < INFINITY)) { low = -INFINITY; high = INFINITY; return; }
      low = std::min(low, value - error);
      high = std::max(high, value + error);
    }
  };
  double s_low, s_high, t_low, t_high;
  range(s, s_low, s_high);
  range(t, t_low, t_high);
  return s_high < t_low || t_high < s_low;
}

// Edge a-b shared, c and d the other vertices. Normals of (a, b, c) and (a, b, d) that surely point apart by more than a
// right angle belong to triangles on different sides of a-b: the flat and the convex case.
bool folded_over(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 e = b - a, p = c - a, q = d - a;
  const Vec3 m = e.cross(p), n = e.cross(q);
  const Vec3 ae = e.cwiseAbs(), ap = p.cwiseAbs(), aq = q.cwiseAbs();
  const auto permanent = [&](const Vec3& x) {
    return Vec3(ae[1] * x[2] + ae[2] * x[1], ae[2] * x[0] + ae[0] * x[2], ae[0] * x[1] + ae[1] * x[0]);
  };
  // Every product of four differences passes through at most 4 + 2 + 2 + 3 = 11 roundings; 16 covers them. A product of
  // two that underflows loses up to 2^-1074, which the other factor, below 1e120, cannot bring up to 1e-190.
  const bool in_range = ae.maxCoeff() < 1e50 && ap.maxCoeff() < 1e50 && aq.maxCoeff() < 1e50;
  if (in_range && m.dot(n) < -(2 * kError * permanent(ap).dot(permanent(aq)) + 1e-190)) return false;
  if (CGAL::orientation(exact(a), exact(b), exact(c), exact(d)) != CGAL::COPLANAR) return false;
  return CGAL::coplanar_orientation(exact(a), exact(b), exact(c), exact(d)) == CGAL::POSITIVE;
}

bool edge_meets(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  return CGAL::do_intersect(Kernel::Triangle_3(exact(a), exact(b), exact(c)), Kernel::Segment_3(exact(p), exact(q)));
}

bool one_vertex_shared(const Vec3& v, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 s = (a - v) + (b - v), t = (c - v) + (d - v);
  const double s_length = s.norm(), t_length = t.norm();
  if (separates_at(s / s_length - t / t_length, v, a, b, c, d)) return false;
  // A triangle strictly on one side of the other's plane, but for v
  const auto side = [&](const Vec3& x, const Vec3& y, const Vec3& p) { return CGAL::orientation(exact(v), exact(x), exact(y), exact(p)); };
  const auto c_side = side(a, b, c), d_side = side(a, b, d);
  if (c_side == d_side && c_side != CGAL::COPLANAR) return false;
  const auto a_side = side(c, d, a), b_side = side(c, d, b);
  if (a_side == b_side && a_side != CGAL::COPLANAR) return false;
  return edge_meets(a, b, v, c, d) || edge_meets(c, d, v, a, b);
}

bool nothing_shared(const Vec3* const s[3], const Vec3* const t[3]) {
  const Vec3 s0 = *s[1] - *s[0], s1 = *s[2] - *s[1], s2 = *s[0] - *s[2];
  const Vec3 t0 = *t[1] - *t[0], t1 = *t[2] - *t[1], t2 = *t[0] - *t[2];
  const Vec3 n = s0.cross(s1), m = t0.cross(t1);
  for (const Vec3& axis : {n, m}) if (separates(axis, s, t)) return false;
  for (const Vec3& edge : {s0, s1, s2}) if (separates(edge.cross(n), s, t)) return false;  // settles flat parts
  for (const Vec3& edge : {t0, t1, t2}) if (separates(edge.cross(m), s, t)) return false;
  for (const Vec3& x : {s0, s1, s2})
    for (const Vec3& y : {t0, t1, t2}) if (separates(x.cross(y), s, t)) return false;
  const auto exact_triangle = [](const Vec3* const x[3]) { return Kernel::Triangle_3(exact(*x[0]), exact(*x[1]), exact(*x[2])); };
  return CGAL::do_intersect(exact_triangle(s), exact_triangle(t));
}

}  // namespace

bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  // An area in one projection, beyond doubt, is an area; CGAL's exact test for the rest.
  const Vec3 p = b - a, q = c - a;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double x = p[i] * q[j], y = p[j] * q[i];
    if (std::abs(x - y) > kError * (std::abs(x) + std::abs(y)) + kTiny) return false;
  }
  return CGAL::collinear(exact(a), exact(b), exact(c));
}

bool meet_outside_shared(const std::vector<Vec3>& vertices, const Triangle& s, const Triangle& t) {
  int shared = 0, s_rest = 3, t_rest = 3;  // sums of the corners that are not shared: the corner itself if one is left
  int s_corner = 0, t_corner = 0;          // the last shared pair
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (s[i] == t[j]) {
        ++shared;
        s_rest -= i;
        t_rest -= j;
        s_corner = i;
        t_corner = j;
      }
  const auto at = [&](const Triangle& x, int corner) -> const Vec3& { return vertices[x[corner % 3]]; };
  if (shared == 0) {
    const Vec3* const a[3] = {&vertices[s[0]], &vertices[s[1]], &vertices[s[2]]};
    const Vec3* const b[3] = {&vertices[t[0]], &vertices[t[1]], &vertices[t[2]]};
    return nothing_shared(a, b);
  }
  if (shared == 1)
    return one_vertex_shared(at(s, s_corner), at(s, s_corner + 1), at(s, s_corner + 2), at(t, t_corner + 1), at(t, t_corner + 2));
  if (shared == 2) return folded_over(at(s, s_rest + 1), at(s, s_rest + 2), at(s, s_rest), at(t, t_rest));
  return false;
}

}  // namespace starcell
