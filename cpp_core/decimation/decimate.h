// Fewer triangles for a closed mesh, by collapsing edges, with a proof of how far the new surface is from the old one.
//
// Edges go in the order of their quadric error (Garland & Heckbert 1997). A collapse replaces a star by a fan with the same rim, and is kept if it is
// proved to be an isotopy within the error (isotopy/isotopic_mesh.h).
// Guarantees: isotopic to the input, embedded if it is; within `bound` of it, both ways, bound <= most.
// Does not guarantee: fewest triangles.
#pragma once

#include <cstddef>
#include <cstdint>
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
/// So it is after `most_work` (IsotopicMesh::work()): the same in every run.
Decimated decimate(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool(double)>& go_on = {},
                   std::size_t most_work = SIZE_MAX);

/// Only what lies on its neighbour goes, as a fold of no thickness; all else stays where it is. Arguments as for decimate().
Decimated unfold(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool(double)>& go_on = {});

}  // namespace starcell
