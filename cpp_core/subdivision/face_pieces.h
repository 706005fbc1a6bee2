// The facets of a cell cut by a face's plane and clipped to the face: straight pieces whose ends are known exactly.
//
// Every end is either a crossing of one of the face's edges or a mesh edge that pierces the face. Which of them is inside
// is decided by 2D orientations on original vertices; nothing is constructed to decide it.
#pragma once

#include <array>
#include <vector>

#include "subdivision/cell_problem.h"
#include "subdivision/trace.h"

namespace starcell {

struct PieceEnd {
  int side = -1;                  ///< 0: b low, 1: b high, 2: c low, 3: c high; -1: a mesh edge ends the piece inside the face
  Crossing crossing;              ///< side >= 0
  std::uint32_t neighbour = 0;    ///< side < 0: the facet on the other side of the mesh edge
};

/// Directed with the facet's own solid on the right, seen from +axis.
struct Piece {
  std::uint32_t facet = 0;
  std::uint32_t surface = 0;
  std::uint32_t slot = 0;
  PieceEnd from, to;
};

/// Pieces of the given facets (ascending) inside the face.
std::vector<Piece> face_pieces(const Restriction& restriction, const CellProblem& problem,
                               const std::vector<std::uint32_t>& facets, const Face& face);

/// The crossing of a surface with one side of a face (0: b low, 1: b high, 2: c low, 3: c high).
Crossing side_crossing(const FacetTable& table, const Grid& grid, const Face& face, int side, std::uint32_t surface);

/// Where the mesh edge common to a facet and its neighbour pierces the face's plane, clamped to the face.
Vec3 pierce_point(const Restriction& restriction, const Face& face, std::uint32_t facet, std::uint32_t neighbour);

}  // namespace starcell
