// The patches of a cell: the surfaces that bound the remaining solids there, each met by whatever lies on it, and the
// expression as a function of the sides of patches that a point is on.
//
// A region contributes its surface. A polyhedron contributes its facets' planes, where it is locally one half-space, the
// intersection of several (all its facets in the cell behind each other's planes) or their union (all before): then its
// membership in the cell is read off the planes' signs. Surface identity (DESIGN §4) makes one patch of what is shared, so
// all solids on it flip together.
// Guarantees: for every point of the cell, value(sides of the patches) is the membership in the expression, solids taken as
// moved by their surfaces' thickness.
#pragma once

#include <optional>

#include "subdivision/cell_problem.h"

namespace starcell {

/// Bit k: the point is on the negative side of patch k, F < 0.
using Sides = std::uint32_t;
constexpr std::size_t max_patches = 12;

class Patches {
 public:
  /// None where a polyhedron is more than planes can say, or there are too many.
  static std::optional<Patches> of(const Restriction& restriction, const CellProblem& problem);

  std::size_t size() const { return surfaces_.size(); }
  std::uint32_t surface(std::size_t k) const { return surfaces_[k]; }
  /// max_patches if the surface is none of them.
  std::size_t index_of(std::uint32_t surface) const;
  bool value(Sides sides) const;

 private:
  /// A solid: on the given sides of all (or, `any`, of any) of its patches.
  struct Form {
    bool any = false;
    std::vector<std::pair<std::size_t, bool>> patches;   ///< (patch, positive side)
  };

  std::size_t add(std::uint32_t surface);
  bool add_polyhedron(const FacetTable& table, const std::uint32_t* first, const std::uint32_t* last);

  const LocalExpression* expression_ = nullptr;
  std::vector<std::uint32_t> surfaces_;
  std::vector<Form> forms_;   // per slot
};

}  // namespace starcell
