// The same solid in fewer triangles (T§3.12.2): its mesh, decimated (decimation/decimate.h).
//
// Guarantees: the certificate's, as changed_mesh.h says. Does not guarantee: the fewest triangles possible.
#pragma once

#include "operations/boolean.h"

namespace starcell {

/// Throws as evaluate().
Result simplify(const Expression& solid, const Options& options);

}  // namespace starcell
