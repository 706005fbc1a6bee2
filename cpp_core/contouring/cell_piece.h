// What A has in one cell: a fan, or flat parts, over each loop that the drawn arcs form on the cell's boundary.
//
// Guarantees: every rim edge of the piece is a segment of a drawn arc, used once; each lone fan is embedded in its cell;
// several fans in one cell are tested exactly against each other, in double and, where cells are large enough for it, in
// float32. `good` says that this and the error hold; if not, the piece still closes the mesh wherever its loops exist.
#pragma once

#include "contouring/minimal_faces.h"
#include "contouring/surface_mesh.h"
#include "contouring/trace_points.h"

namespace starcell {

/// A minimal face around the cell, as it was drawn.
struct DrawnFace {
  MinimalFace face;
  const TracedFace* traced;
};

struct CellPiece {
  std::vector<std::uint32_t> rim;   ///< ids of the vertices on the cell's boundary
  std::vector<Vec3> inner;          ///< vertices inside the cell
  std::vector<Triangle> triangles;  ///< k < rim.size() stands for rim[k], others for inner[k - rim.size()]
  std::vector<std::uint32_t> surface;
  double bound = 0;                 ///< two-sided Hausdorff distance to E in the cell
  bool good = false;
};

struct PieceSettings {
  double error = 0;
  double margin = 0;    ///< how far inside the cell its inner vertices stay
  double pull = 0;      ///< how far a contact's apex is moved off it
  bool floats = true;   ///< is the cell large enough for float32 to be tested here
};

/// Safe to call in parallel.
CellPiece make_piece(const Restriction& restriction, const Leaf& leaf, const std::vector<DrawnFace>& faces, const TracePoints& points,
                     const PieceSettings& settings);

}  // namespace starcell
