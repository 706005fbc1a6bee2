// Fewer triangles for a closed mesh, by collapsing edges, with a proof of how far the new surface is from the old one.
//
// Edges go in the order of their quadric error (Garland & Heckbert 1997). A collapse replaces a star by a fan with the same rim. It is kept if
//   - it passes the link condition (Dey et al. 1999), so that the topology stays;
//   - seen along one direction the fan is a graph over what the star covers (star_map.h), it meets no other triangle (exact), and no
//     vertex lies between the two: then the star moves to the fan without passing through anything, an isotopy;
//   - every triangle of the fan is within the error of the input, and every triangle of the input that was near the star is within it of
//     the new mesh (triangle_cover.h): the bound is that of the final mesh from the input, not a sum over collapses.
// Of each triangle of the input it is kept which of the mesh prove it near, so that a collapse asks only those that relied on its star.
// Guarantees: isotopic to the input, embedded if it is; within `bound` of it, both ways, bound <= most.
// Does not guarantee: fewest triangles.
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

/// Of a closed, embedded manifold. `go_on` is asked now and then, with how much is done, in [0, 1]; once it says no, what has been reached is returned.
Decimated decimate(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool(double)>& go_on = {});

}  // namespace starcell
