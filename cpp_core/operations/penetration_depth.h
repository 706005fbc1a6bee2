// How far one solid has to be moved to come free of another, and how far apart two solids are.
//
// Rests on T§4.3: B + v overlaps A exactly for v inside A ⊕ -B, so the depth is the origin's distance from the boundary of that sum. The
// boundary lies on the convolution's facets; they are taken in the order of their distance, and a piece that is neither
// certainly inside the sum nor shows a way out is split. Nothing else of the sum is ever made; its topology does not matter.
// Guarantees: lower <= depth <= upper, and likewise for the separation; B moved by upper along `direction` does not overlap A. A curved
// solid is measured as a mesh within `deflection`: the separation's bounds are wider by that, and the way out keeps as far from the meshes.
// A mesh may close a gap that its solid has. So the lower bound of what is curved and not convex comes from meshes of both solids eroded
// by as much as those are off, which lie in the solids. What overlaps by less than that has a `lower` of 0, and a separation_upper above 0.
#pragma once

#include "operations/options.h"
#include "expression/expression.h"

namespace starcell {

struct PenetrationDepth {
  double lower = 0, upper = 0;                         ///< of the depth; both 0 if the solids certainly do not overlap
  Vec3 direction = Vec3::Zero();                       ///< of unit length: moves B out of A; zero if the solids do not overlap
  double separation_lower = 0, separation_upper = 0;   ///< of the distance between the solids; both 0 if they certainly overlap
  /// A point of either surface: where they touch, B being moved, or where they are nearest to each other.
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();
  double deflection = 0;                               ///< of the operands' meshes, added up
  std::size_t pieces = 0;                              ///< of facets that were looked at
};

/// upper - lower is at most the error, unless a budget ends first, faces in line hide a place from double precision, or curved solids have
/// room for less than their meshes are off. `options.error`: none: a hundredth of the smaller solid's longest side.
/// Throws as evaluate(); std::invalid_argument for a solid that is empty or has no certified mesh.
PenetrationDepth penetration_depth(const Expression& a, const Expression& b, const Options& options);

}  // namespace starcell
