// F-star: E on a face that curved surfaces reach, and F-split where one look at it is not enough.
//
// Rests on DESIGN §3 (F-star, F-split) and T§3.5.2, §3.5.4. A class of patches (patch_view.h) that a direction u of the face's
// plane sees is met at most once by every line along u, so its arcs are graphs over the line across u: the certified flips on the
// rim, sorted across u, are paired 1-2, 3-4, ... Classes have no point in common, so their arcs are disjoint. Where no
// direction is found the face alone is quartered, and the squares' arcs are joined.
// Guarantees: the arcs pair E's crossings as E does, and E's arc is within `sway` of each polyline; or none ("don't know").
#pragma once

#include <optional>

#include "subdivision/patch_view.h"
#include "subdivision/rim.h"
#include "subdivision/statistics.h"
#include "subdivision/trace.h"

namespace starcell {

/// The rims are those of the cell's edges. `error`: what arcs may deviate at most; infinite: topology only, sways are not looked at.
std::optional<std::vector<Arc>> star_face(const Restriction& restriction, const Patches& patches, RimLines& rims, const Face& face,
                                          double error, Statistics& statistics);

}  // namespace starcell
