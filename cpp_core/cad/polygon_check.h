// Whether a flat face's boundary is one that a CAD kernel accepts: no two of its segments closer than a distance, but at
// common corners. A sweep along one axis: for faces with very many holes, where OpenCASCADE compares each with each other.
//
// Guarantees: true only if all segments, seen along the normal, keep that distance, and those with a common corner part there
// by more than it. As the face is a connected region of an embedded surface, its holes then lie inside its outer loop.
#pragma once

#include "cad/planar_faces.h"

namespace starcell::cad {

bool is_simple(const PlanarFace& face, const std::vector<Vec3>& vertices, double clearance);

}  // namespace starcell::cad
