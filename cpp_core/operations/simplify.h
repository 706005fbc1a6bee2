// The same solid in fewer triangles (T§3.12.2): its mesh, decimated (decimation/decimate.h).
//
// A mesh of more than 150,000 triangles is contoured first, if far fewer come of it: ten million then take less than 3 GiB, and no more seconds than
// they are read in.
// Guarantees: the certificate's, as changed_mesh.h says. Does not guarantee: the fewest triangles possible.
#pragma once

#include "operations/boolean.h"

namespace starcell {

/// Throws as evaluate().
Result simplify(const Expression& solid, const Options& options);

}  // namespace starcell
