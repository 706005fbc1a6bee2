// Which way the triangles of a closed manifold face: the same way across every edge, and outward.
#pragma once

#include <vector>

#include "solids/connectivity.h"

namespace starcell {

class TriangleHierarchy;

struct Shells {
  std::vector<std::uint32_t> of_triangle;    ///< edge-connected component of every triangle, numbered by first triangle
  std::vector<std::uint32_t> first_triangle; ///< of every component
  Defect non_orientable;                     ///< components such as a Klein bottle that no choice of sides makes consistent
};

/// Turns triangles round until every component is consistent; the first triangle of a component stays as it is.
/// `neighbours` follow. Components that cannot be made consistent are counted.
Shells orient_consistently(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles,
                           std::vector<Triangle>& neighbours);

/// Turns whole shells round until normals point outward and nested shells alternate: a shell inside an odd number of
/// others bounds a cavity. Exact. Needs closed, consistent shells that do not meet each other or themselves.
void orient_outward(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles,
                    std::vector<Triangle>& neighbours, const Shells& shells, const TriangleHierarchy& hierarchy);

}  // namespace starcell
