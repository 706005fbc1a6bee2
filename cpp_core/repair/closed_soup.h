// Triangles as they come, made into a closed chain: so that every point off them has a whole winding number.
//
// Bit-identical vertices become one, triangles that repeat a corner go. If edges do not run as often one way as the other, neighbours across edges of
// two triangles are turned the same way, as most of their piece are; what is then still open is holes, and those no wider than asked for are
// filled. A closed piece that is inside out, and in nothing else, is turned round. Guarantees: every edge of the result runs as often one way as the
// other; vertices stay where they are; every change is listed with its place. Does not guarantee manifolds, nor that nothing crosses.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

/// What was wrong, in a word or two, and where.
using Flaw = std::pair<std::string, Box3>;

struct ClosedSoup {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> piece;   ///< per triangle: which are joined by edges have one number
  std::uint32_t pieces = 0;
  std::vector<Flaw> findings;
};

/// Throws InvalidSolidError if there is nothing with an inside: no triangles, coordinates that are not finite, or holes wider than `widest`, with the
/// number of holes, the widest and its place; std::invalid_argument for an index out of range.
ClosedSoup close(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double widest);

}  // namespace starcell
