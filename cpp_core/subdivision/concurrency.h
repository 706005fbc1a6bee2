// Do all planes of a cell pass through one point because of what they are, or only as far as rounding tells?
//
// More than three planes through one point are no accident: they are faces around a vertex, or an edge. Facets that have a vertex, or two, in common
// say so without any arithmetic, and so V-cone needs no tolerance there: its verdict can be exact. Guarantees: true only if the
// planes of the facets, as the operands define them, have a point in common that is the cone's apex up to rounding.
#pragma once

#include "subdivision/leaf.h"

namespace starcell {

/// All planes pass through one point by construction: a vertex of all, or a point of an edge that all have, or where one plane
/// crosses an edge that all others have. Vertices that rounding may have made of several do not count.
bool meet_by_construction(const FacetTable& table, const std::vector<std::uint32_t>& facets, const Sheet& cone, const Box3& box);

}  // namespace starcell
