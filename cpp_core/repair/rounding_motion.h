// Does a surface with exact points stay what it is while these go straight to the nearest doubles?
//
// Two triangles keep apart on the way if one plane has them on either side both before and after: distances from it are linear in time. About a common
// edge it is the volume over it that keeps its sign, or the triangles that stay on opposite sides of the edge: polynomials in time, by their
// Bernstein coefficients (straight_motion.h says the same of doubles). So if all pairs that come near do, the two surfaces are isotopic.
// Guarantees: exact, but for pairs that floating point settles with room to spare. Does not guarantee to find the plane where there is hardly one.
#pragma once

#include <functional>

#include "repair/exact_arrangement.h"

namespace starcell {

/// Where that is not proved. `places`: where the surface's points go; the mesh that they make is embedded.
std::vector<Box3> not_proved_to_keep(const ExactSurface& surface, const std::vector<Vec3>& places, const std::function<void()>& pause);

}  // namespace starcell
