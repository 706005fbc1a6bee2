// Arcs for a face that no test could certify: what an unresolved cell is closed with.
//
// The face's edges are crossed where parity says so; around the face every inside stretch is cut off by an arc of its
// own. Guarantees: arcs that do not cross, the same from both sides of the face, so the mesh closes up. Does not
// guarantee: that E's arcs pair the crossings in this way. Only for leaves that are listed as unresolved.
#pragma once

#include "subdivision/cell_problem.h"
#include "subdivision/trace.h"

namespace starcell {

std::vector<Arc> force_face(const Restriction& restriction, const CellProblem& problem, const Face& face);

}  // namespace starcell
