// What a 4x4 matrix must be to move a solid: finite, affine, regular. The sign of its determinant is exact.
#pragma once

#include "numerics/vector.h"

namespace starcell {

/// Throws std::invalid_argument, naming "matrix", unless every entry is finite, the last row is (0, 0, 0, 1) and the
/// linear part is regular (exactly: a nearly singular one passes).
void require_affine(const Eigen::Matrix4d& matrix);

/// Is the determinant of the linear part negative? Exact.
bool reverses_orientation(const Eigen::Matrix4d& matrix);

}  // namespace starcell
