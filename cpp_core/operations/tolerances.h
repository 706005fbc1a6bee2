// How the error that was asked for is shared out: the operands' own deflection first, the rest is the cells'.
#pragma once

#include "numerics/vector.h"
#include "operations/options.h"

namespace starcell {

struct Tolerances {
  double error;     ///< asked for, in all
  double contact;
  double inputs;    ///< largest deflection of an operand, and what double arithmetic loses on its coordinates
  double cells;     ///< what contouring may deviate
};

/// The error asked for, or, if none was, the longest side of the result's box / 128; of nothing it is 1, as any.
double error_for(const Options& options, const Box3& box);

/// `box`: of the result. Throws std::invalid_argument if the error leaves nothing for the cells.
/// `deflection`: the largest by which an operand may be off.
Tolerances split_error(const Options& options, const Box3& box, double deflection);

}  // namespace starcell
