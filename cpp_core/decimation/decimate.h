// Fewer triangles for a closed mesh, by collapsing edges, with a proof of how far the new surface is from the old one.
//
// Edges go in the order of their quadric error (Garland & Heckbert 1997), if they pass the link condition (Dey et al. 1999), which
// keeps the topology, and an exact test against all triangles near by, which keeps the mesh embedded. A collapse replaces a star by a
// fan with the same rim; seen along one direction, the fan is a graph over what the star covers, and points over each other are matched
// (star_map.h). All matchings one after another match the whole result with the whole input: the sum of the displacements, kept per
// triangle, bounds the Hausdorff distance from either side (successive mappings: Cohen, Manocha & Olano 1997).
// Guarantees: same topology; embedded if the input is; within `bound` of the input, both ways, bound <= most.
// Does not guarantee: fewest triangles. The bound adds up what collapses did to the same place: the true distance is smaller.
#pragma once

#include <functional>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

struct Decimated {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  double bound = 0;   ///< of the two-sided Hausdorff distance from the input
};

/// Of a closed, embedded manifold. `go_on` is asked now and then; once it says no, what has been reached is returned.
Decimated decimate(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool()>& go_on = {});

}  // namespace starcell
