// The flat faces of a triangle mesh: connected coplanar triangles as one polygon, with holes, between common edges.
//
// A region grows from its largest triangle across edges, as long as all vertices stay within the tolerance of its plane; then
// the plane is fitted to the region and it grows again. Slivers thinner than the tolerance join whatever lies around them.
// A boundary vertex between exactly two regions goes where the boundary runs straight through it, for both alike.
// Guarantees: every vertex of a region is within the tolerance of its plane, every vertex that went within the tolerance of
// the edge that replaced it; each loop is a simple cycle of three or more vertices, each edge belongs to two faces.
// Does not guarantee: that polygons are simple in their planes to less than the tolerance; who needs it checks (the builder
// of CAD solids does), and asks again with the offending triangles left alone.
#pragma once

#include <cstdint>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell::cad {

struct PlanarFace {
  Vec3 point = Vec3::Zero();      ///< on the plane
  Vec3 normal = Vec3::UnitZ();    ///< outward, of length 1
  double away = 0;                ///< largest distance of a vertex from the plane
  std::vector<std::uint32_t> triangles;
  std::vector<std::vector<std::uint32_t>> loops;  ///< vertices with the inside on the left, seen from outside
};

/// `alone`: one a triangle; those stay faces of their own. Faces are in the order of their largest triangle's area.
std::vector<PlanarFace> planar_faces(const Polyhedron& mesh, double tolerance, const std::vector<char>& alone);

}  // namespace starcell::cad
