// An expression's solids in a list, and the expression as the cells use it.
#pragma once

#include "expression/expression.h"
#include "expression/local_expression.h"
#include "subdivision/facets.h"

namespace starcell {

struct Operands {
  std::vector<PolyhedronPtr> solids;   ///< each once, however often it occurs
  std::vector<CandidateSolidPtr> candidates;   ///< sums and what triangles wind about; they come after all polyhedra
  std::vector<RegionOperand> regions;   ///< those of curved solids; they come last
  LocalExpression expression;

  /// The polyhedra that offsets and sums are of.
  std::vector<PolyhedronPtr> sources;

  /// Per sum: which two of the sources it is made of.
  std::vector<std::pair<std::size_t, std::size_t>> summands;

  std::size_t size() const { return solids.size() + candidates.size() + regions.size(); }
};

/// The largest distance by which an operand may be off what it stands for; those of a sum's operands add up.
double deflection_of(const Operands& operands);

/// Curved solids become intersections of regions, half-spaces large boxes that agree with them inside `box`.
Operands gather_operands(const Expression& expression, const Box3& box);

}  // namespace starcell
