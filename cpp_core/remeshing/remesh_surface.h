// The same surface in well-shaped triangles, with a proof of how far the new one is from the old.
//
// Long edges are cut, short ones collapsed, edges flipped towards better angles, and vertices moved towards the middle of their neighbours
// and back to the input, again and again (Botsch & Kobbelt 2004); at last, what is still thin is mended one triangle at a time. How long an edge
// should be is asked for, and less beside sharp edges that are nearer than that (size_field.h). Every step is one of an IsotopicMesh: proved, or not done.
// Guarantees: isotopic to the input, embedded if it is; within `bound` of it, both ways, bound <= most; sharp edges (features.h) are the same
// sets of points, up to rounding.
// Does not guarantee: angles. Corners of the input that are thin stay so, and where the error leaves no room triangles keep their shape.
#pragma once

#include <functional>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

struct Remeshing {
  double edge_length;     ///< of most edges
  double most;            ///< of the Hausdorff distance, both ways
  double feature_angle;   ///< radians: edges at which the surface turns by more are sharp
  double off = 0;         ///< how far the mesh is from what it stands for: what is no wider makes no sharp edges
};

struct Remeshed {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  double bound = 0;   ///< of the two-sided Hausdorff distance from the input
  std::size_t feature_edges = 0, corners = 0;   ///< of the result: sharp edges, and the vertices that had to stay where they are
};

/// Of a closed, embedded manifold. `go_on` is asked now and then, with how much is done, in [0, 1]; once it says no, what has been reached is returned.
Remeshed remesh_surface(std::vector<Vec3> vertices, std::vector<Triangle> triangles, const Remeshing& wanted, const std::function<bool(double)>& go_on = {});

}  // namespace starcell
