// Inner points for a face whose triangles are still too far from it.
//
// OpenCASCADE's mesher controls the distance by passes of its own and at times gives up far above what was asked (60
// times, on a bent tube), or answers a finer request with ten times the triangles. Here edges inside the face are halved
// at the surface point over the middle of their parameters, each with both its triangles, or flipped where a triangle has
// no height, until the samples of free_form_deflection.h hold. Elementary surfaces are left as they are.
// Guarantees: the boundary's nodes keep their numbers and no boundary edge is split, so neighbours still fit; the same
// input gives the same output. Triangles cover the same parameters as before.
// Does not guarantee: success; what boundary chords cause is left to a finer resolution. Measuring comes afterwards.
#pragma once

#include "cad/face_meshes.h"

namespace starcell::cad {

/// Replaces face.triangulation where needed. `allowed`: distance that samples may reach.
void refine(FaceMesh& face, double allowed);

}  // namespace starcell::cad
