// Flat regions come out as few large triangles: connected triangles of one plane become one polygon, triangulated anew
// from its corners.
//
// A vertex inside a region goes; a vertex between exactly two regions goes if it lies on the straight line between the
// corners that stay. So the surface does not change as a set, up to rounding, and neither does its topology: each region
// is replaced by a triangulation of the same polygon with the same boundary.
// Guarantees: closed and manifold as before; embedded in double and in float32, tested exactly: regions whose new triangles
// meet anything are left as they were. What still meets is said. A mesh that is not closed or not manifold stays as it is.
#pragma once

#include "contouring/embedding.h"

namespace starcell {

struct FlatMerge {
  double moved = 0;       ///< how far the surface moved at most (rounding)
  bool embedded = false;  ///< the mesh as it is now was tested: no two triangles meet
  std::vector<Box3> meeting_as_floats;  ///< triangles that meet others once rounded to float32: slivers thinner than its step
  bool depends_on_rounding = false;     ///< some meet if coordinates are rounded, be it only one of the three
};

/// `hurried`: asked when regions did not serve; true: then none is merged. Throws CancelledError.
FlatMerge merge_flat_regions(SurfaceMesh& mesh, double tolerance, const GoOn& go_on = {}, const std::function<bool()>& hurried = {});

}  // namespace starcell
