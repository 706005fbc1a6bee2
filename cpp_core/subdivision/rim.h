// Where E crosses the sides of a square: certified, in order (DESIGN §2, `crossings(edge)`).
//
// Facets cross a grid line by exact 2D tests, where their surface's plane does; regions' surfaces by isolated roots: a stretch
// of the line where the derivative has one certain sign holds a root exactly if its ends have different signs, other stretches
// are bisected. All solids on a surface flip together.
// Guarantees: the flips are those of the expression around the square, in their true order; or none ("don't know").
#pragma once

#include <optional>

#include "subdivision/cell_problem.h"
#include "subdivision/trace.h"

namespace starcell {

/// A place on the rim where membership in the expression changes, walking counter-clockwise seen from +axis.
struct Flip {
  Crossing crossing;
  double low = 0, high = 0;   ///< encloses the place along the crossing's axis
  bool enters = false;
  int side = 0;               ///< 0: b low, 1: b high, 2: c low, 3: c high
};

/// The flips along grid lines of one cell, found once for both faces beside each of its edges.
class RimLines {
 public:
  RimLines(const Restriction& restriction, const CellProblem& problem) : restriction_(restriction), problem_(problem) {}

  /// All flips around the square, beginning at its lower corner. `certain` false: the best guess instead of none.
  std::optional<std::vector<Flip>> around(const Face& face, bool certain = true);

 private:
  struct Line {
    int axis;
    GridPoint from;
    std::uint32_t size;
    bool sure;                 ///< the flips are certain
    std::vector<Flip> flips;   ///< in ascending order
  };
  const Line& line(int axis, const GridPoint& from, std::uint32_t size);

  const Restriction& restriction_;
  const CellProblem& problem_;
  std::vector<Line> lines_;
};

}  // namespace starcell
