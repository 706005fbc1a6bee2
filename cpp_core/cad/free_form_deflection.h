// The distance between a free-form face and its triangles, in both directions, by samples (deflection.h).
#pragma once

#include <vector>

#include "cad/face_meshes.h"
#include "numerics/vector.h"

namespace starcell::cad {

/// `node_vertices[i]` is the index in `vertices` of the face's node i (from 0). Infinite if the triangulation carries
/// no parameters to measure at.
double free_form_deflection(const FaceMesh& face, const std::vector<std::uint32_t>& node_vertices,
                            const std::vector<Vec3>& vertices);

}  // namespace starcell::cad
