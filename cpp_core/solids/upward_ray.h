// The triangles straight above a point. Exact (CGAL's filtered predicates).
//
// The upward ray from p may graze edges and vertices. It is therefore shot from p + (δ, δ²) for an infinitesimal δ (Edelsbrunner &
// Muecke, "Simulation of Simplicity", 1990): every edge then passes strictly left or right of it, so the parity needs no second ray.
// Moving p so little changes no parity of shells that p does not lie on.
#pragma once

#include <functional>

#include "solids/polyhedron.h"

namespace starcell {

class TriangleHierarchy;

/// Is the triangle above p?
bool is_above(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

/// Calls visit(t) for every triangle of the solid above p; the hierarchy is of its triangles.
void for_each_above(const Polyhedron& solid, const TriangleHierarchy& hierarchy, const Vec3& p, const std::function<void(std::uint32_t)>& visit);

}  // namespace starcell
