// Bit-identical vertices become one vertex: what turns a triangle soup (every STL file) into a mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

/// Welds vertices of equal coordinates (-0.0 equals 0.0 and is stored as 0.0), removes triangles that then repeat a
/// vertex, and removes vertices that no triangle uses. What stays keeps its order; a welded vertex stands where its
/// first copy stood. `labels` (one a triangle, or empty) follow their triangles. Indices must be in range.
/// Returns how many triangles were removed. Nothing is moved: vertices however close stay apart.
std::size_t weld(std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, std::vector<std::int32_t>& labels);

}  // namespace starcell
