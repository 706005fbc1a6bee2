// Regions take their place in the table, and surface identity (DESIGN §4) holds for them as for facets: a shaft in its bore,
// coaxial cylinders of one radius, a ball in its socket, an end plane on a polyhedron's side.
#pragma once

#include "subdivision/facets.h"

namespace starcell {

/// Appends the regions. Surfaces within `contact` of each other wherever both matter become one: the first one's equation, and
/// a thickness that covers the others. Surfaces of polyhedra have to be there already.
void add_regions(FacetTable& table, const std::vector<RegionOperand>& regions, double contact, const std::vector<Vec3>& shifts);

}  // namespace starcell
