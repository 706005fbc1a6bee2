// A flat region, triangulated from its rim: no vertex is added.
#pragma once

#include <optional>
#include <utility>

#include "solids/polyhedron.h"

namespace starcell {

/// From a vertex to the next, the region on the left seen from outside.
using RimEdge = std::pair<std::uint32_t, std::uint32_t>;

/// The region may have holes and several parts. None if rim edges meet outside their ends (seen along the axis nearest to the
/// region's normal), which rounding can bring about where the region is thin.
std::optional<std::vector<Triangle>> triangulate_flat(const std::vector<Vec3>& vertices, const std::vector<RimEdge>& rim);

}  // namespace starcell
