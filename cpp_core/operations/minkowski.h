// Minkowski sums, and morphology with any solid (T§1.2, T§4.1).
//
// A ball as one of the operands makes it an offset (operations/offset.h), exact without any tessellation. Otherwise both become
// polyhedra, curved ones by a certified mesh within a share of the error each, and the result is one solid known by candidates
// (minkowski/sum_solid.h). Guarantees: the certificate's, about the sum of the operands as named there; it commutes and follows
// translations, the origin may be anywhere.
#pragma once

#include "operations/offset.h"

namespace starcell {

/// {a + b : a in A, b in B}. Throws as evaluate().
Prepared prepare_minkowski_sum(const Expression& a, const Expression& b, const Options& options);
/// {x : x + B is part of A}: where B fits into A.
Prepared prepare_erosion(const Expression& a, const Expression& b, const Options& options);
/// Erosion and dilation by B: all that B covers where it fits into A; or, closing, dilation and erosion.
Prepared prepare_opening(const Expression& a, const Expression& b, const Options& options);
Prepared prepare_closing(const Expression& a, const Expression& b, const Options& options);

}  // namespace starcell
