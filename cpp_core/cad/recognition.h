// CAD solids that are one ball, round cylinder, cone, frustum or ring torus: as such, with nothing tessellated.
//
// Decided by the boundary: all curved faces lie on one surface S, all others on planes across its axis, and every edge either
// lies between two faces of the same surface or is the circle in which S meets an end plane. Then the faces on S cover all of
// S between the ends, and those on a plane its whole disk; the volume, compared with the closed form, rules out that anything
// is covered twice. How the faces are split (seams, halves) does not matter.
// Guarantees: what it returns differs from the CAD shape by no more than the shape's own stated tolerances, at most 1e-6 of
// its size, and its surfaces by 1e-9 of it. As for polyhedra, a solid that is inside out is taken right side out.
// Does not guarantee: that every such solid is recognised; what is not, or is damaged, is left to the tessellation.
#pragma once

#include <TopoDS_Solid.hxx>

#include "solids/curved_solid.h"

namespace starcell::cad {

/// Null if the solid is something else. Throws nothing of OpenCASCADE's.
CurvedSolidPtr recognise(const TopoDS_Solid& solid);

}  // namespace starcell::cad
