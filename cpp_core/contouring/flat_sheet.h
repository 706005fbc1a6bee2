// A sheet that V-planes knows plane by plane, in A as it is in E.
//
// Rests on DESIGN §3 (V-planes: "the polygons themselves are exact"). Corners inside the cell are three-plane points; the
// rim are the loops that the cell's faces carry, with whatever vertices finer neighbours put on them. Guarantees: the same surface as
// E's, displaced by no more than the bound says. Whether it is still embedded after points were moved is for the caller to test.
#pragma once

#include "contouring/fan.h"

namespace starcell {

struct FlatSheet {
  double bound = 0;   ///< two-sided Hausdorff distance to the sheet
};

/// Appends the sheet's triangles to the mesh. None if the loops' vertices are not those that its parts expect.
std::optional<FlatSheet> emit_flats(const Box3& cell, const Sheet& sheet, const std::vector<const DrawnLoop*>& loops, double margin,
                                    SurfaceMesh& mesh);

}  // namespace starcell
