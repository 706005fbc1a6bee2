#include "operations/tolerances.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace starcell {

double error_for(const Options& options, const Box3& box) {
  const double length = longest_side(box);
  return options.error.value_or(length > 0 ? length / 128 : 1);
}

Tolerances split_error(const Options& options, const Box3& box, double deflection) {
  Tolerances t;
  const double length = longest_side(box);   // 0 where nothing is left
  t.error = error_for(options, box);
  if (!(t.error > 0)) throw std::invalid_argument("error: must be greater than 0");
  t.contact = options.contact.value_or(std::isinf(t.error) ? length / 12800 : t.error / 100);
  if (!(t.contact > 0) || std::isinf(t.contact)) throw std::invalid_argument("contact: must be greater than 0 and finite");
  t.inputs = deflection;
  // Rounding of plane equations and of the apexes: far above what double arithmetic can lose on coordinates this large.
  const double rounding = box.isEmpty() ? 0.0 : 4e-12 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  t.inputs += rounding;
  t.cells = (1 - options.kept) * (t.error - t.inputs);
  if (!(t.cells > 0))
    throw std::invalid_argument("error: " + std::to_string(t.error) + " is not larger than the deflection of a tessellated operand, " +
                                std::to_string(t.inputs) + "; read that operand with a smaller error");
  return t;
}

}  // namespace starcell
