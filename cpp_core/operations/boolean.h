// The Boolean: the boundary of an expression over solids as a certified mesh (T§3).
#pragma once

#include "certificate/certificate.h"
#include "expression/expression.h"
#include "operations/options.h"

namespace starcell {

struct Result {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  Certificate certificate;
};

/// Throws UnboundedError, CancelledError, std::invalid_argument (names the option).
Result evaluate(const Expression& expression, const Options& options);

}  // namespace starcell
