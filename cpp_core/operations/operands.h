// An expression's solids in a list, and the expression as the cells use it.
#pragma once

#include "expression/expression.h"
#include "expression/local_expression.h"
#include "subdivision/facets.h"

namespace starcell {

struct Operands {
  std::vector<PolyhedronPtr> solids;   ///< each once, however often it occurs
  std::vector<RegionOperand> regions;   ///< those of curved solids; they come after all polyhedra
  LocalExpression expression;

  /// The polyhedra that offsets are of.
  std::vector<PolyhedronPtr> sources;

  std::size_t size() const { return solids.size() + regions.size(); }
};

/// Curved solids become intersections of regions, half-spaces large boxes that agree with them inside `box`.
Operands gather_operands(const Expression& expression, const Box3& box);

}  // namespace starcell
