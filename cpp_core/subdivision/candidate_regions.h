// Membership in a cell's candidate solids, asked for once in every region.
//
// The planes of a cell's candidate facets cut it into regions on which membership is constant. A point whose sides of all these planes are
// certain names its region, so faces, edges and the voxel itself share what one of them has learned. Guarantees: the solid's own
// answers; a point of no certain region is asked for by itself.
#pragma once

#include <optional>
#include <unordered_map>

#include "subdivision/cell_problem.h"

namespace starcell {

class CandidateRegions {
 public:
  CandidateRegions(const FacetTable& table, const CellProblem& problem);

  bool are_of(const CellProblem& problem) const;

  /// Is x, a point of the cell, inside the solid of the slot? None: uncertain.
  std::optional<bool> contains(std::size_t slot, const Vec3& x);

 private:
  std::optional<std::uint64_t> region_of(const Vec3& x) const;

  const FacetTable& table_;
  const Cell cell_;
  const std::size_t facets_;
  std::vector<std::uint32_t> solids_;
  std::vector<std::uint32_t> surfaces_;   // ascending
  std::vector<std::unordered_map<std::uint64_t, bool>> known_;   // per slot
};

}  // namespace starcell
