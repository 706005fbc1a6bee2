// The matching of two discs of triangles with one rim, by projection along a direction: how far apart it finds their points.
#pragma once

#include <optional>
#include <vector>

#include "numerics/vector.h"

namespace starcell {

/// A triangle, and how far its points are already from where they came from.
struct MovedTriangle {
  std::array<Vec3, 3> corners;
  double moved = 0;
};

/// Both discs have the same rim, the second is a fan about its triangles' first corner. For each triangle of the second: a bound of
/// how far its points are from where those of the first came from, matched along the unit vector `along`. Nothing if the fan does not
/// project injectively, or if the first disc's shadow leaves the fan's. (The first may fold over: having the same rim it covers all of
/// the fan's shadow, once or more.)
std::optional<std::vector<double>> match(const std::vector<MovedTriangle>& before, const std::vector<std::array<Vec3, 3>>& fan, const Vec3& along);

}  // namespace starcell
