// An exact closed surface that may touch itself, as a polyhedron: edges and vertices in which it does are pulled apart.
//
// DESIGN §4's rule: what is inside joins only across a face. So about an edge of more than two triangles those that bound the same
// inside belong together, and of a vertex every cycle of triangles gets a copy of its own; copies move into their insides by `gap`.
// Coordinates are rounded to double. Guarantees: a polyhedron homeomorphic to the surface with its contacts opened, valid as
// Polyhedron::make() has tested exactly, or none. Where it was pulled apart, and how far, is in its provenance.
#pragma once

#include "repair/exact_arrangement.h"

namespace starcell {

/// None if, once rounded, it is not embedded.
PolyhedronPtr pulled_apart(ExactSurface surface, double gap);

}  // namespace starcell
