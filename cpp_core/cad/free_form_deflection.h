// The distance between a free-form face and its triangles, in both directions, by samples (deflection.h).
#pragma once

#include <BRepAdaptor_Surface.hxx>
#include <array>
#include <gp_XY.hxx>
#include <vector>

#include "cad/face_meshes.h"
#include "numerics/vector.h"

namespace starcell::cad {

struct SurfacePoint {
  Vec3 point;
  gp_XY parameter;
};

/// The largest sample of one triangle, no margin added, or `at_least` if all are smaller.
double triangle_deflection(const std::array<SurfacePoint, 3>& triangle, const BRepAdaptor_Surface& surface, double at_least);

/// `node_vertices[i]` is the index in `vertices` of the face's node i (from 0). Infinite if the triangulation carries
/// no parameters to measure at.
double free_form_deflection(const FaceMesh& face, const std::vector<std::uint32_t>& node_vertices,
                            const std::vector<Vec3>& vertices);

}  // namespace starcell::cad
