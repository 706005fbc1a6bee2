// What a closed chain of triangles winds about, exactly: its triangles cut where they cross, and of the pieces those between winding numbers <= 0 and >= 1.
//
// Rests on Zhou, Grinspun, Zorin & Jacobson (2016), "Mesh Arrangements for Solid Geometry": triangles on one plane that overlap are cut together,
// all others by what they have in common with the rest (CGAL's exact kernel); two pieces that alone share an edge have the same
// winding numbers beside them, so one ray for each patch of such pieces tells all. Guarantees: exact, whatever touches, crosses or
// coincides; the pieces' edges are balanced. Does not guarantee manifolds: see pulled_apart.h.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "solids/polyhedron.h"

namespace starcell {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_3;

struct ExactSurface {
  std::vector<ExactPoint> points;
  std::vector<Triangle> triangles;   ///< outward
};

/// The boundary of {winding number >= 1} of a closed chain without doubled points; triangles without an area do not count. `pause` is called
/// now and then, and may throw.
ExactSurface boundary_of_winding(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, const std::function<void()>& pause);

}  // namespace starcell
