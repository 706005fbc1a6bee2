// An axis-parallel box as a polyhedron of twelve triangles.
#pragma once

#include "solids/polyhedron.h"

namespace starcell {

/// Throws std::invalid_argument unless lower < upper in every coordinate and all are finite.
PolyhedronPtr make_box(const Vec3& lower, const Vec3& upper);

}  // namespace starcell
