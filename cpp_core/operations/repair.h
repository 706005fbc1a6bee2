// The solid that triangles mean: the boundary of {winding number >= 1}, of meshes that cross themselves, overlap, are doubled or turned, or have small holes.
//
// The triangles are closed first (repair/closed_soup.h), and cut where they cross, exactly (repair/exact_arrangement.h); what is left of them is the mesh,
// as it is, pulled apart where it touches itself (repair/pulled_apart.h: a contact). Where rounding leaves needles that do not survive float32, it
// is decimated; where it does not survive at all, pieces that are sound by themselves are united as in any Boolean, and others are a candidate solid
// (repair/winding_solid.h), contoured.
// Guarantees: the certificate's, about the closed triangles' {winding number >= 1}; what was closed, turned or dropped is listed in `findings`.
// Refuses what has no inside. Does not guarantee: that rounding the cuts' new points to double is an isotopy; before and after, the mesh is embedded and
// has the same triangles.
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
