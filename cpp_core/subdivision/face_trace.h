// The trace of E on one face of a cell: which test applies, and F-split where none does.
//
// Rests on DESIGN §3: F-link where one solid reaches the face, F-planes where several do, F-cone where their lines are
// concurrent, and otherwise F-split: the face alone is quartered and the squares' arcs are joined (as T§5.6.3 refines
// faces for connectors).
#pragma once

#include <optional>

#include "subdivision/cell_problem.h"
#include "subdivision/local_planes.h"
#include "subdivision/statistics.h"
#include "subdivision/trace.h"

namespace starcell {

/// Arcs and closed curves of E on the face, or none: "don't know". `facets` ascending, of the problem.
std::optional<std::vector<Arc>> trace_face(const Restriction& restriction, const CellProblem& problem,
                                           const std::vector<std::uint32_t>& facets, const Face& face, double pull,
                                           const LocalPlanes& planes, Statistics& statistics);

}  // namespace starcell
