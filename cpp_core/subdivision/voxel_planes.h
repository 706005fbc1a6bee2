// V-planes: E in a cell that few supporting planes cut, solids crossing or in contact included.
//
// Rests on DESIGN §3 (V-planes) and §4 (surface identity): the planes cut the cell into convex regions on which every
// solid is constant; E∩C is the set of polygons between regions that differ. All facets of one surface flip together.
// The polygons are split with certified signs (interval arithmetic on three-plane points); their gluing is combinatorics.
// Guarantees: the sheets are exactly E∩C's components, or "don't know". A sheet that is no disk (the walls of a tunnel through the
// cell, a plane with a hole) is given by its polygons, which are E itself, so that no criterion of disks is needed. Where four polygons
// meet along an edge, or several sheets in a vertex, DESIGN §4's rule separates them: inside joins only across a face.
#pragma once

#include <optional>

#include "subdivision/leaf.h"
#include "subdivision/local_planes.h"

namespace starcell {

/// One component of E∩C: the surfaces that carry it, and how its boundary is recognised among the cell's loops.
struct PlaneSheet {
  std::vector<std::uint32_t> surfaces;   ///< ascending
  std::vector<Crossing> crossings;       ///< its crossings with the cell's edges; only line and surface are set
  std::vector<FlatPart> flats;           ///< the sheet itself; empty if a part touches itself
  bool contact = false;                  ///< touches another sheet in an edge or a vertex
  bool disk = true;                      ///< if not: connected, with some of the cell's loops for its boundary, and without contact
};

struct PlaneSheets {
  std::vector<PlaneSheet> sheets;
  bool touching = false;                 ///< two walls of one candidate solid meet on a plane, and E's part between them is not seen
};

constexpr std::size_t max_cell_planes = 16;

std::optional<PlaneSheets> plane_sheets(const Restriction& restriction, const CellProblem& problem,
                                        const LocalPlanes& local = LocalPlanes());

}  // namespace starcell
