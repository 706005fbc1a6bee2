// Which candidate facets lie on one plane? They overlap and share no edges, so planes are compared, not neighbours.
//
// Surface identity (DESIGN §4) within one operand: a sum of prisms has a hundred facets on its top. Guarantees: a facet's corners are
// within the tolerance of its surface's plane, which is that of the largest facet on it. The tolerance is rounding's: planes that are thicker
// make signs uncertain in small cells.
#pragma once

#include "subdivision/facets.h"

namespace starcell {

/// Gives the facets [first, last) their surfaces, appended to the table.
void find_candidate_surfaces(FacetTable& table, std::uint32_t first, std::uint32_t last, double tolerance);

}  // namespace starcell
