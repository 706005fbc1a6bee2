// Two triangles of one mesh: do they meet anywhere but in the vertices and the edge that they share?
#pragma once

#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

/// Exact. Both must have an area; with three shared vertices (a doubled facet) the answer is false, because the
/// count of doubled facets reports it.
bool meet_outside_shared(const std::vector<Vec3>& vertices, const Triangle& s, const Triangle& t);

/// Are the three points on one line? Exact.
bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace starcell
