// The checks on a map's matrix. The determinant's sign is CGAL's filtered exact predicate, so that a small but
// regular scaling (1e-6 cubed is 1e-18) is told from a singular matrix without a tolerance.
#include "solids/affine_map.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <stdexcept>

namespace starcell {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

CGAL::Orientation determinant_sign(const Eigen::Matrix4d& m) {
  const auto row = [&](int i) { return Kernel::Vector_3(m(i, 0), m(i, 1), m(i, 2)); };
  return CGAL::orientation(row(0), row(1), row(2));
}

}  // namespace

void require_affine(const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite()) throw std::invalid_argument("matrix must be finite");
  if (matrix(3, 0) != 0 || matrix(3, 1) != 0 || matrix(3, 2) != 0 || matrix(3, 3) != 1)
    throw std::invalid_argument("matrix must be affine: its last row must be (0, 0, 0, 1)");
  if (determinant_sign(matrix) == CGAL::ZERO) throw std::invalid_argument("matrix must not be singular");
}

bool reverses_orientation(const Eigen::Matrix4d& matrix) { return determinant_sign(matrix) == CGAL::NEGATIVE; }

}  // namespace starcell
