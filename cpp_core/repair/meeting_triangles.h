// Which triangles of a soup meet outside the vertices and edges that they share, or are the same twice.
#pragma once

#include "solids/polyhedron.h"

namespace starcell {

/// Exact; pairs ascend. All triangles have an area. The search ends soon after `most` pairs: which they are then depends on the threads.
std::vector<std::pair<std::uint32_t, std::uint32_t>> meeting_triangles(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                                                       std::size_t most = SIZE_MAX);

}  // namespace starcell
