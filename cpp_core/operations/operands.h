// An expression's solids in a list, and the expression as the cells use it.
#pragma once

#include "expression/expression.h"
#include "expression/local_expression.h"

namespace starcell {

struct Operands {
  std::vector<PolyhedronPtr> solids;   ///< each once, however often it occurs
  LocalExpression expression;
};

/// Half-spaces become large boxes that agree with them inside `box`.
Operands gather_operands(const Expression& expression, const Box3& box);

}  // namespace starcell
