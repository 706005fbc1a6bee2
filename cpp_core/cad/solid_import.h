// One CAD solid to one polyhedron within a budget: mesh, stitch, measure, validate, and finer again where needed.
//
// Rests on face_meshes, face_refinement, stitching, deflection. A mesh whose faces cut each other because it is too
// coarse, or that is farther from the solid than error / 2, is made anew at a finer length and angle, a few times.
// Guarantees: the polyhedron is valid and its measured deflection at most error / 2; the attempts depend on nothing
// but the solid and the error. Throws InvalidSolidError with the last reason otherwise.
#pragma once

#include "cad/solid_parts.h"
#include "solids/polyhedron.h"

namespace starcell::cad {

PolyhedronPtr import_solid(const SolidPart& part, double error);

}  // namespace starcell::cad
