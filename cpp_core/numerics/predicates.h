// Exact signs of orientation determinants on double coordinates.
//
// Rests on Shewchuk (1997), "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", for the
// error bounds of the first filter stage; what it cannot decide goes to CGAL's exact kernel.
// Guarantees: the sign of the real determinant, for every finite input whose differences do not overflow, in
// round-to-nearest mode. The *_grid forms never return zero unless the first points themselves are degenerate: a grid
// point g stands for g + (e1, e2, e3) with infinitesimal e1 >> e2 >> e3 > 0 (Edelsbrunner & Mücke 1990), the same shift
// for every grid point, so that no grid vertex, edge or face ever touches the surface degenerately.
#pragma once

#include "numerics/vector.h"

namespace starcell {

/// Two coordinates of a point: the projection along `axis` keeps the next two axes in cyclic order.
struct Vec2 {
  double x, y;
};

inline Vec2 project(const Vec3& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// Sign of (q - p) x (r - p): +1 when p, q, r turn left.
int turn(const Vec2& p, const Vec2& q, const Vec2& r);

/// Sign of ((q - p) x (r - p)) . (s - p): +1 when s is on the side that the normal of p, q, r points to.
int side(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s);

/// turn() with r a grid point whose coordinates lie on axes `axis_x`, `axis_y` (which decides how it is perturbed).
int turn_grid(const Vec2& p, const Vec2& q, const Vec2& r, int axis_x, int axis_y);

/// side() with s a grid point.
int side_grid(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s);

/// Is coordinate v of a mesh vertex below grid coordinate g? A vertex on the plane is below: the plane moves up by e.
inline bool below(double v, double g) { return v <= g; }

}  // namespace starcell
