// Components, genus and Euler characteristic of a closed triangle mesh, counted on the mesh itself.
#pragma once

#include "certificate/certificate.h"
#include "solids/polyhedron.h"

namespace starcell {

/// Fills components, genus (largest volume first) and euler_characteristic.
void count_topology(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, Certificate& certificate);

}  // namespace starcell
