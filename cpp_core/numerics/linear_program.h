// The small linear programs behind the guard searches: few variables, up to some hundred rows. GLPK behind one call.
//
// Guarantees nothing: an answer is a hint, and whoever uses it verifies the witness with intervals (DESIGN §5).
#pragma once

#include <optional>
#include <vector>

#include "numerics/vector.h"

namespace starcell {

/// A vector u in the unit cube that maximises the smallest normals[i] . u; none if GLPK finds no positive value.
std::optional<Vec3> widest_direction(const std::vector<Vec3>& normals);

/// A point o in `box` that maximises the smallest of normals[i] . (points[i] - o); none if that is not positive.
std::optional<Vec3> deepest_point(const std::vector<Vec3>& normals, const std::vector<Vec3>& points, const Box3& box);

}  // namespace starcell
