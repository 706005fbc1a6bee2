// Components of the free space where angles go round: 0 and 2 pi are one.
//
// The mesh tells components in the unrolled box. Two of them are one if a configuration at an angle of 0 belongs to the one, and, at 2 pi, to the other. Witnesses are taken in
// every connected part of the mesh's cut at either end: certainly free, and joined, at either end, to a place with more room about it than the mesh is off, by a
// chain of cubes that are free: so the part of the mesh about that place is that of the free space's component. Where a part is too thin for a witness, it is told by its place,
// or need not be told: what the cut has left of a component, a chip, goes on as one other. Does not guarantee that the cuts of mesh and free space have the same
// parts where two of these come as near to each other as the mesh is off: the certificate is about the mesh in the unrolled box. None where parts cannot be told.
#pragma once

#include <optional>

#include "operations/boolean.h"

namespace starcell {

/// `collision`: of regions; none: all is free. `goes_round`: which coordinates are such angles.
std::optional<std::size_t> wrapped_components(const Result& result, const std::optional<Expression>& collision, const Box3& domain, const std::array<bool, 3>& goes_round);

}  // namespace starcell
