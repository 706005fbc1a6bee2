// The Boolean problem inside one cell: the facets that meet it, the expression that is left, and the membership of its
// lower corner in every solid that is left.
//
// Rests on T§3.10 (cell culling, expression simplification), top down: a child's problem is made from its parent's and
// nothing is ever searched for globally. Guarantees: `facets` are exactly the facets of the remaining solids that meet
// the (perturbed) cell, ascending, hence grouped by solid in slot order; a region remains where its function is not
// certain of one sign in the cell.
#pragma once

#include <atomic>
#include <optional>

#include "expression/local_expression.h"
#include "subdivision/facets.h"
#include "subdivision/grid.h"

namespace starcell {

struct CellProblem {
  Cell cell;
  std::vector<std::uint32_t> facets;
  LocalExpression expression;
  std::vector<char> at_lower;   ///< per slot: is the lower corner inside that solid; of candidate solids not kept
  std::vector<SmoothSurfacePtr> forms;   ///< per slot: a region's surface as restricted to the cell; null, or empty: the table's

  std::size_t slots() const { return expression.solids().size(); }
  bool empty(const FacetTable& table) const { return facets.empty() && !has_regions(table); }
  /// Regions come after polyhedra.
  bool has_regions(const FacetTable& table) const { return !expression.solids().empty() && table.is_region(expression.solids().back()); }
  /// Slots of solids whose facets are candidates; of more slots than a membership has bits the first.
  Membership candidates(const FacetTable& table) const;
};

class Restriction {
 public:
  Restriction(const FacetTable& table, const Grid& grid);

  const FacetTable& table() const { return table_; }
  const Grid& grid() const { return grid_; }

  /// The whole problem. The root cell must contain the expression's solid in its interior.
  CellProblem root(const LocalExpression& expression) const;

  /// The eight children's problems, simplified.
  std::array<CellProblem, 8> children(const CellProblem& parent) const;

  /// Membership of a grid point of the cell (a corner of the cell or on its boundary or inside), per slot.
  std::vector<char> membership_at(const CellProblem& problem, const GridPoint& p) const;
  Membership mask_at(const CellProblem& problem, const GridPoint& p) const;

  /// Membership per slot of a point inside the cell that is farther than `margin` from every facet of the cell but those
  /// for which `skip` is true; skipped facets do not count, nor do candidate solids. None if this cannot be certified for this point.
  template <class Skip>
  std::optional<Membership> mask_near(const CellProblem& problem, const Vec3& x, double margin, Skip skip) const;

  /// A region's surface as the cell has it; null: a plane.
  const SmoothSurface* form_of(const CellProblem& problem, std::size_t slot) const;
  /// Is the point inside the candidate solid? None: that is uncertain.
  std::optional<bool> candidate_contains(const CellProblem& problem, std::size_t slot, const Vec3& x) const;
  /// Did a grid point lie on a region's or a candidate solid's surface, as far as can be told? Another grid has to be tried.
  bool grid_grazes() const { return grazes_.load(std::memory_order_relaxed); }

  /// The slot of a facet of the problem.
  std::uint32_t slot_of(const CellProblem& problem, std::uint32_t facet) const;

 private:
  void simplify(CellProblem& problem) const;
  void restrict_forms(CellProblem& problem, const CellProblem* parent, const Box3& box) const;
  Expansion expand(const CellProblem& problem, std::size_t slot, const Vec3& center, const Vec3& reach) const;
  /// Is the point inside the region? Where that is not certain the grid is said to graze.
  bool region_contains(const CellProblem& problem, std::size_t slot, const Vec3& x) const;
  /// Whether a candidate solid holds all of a box, or nothing of it, for certain. `any`: does any of its facets meet it?
  State candidate_state(const CellProblem& problem, std::size_t slot, const Box3& box, bool any) const;
  /// Is the grid point inside the candidate solid? Where that is not certain the grid is said to graze.
  bool candidate_at(const CellProblem& problem, std::size_t slot, const Vec3& x) const;
  /// What is known of a region in a box.
  State region_state(const CellProblem& problem, std::size_t slot, const Box3& box) const;
  /// 1 if the segment from the grid point p to x crosses the facet, 0 if not, -1 if that is degenerate.
  int segment_crosses_facet(std::uint32_t facet, const Vec3& p, const Vec3& x) const;
  /// Is x certainly farther than margin from the facet's plane, or from the facet?
  bool clear_of(std::uint32_t facet, const Vec3& x, double margin) const;

  const FacetTable& table_;
  const Grid& grid_;
  const std::uint64_t name_;   // no other restriction has had it
  mutable std::atomic<bool> grazes_{false};
};

template <class Skip>
std::optional<Membership> Restriction::mask_near(const CellProblem& problem, const Vec3& x, double margin,
                                                 Skip skip) const {
  const Vec3 corner = grid_.point(problem.cell.lower);
  Membership mask = 0;
  const Membership candidates = problem.candidates(table_);
  for (std::size_t slot = 0; slot < problem.slots(); ++slot)
    if (problem.at_lower[slot] && !(candidates >> slot & 1)) mask |= Membership{1} << slot;
  for (const std::uint32_t facet : problem.facets) {
    if (skip(facet) || (candidates >> slot_of(problem, facet) & 1)) continue;
    if (!clear_of(facet, x, margin)) return std::nullopt;
    const int crosses = segment_crosses_facet(facet, corner, x);
    if (crosses < 0) return std::nullopt;
    if (crosses) mask ^= Membership{1} << slot_of(problem, facet);
  }
  return mask;
}

}  // namespace starcell
