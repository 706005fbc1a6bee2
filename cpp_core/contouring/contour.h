// From certified leaves to a mesh: loops over the minimal faces' arcs, one fan a loop (DESIGN §3, contouring).
//
// Guarantees: closed and manifold, because every arc of a minimal face is used once from each side; each lone fan is
// embedded in its cell; several fans in one cell are tested exactly against each other, in double and in float32.
// Leaves for which this fails, or whose fans miss the error, are named; the caller refines them and calls again.
#pragma once

#include <functional>

#include "contouring/relaxed_cells.h"
#include "contouring/surface_mesh.h"
#include "subdivision/octree.h"

namespace starcell {

struct ContourSettings {
  double error = 0;
  double pull = 0;
  RelaxedCells relaxed;
  std::function<void()> poll;   ///< called now and then; throws to stop
};

struct Contour {
  SurfaceMesh mesh;
  double bound = 0;              ///< H(A, E) over all fans
  std::vector<Cell> failed;      ///< leaves that have to be refined
};

Contour contour(const Restriction& restriction, const Octree& tree, const ContourSettings& settings);

}  // namespace starcell
