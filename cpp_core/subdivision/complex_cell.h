// The thesis's own criterion (T§3.4: C-box-star), for comparison with the trace criterion and for its tables.
//
// A cell passes if E is empty in it, or: no edge is crossed twice; no face or voxel meets E without a sign change; the
// corner signs are unambiguous; and E is star-shaped with respect to the voxel and to each face (a guard by T§3.5.2's
// linear program). By Theorem 1 of the thesis E∩C is then one disk.
#pragma once

#include "subdivision/leaf.h"
#include "subdivision/statistics.h"

namespace starcell {

/// The leaf's arcs must be the cell's trace.
bool satisfies_complex_cell(const Restriction& restriction, const CellProblem& problem, const Leaf& leaf,
                            Statistics& statistics);

}  // namespace starcell
