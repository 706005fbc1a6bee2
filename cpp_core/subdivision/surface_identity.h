// Surface identity (DESIGN §4): facets of different operands on one plane, within the contact tolerance, share one surface,
// with one canonical equation.
#pragma once

#include "subdivision/near_facets.h"

namespace starcell {

/// Facets are on one surface when each lies within `contact` of the other's plane and they come that near; `pairs`: all
/// that do. The relation is closed under transitivity; thickness has to be measured afterwards.
void identify_surfaces(FacetTable& table, const std::vector<FacetPair>& pairs, double contact);

}  // namespace starcell
