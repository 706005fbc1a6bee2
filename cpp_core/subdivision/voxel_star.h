// V-star: E in a cell where solids cross, seen as a graph over a plane (DESIGN §3; T§3.5.2 with the guard at infinity).
//
// If one direction u has n . u > 0 for the outward normal of every facet that can bound E in the cell, every line along u
// leaves the solid at most once, so E∩C projects injectively across u. A sheet is then a planar domain: a disk exactly if
// it has one boundary. Sound loop tests: a single loop; or every loop touches both the sides of the cell that face u and
// those that face away, because a loop around a hole of a domain lies on one of the two kinds alone.
#pragma once

#include <optional>

#include "subdivision/leaf.h"
#include "subdivision/loops.h"
#include "subdivision/statistics.h"

namespace starcell {

/// The certified direction; none if a solid bounds E with both of its sides, or no direction is found.
std::optional<Vec3> star_direction(const Restriction& restriction, const CellProblem& problem, Statistics& statistics);

/// Does every loop bound a disk of its own, seen along the direction? Certified.
bool all_outer(const std::vector<const Loop*>& loops, const Vec3& direction);

/// The crossings of each loop of the leaf's arcs, if every loop is certified to bound a disk.
std::optional<std::vector<std::vector<Crossing>>> star_loops(const Leaf& leaf, const Vec3& direction);

}  // namespace starcell
