// How close a fan will be to a sheet of E in a cell: the error criterion, decided before contouring.
//
// Rests on two lemmas. *Cone*: a surface inside a union of planes through one point v of a convex cell, without boundary
// in the cell's interior, is the cone from v over its trace; so for planes through one point the fan from that point over
// the exact trace is E itself. *Slab*: if E's sheet is a graph over the plane across u between heights l and h, A's fan is
// one too, and their loops are g apart, each point of one has a point of the other within sqrt((h-l)^2 + g^2): the
// vertical line through it meets the other, unless the homotopy between the loops' shadows passes over it.
// Guarantees: both bounds are two-sided and hold against E in the cell, not against whole primitives (T§3.8's weakness).
#pragma once

#include <optional>

#include "subdivision/leaf.h"

namespace starcell {

/// Planar, crease or corner, if the surfaces (ascending) pass through a common point of the cell; `candidates` are points
/// to try first. None otherwise.
std::optional<Sheet> concurrent_sheet(const Restriction& restriction, const Box3& box,
                                      const std::vector<std::uint32_t>& surfaces, const std::vector<Vec3>& candidates);

/// A slab around the given facets inside the box, if their normals (turned by `flip`) agree with its direction.
std::optional<Sheet> slab_sheet(const FacetTable& table, const Box3& box, const std::vector<std::uint32_t>& facets,
                                bool flip);

}  // namespace starcell
