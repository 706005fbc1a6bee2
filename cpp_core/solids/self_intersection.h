// Pairs of triangles of one mesh that meet outside the vertices and edges they share: crossings, coplanar overlaps,
// facets folded over, components that touch, T-junctions. And triangles without area, which always cause such a pair.
#pragma once

#include "solids/connectivity.h"
#include "solids/triangle_hierarchy.h"

namespace starcell {

struct SelfIntersections {
  Defect zero_area;
  Defect pairs;            ///< zero-area triangles are left out of the pairs: each counts as a defect of its own
  bool all_found = true;   ///< false: there are more pairs than the count, which stops at kMostPairs
  static constexpr std::size_t kMostPairs = 1000;
};

/// Exact and complete. Coordinates must be finite, triangles must have three different vertices.
SelfIntersections find_self_intersections(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                          const TriangleHierarchy& hierarchy);

}  // namespace starcell
