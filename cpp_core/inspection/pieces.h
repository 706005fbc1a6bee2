// What becomes of each part of a solid: into how many pieces an erosion splits it, or how many parts a dilation joins.
//
// Both solids are closed surfaces of one or more parts, a part being an outer shell with the cavities in it. A part of one lies inside
// one part of the other, as an erosion's do in the solid and the solid's in a dilation: one point of its outer shell tells in which. That
// is decided exactly, by the parity of shells above the point (upward_ray.h).
// Guarantees: the counts are those of the two meshes. What they say of the true surfaces is up to the meshes' certificates.
#pragma once

#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

/// For every part of `whole`, the largest first, the number of parts of `inner` in it. Parts of `inner` outside `whole` are not counted.
std::vector<int> count_pieces(const Polyhedron& whole, const Polyhedron& inner);

}  // namespace starcell
