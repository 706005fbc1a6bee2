// An exact closed surface that may touch itself, as a polyhedron: edges and vertices in which it does are pulled apart.
//
// DESIGN §4's rule: what is inside joins only across a face. So about an edge of more than two triangles those that bound the same
// inside belong together, and of a vertex every cycle of triangles gets a copy of its own; copies move into their insides by `gap`.
// Coordinates are rounded to double. Guarantees: a polyhedron homeomorphic to the surface with its contacts opened, valid as
// Polyhedron::make() has tested exactly, or none. Where it was pulled apart, and how far, is in its provenance; if it was nowhere, rounding is
// proved an isotopy (rounding_motion.h), and where it is not is a contact, too.
#pragma once

#include "repair/exact_arrangement.h"

namespace starcell {

/// None if, once rounded, it is not embedded. `pause` is called now and then, and may throw.
PolyhedronPtr pulled_apart(ExactSurface surface, double gap, const std::function<void()>& pause);

}  // namespace starcell
