// The solid that triangles mean: the boundary of {winding number >= 1}, of meshes that cross themselves, overlap, are doubled or turned, or have small holes.
//
// The triangles are closed first (repair/closed_soup.h). Pieces that are sound by themselves, with their cavities, are polyhedra, and the solid is
// their union; otherwise all of it is one candidate solid (repair/winding_solid.h), contoured as any other.
// Guarantees: the certificate's, about the closed triangles' {winding number >= 1}; what was closed, turned or dropped is listed in `findings`.
// Refuses what has no inside.
#pragma once

#include <optional>

#include "operations/boolean.h"
#include "repair/closed_soup.h"

namespace starcell {

struct Repaired {
  Result result;
  std::vector<Flaw> findings;
  std::optional<Expression> solids;   ///< what the result is the boundary of, if all pieces are sound
};

/// Holes up to ten errors wide are filled. `options.error`: none: longest side / 128. Throws as evaluate() and close().
Repaired repair(std::vector<Vec3> vertices, std::vector<Triangle> triangles, const Options& options);

}  // namespace starcell
