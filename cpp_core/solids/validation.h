// Is a triangle mesh the boundary of a solid? Everything Polyhedron promises, checked, and orientation put right.
#pragma once

#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

/// Turns triangles round so that normals point outward, and returns the neighbours. Vertices must be welded and
/// triangles have three different vertices; `degenerate` is how many were removed because they had not.
/// Throws InvalidSolidError with the counts and first places of every kind of defect.
std::vector<Triangle> validate(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, std::size_t degenerate);

/// What an affine map of a valid mesh can break: coordinates may overflow, facets may meet or lose their area, and the
/// outside may become the inside. Turns the triangles and their neighbours round together.
void validate_image(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, std::vector<Triangle>& neighbours);

}  // namespace starcell
