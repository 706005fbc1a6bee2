// Where the octree lies: around the solid, on float32 numbers, with shallow grid planes away from the solid's vertices.
#pragma once

#include "subdivision/facets.h"
#include "subdivision/grid.h"

namespace starcell {

/// `box` must be finite and not empty. Of a few shifted candidates (always the same), the one whose planes of the first
/// levels keep farthest from the table's vertices.
/// `attempt`: 0, or another number for other candidates.
Grid choose_grid(const Box3& box, const FacetTable& table, int attempt = 0);

/// One float32 step at the far end of a box: nothing nearer than that can be kept apart in the result.
double float_step(const Box3& box);

}  // namespace starcell
