// Which triangles share which edges, and where a mesh fails to be a closed 2-manifold. Combinatorics only: the same
// answer for any coordinates, and for any orientation of the triangles.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

/// One kind of defect: how often, and the first place in words.
struct Defect {
  std::size_t count = 0;
  std::string first;
};

/// "(1, 2.5, 0)", six significant digits, whatever the host's locale.
std::string place(const Vec3& point);

/// Stands in a neighbour list for "no triangle": an edge that is open or not manifold.
inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

struct Connectivity {
  std::vector<Triangle> neighbours;  ///< as Polyhedron::neighbours(), with kNoTriangle
  Defect open_edges;                 ///< edges of one triangle
  Defect non_manifold_edges;         ///< edges of three triangles or more
  Defect non_manifold_vertices;      ///< vertices, on no such edge, whose triangles form more than one fan
  Defect doubled_facets;             ///< triangles with the same three vertices as an earlier one

  bool closed_manifold() const {
    return open_edges.count + non_manifold_edges.count + non_manifold_vertices.count + doubled_facets.count == 0;
  }
};

/// Triangles must have three different vertices, all in range.
Connectivity connect(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles);

}  // namespace starcell
