// Do two triangles of a mesh keep apart while all vertices move straight from one place to another? (See float_gaps.h.)
#pragma once

#include "solids/polyhedron.h"

namespace starcell {

/// True only if it is proved; both must be apart (outside what they share) at the start and at the end.
bool stay_apart(const std::vector<Vec3>& start, const std::vector<Vec3>& end, const Triangle& s, const Triangle& t);

/// The unit normal along which t lies farthest beyond s, relative to what they share; zero if none separates them.
Vec3 separating_normal(const std::vector<Vec3>& vertices, const Triangle& s, const Triangle& t);

}  // namespace starcell
