// Components of the free space where angles go round: 0 and 2 pi are one.
//
// The mesh tells components in the unrolled box. Two of them are one if a configuration at an angle of 0 belongs to the one, and, at 2 pi, to the other. Witnesses are taken in
// every connected part of the mesh's cut at either end; each is certainly free, with more room about it than the mesh is off, so that the
// part of the mesh about it is that of the free space's component. Guarantees: a number only if every part of either cut has a witness. Does not
// guarantee that the cuts of mesh and free space have the same parts where two of these come as near to each other as the mesh is off: the
// certificate is about the mesh in the unrolled box.
#pragma once

#include <optional>

#include "configuration_space/collision_surface.h"
#include "operations/boolean.h"

namespace starcell {

/// `surface` null: all is free. Coordinates from `first_angle` on are angles, scaled.
std::optional<std::size_t> wrapped_components(const Result& result, const CollisionSurface* surface, const Box3& domain, int first_angle);

}  // namespace starcell
