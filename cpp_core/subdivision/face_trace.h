// The trace of E on one face of a cell: which test applies, and F-split where none does.
//
// Rests on DESIGN §3: F-link where one polyhedron reaches the face, F-planes where several do or candidates, F-cone where their lines are
// concurrent, F-star where candidates are many, and otherwise F-split: the face alone is quartered and the squares' arcs are joined (as T§5.6.3 refines
// faces for connectors).
#pragma once

#include <optional>

#include "subdivision/cell_problem.h"
#include "subdivision/local_planes.h"
#include "subdivision/rim.h"
#include "subdivision/statistics.h"
#include "subdivision/trace.h"

namespace starcell {

struct TraceSettings {
  double pull = 0;    ///< how far sheets in contact are pulled apart
  double error = 0;   ///< what arcs may deviate at most; infinite: topology only
};

/// Arcs and closed curves of E on the face, or none: "don't know". `facets` ascending, of the problem; the rims are those of the cell's edges.
std::optional<std::vector<Arc>> trace_face(const Restriction& restriction, const CellProblem& problem,
                                           const std::vector<std::uint32_t>& facets, const Face& face, const TraceSettings& settings,
                                           const LocalPlanes& planes, RimLines& rims, Statistics& statistics);

}  // namespace starcell
