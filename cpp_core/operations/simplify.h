// The same solid in fewer triangles (T§3.12.2).
//
// A mesh is decimated (decimation/decimate.h); any other solid is contoured first, within a share of the error.
// Guarantees: the certificate's: same topology, embedded, also in float32, and the two-sided distance from the solid is at most error_bound.
// Does not guarantee: the fewest triangles possible.
#pragma once

#include "operations/boolean.h"

namespace starcell {

/// Throws as evaluate().
Result simplify(const Expression& solid, const Options& options);

}  // namespace starcell
