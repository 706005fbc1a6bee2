// Planes that are one plane as far as a cell can tell.
//
// Files with few digits leave facets of one flat side at angles of 1e-9 to 1e-6. Where another solid cuts the seam between
// two of them, the line that their planes have in common is uncertain at every cell size, and nothing depends on it: in the
// cell both lie in a slab far thinner than the cell. Such neighbours are taken as one plane whose normal and offset are
// intervals that enclose them all, so that every certified sign holds for each.
#pragma once

#include "numerics/interval.h"
#include "subdivision/cell_problem.h"

namespace starcell {

/// Which surfaces stand for others in a cell; empty where every surface stands for itself.
class LocalPlanes {
 public:
  LocalPlanes() = default;
  /// Joins surfaces of facets that are neighbours in the mesh and deviate from each other by less than a hundred-thousandth
  /// of the cell.
  LocalPlanes(const FacetTable& table, const std::vector<std::uint32_t>& facets, const Box3& box);

  bool empty() const { return joined_.empty(); }
  std::uint32_t of(std::uint32_t surface) const;
  /// Does it stand for nothing but itself?
  bool alone(std::uint32_t surface) const;

  /// The plane n . (p - origin) = d that encloses a surface and all that it stands for. Needs a Rounding scope.
  void enclose(const FacetTable& table, std::uint32_t surface, const Vec3& origin, Interval (&n)[3], Interval& d) const;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joined_;   // (surface, the one that stands for it), ascending
};

}  // namespace starcell
