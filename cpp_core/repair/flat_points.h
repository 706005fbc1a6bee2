// Takes points out of an exact surface that shape nothing: amid a plane, or along a straight edge between two.
//
// Cuts leave many such points, and slivers beside them that do not survive rounding. A point moves onto a neighbour if all its triangles
// stay on their planes and keep their side: the same polygons in fewer triangles. Guarantees: the same set of points, exactly, and the same
// topology (link condition, Dey et al. 1999); points that surfaces touch in stay. Does not guarantee that none is left.
#pragma once

#include "repair/exact_arrangement.h"

namespace starcell {

/// Of the points from `first` on.
void take_out_flat_points(ExactSurface& surface, std::uint32_t first, const std::function<void()>& pause);

}  // namespace starcell
