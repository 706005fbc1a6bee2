// F-star for candidate facets: E on a face that too many planes cross to be arranged.
//
// Rests on DESIGN §3 (F-star): if n . u > 0 for the outward normals of all pieces, u in the face's plane, every line along u leaves the
// solid at most once, so E's arcs are graphs over the line across u: the certified flips on the rim, sorted across u, are paired
// 1-2, 3-4, ... E is among the pieces, so their heights over the chord that stands for an arc bound how far it is.
// Guarantees: the arcs pair E's crossings as E does, and E's arc is within `sway` of each polyline; or none ("don't know").
#pragma once

#include <optional>

#include "subdivision/face_pieces.h"
#include "subdivision/rim.h"
#include "subdivision/statistics.h"

namespace starcell {

/// `error`: what arcs may deviate at most; infinite: topology only. None if anything but one candidate solid reaches the cell.
std::optional<std::vector<Arc>> graph_face(const Restriction& restriction, const CellProblem& problem, const std::vector<Piece>& pieces, RimLines& rims,
                                           const Face& face, double error, Statistics& statistics);

}  // namespace starcell
