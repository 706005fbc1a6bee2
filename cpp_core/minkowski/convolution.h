// The facets that can bound a Minkowski sum: the convolution of two operands, as triangles.
//
// Rests on Guibas, Ramshaw & Stolfi 1983 and Lien 2008; see sum_operand.h for which features take part. Guarantees: every point of
// the boundary of A ⊕ B lies on a facet, turned as the boundary is, but for the rounding of a + b to doubles. Pairs of features
// are found by their normals, so that their number grows with what the normals have in common, not with m·n; parallel flat faces of many
// facets are covered as a whole (flat_faces.h).
#pragma once

#include <functional>

#include "minkowski/sum_operand.h"

namespace starcell {

struct Convolution {
  std::vector<Vec3> points;
  /// Per point: it stands for several sums that are not exactly equal, and only rounding may tell apart.
  std::vector<char> merged;
  std::vector<Triangle> facets;
  std::vector<std::uint32_t> partners;   ///< the other half of a parallelogram, or the facet itself
  /// Of each facet's corners the vertices that were added, of a and of b; only if asked for.
  std::vector<std::array<std::array<std::uint32_t, 2>, 3>> origins;
  std::size_t pairs = 0;                 ///< of features looked at
};

struct ConvolutionSettings {
  bool origins = false;
  bool covers = true;            ///< facets may reach beyond the sum where that makes them few
  std::function<void()> pause;   ///< called now and then; what it throws ends the work
};

Convolution convolve(const SumOperand& a, const SumOperand& b, const ConvolutionSettings& settings = {});

}  // namespace starcell
