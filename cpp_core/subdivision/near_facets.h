// Pairs of facets of different operands that come near each other: where contacts can be.
#pragma once

#include "subdivision/facets.h"

namespace starcell {

using FacetPair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs of facets whose boxes come within `reach` of each other, the lower operand's first; ascending.
std::vector<FacetPair> near_facets(const FacetTable& table, double reach);

}  // namespace starcell
