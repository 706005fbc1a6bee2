// Two discs of triangles with one rim, seen along a direction: is the second a graph over what the first covers?
#pragma once

#include <vector>

#include "isotopy/triangle_cover.h"

namespace starcell {

/// The discs have the same rim, the second is a fan about its triangles' first corner, which may be on the rim. True if the fan projects injectively along the unit
/// vector `along`, and the first disc's shadow is within the fan's. (The first may fold over: having the same rim it covers all of the fan's
/// shadow, once or more.) Then both are discs in the cylinder over that shadow, with one boundary on its side: an isotopy of the cylinder
/// takes one to the other.
bool is_graph_over(const std::vector<Corners>& before, const std::vector<Corners>& fan, const Vec3& along);

/// Along the mean normal of the first disc, or a direction that the fan faces.
bool is_graph_over(const std::vector<Corners>& before, const std::vector<Corners>& fan);

}  // namespace starcell
