// A sheet that V-planes knows plane by plane, in A as it is in E.
//
// Rests on DESIGN §3 (V-planes: "the polygons themselves are exact"). Corners inside the cell are three-plane points; the
// rim is the loop that the cell's faces carry, with whatever vertices finer neighbours put on it. Guarantees: the same disk as
// E's, displaced by no more than the bound says. Whether it is still embedded after points were moved is for the caller to test.
#pragma once

#include "contouring/fan.h"

namespace starcell {

struct FlatSheet {
  double bound = 0;   ///< two-sided Hausdorff distance to the sheet
};

/// Appends the sheet's triangles to the mesh. None if the loop's vertices are not those that its parts expect.
std::optional<FlatSheet> emit_flats(const Box3& cell, const Sheet& sheet, const DrawnLoop& loop, double margin,
                                          SurfaceMesh& mesh);

}  // namespace starcell
