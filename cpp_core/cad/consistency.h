// Whether a solid's faces, edges and vertices belong together: each edge's curve, and its image on each of its faces,
// must end near the edge's vertices. In a damaged file they do not, and OpenCASCADE's mesher may then run for ever.
// Generous on purpose (1 % of the solid's size, or ten times the stated tolerance): smaller gaps are measured later.
#pragma once

#include <TopoDS_Solid.hxx>
#include <string>

namespace starcell::cad {

/// The first contradiction as a sentence part; empty if there is none. `size` is the solid's diameter.
std::string inconsistency(const TopoDS_Solid& solid, double size);

}  // namespace starcell::cad
