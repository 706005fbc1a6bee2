// F-planes: E on a face that several solids, or surfaces in contact, reach.
//
// Rests on DESIGN §3 (F-planes) and §4 (surface identity): the supporting planes cut the face along lines into convex
// regions on which every solid is constant, because its boundary there lies on those lines. All facets of one surface
// flip together. The arrangement's combinatorics come from certified signs (interval arithmetic): which sides a line
// meets, the order of the ends around the face, and the order of crossings along each line.
// Guarantees: the arcs are E∩f exactly, or none is returned ("don't know"). Where two sheets of E cross in a point
// (edge contact) they are resolved by DESIGN §4's rule: inside regions join only across a line, never in a point.
#pragma once

#include <optional>

#include "subdivision/face_lines.h"

namespace starcell {

std::optional<std::vector<Arc>> arrange_pieces(const FaceProblem& input);

}  // namespace starcell
