// Offsets that have a closed form: half-spaces, convex polyhedra inward, and solids of revolution that were only moved.
#pragma once

#include <optional>

#include "expression/expression.h"

namespace starcell {

/// The exact offset by r (not 0) of one solid as an expression of solids; nothing if it has none here, or none for this r.
///
/// Balls and tori have another radius. Inward, convex solids are eroded by moving the half-spaces and cones that bound them. Outward,
/// cylinders and cones are unions: the caps' discs grow to slabs, the side moves, the rims become tori, and a tip a ball. That takes a
/// radius smaller than the rims' and a side no flatter than 45 degrees.
std::optional<Expression> closed_offset(const Expression& solid, double r);

}  // namespace starcell
