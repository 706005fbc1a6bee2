// Where grid lines and grid-line segments meet facets, decided exactly.
//
// A grid line is parallel to an axis through a grid point. Whether it meets a facet is a 2D question on the original
// vertices; on which side of a grid point it does is one orientation. Both use the perturbed grid of predicates.h, so
// neighbouring facets agree about their common edge and parity along a line is exact.
#pragma once

#include "subdivision/facets.h"
#include "subdivision/grid.h"

namespace starcell {

/// The sign of the facet normal's component along `axis` if the line through `p` meets the facet, else 0.
int line_meets(const FacetTable& table, std::uint32_t facet, int axis, const Vec3& p);

/// For a line that meets the facet with normal sign `sign`: is the crossing below p on the line?
bool crossing_below(const FacetTable& table, std::uint32_t facet, int sign, const Vec3& p);

/// Does the segment from p along `axis` up to coordinate `to` (or down to it) cross the facet?
bool segment_crosses(const FacetTable& table, std::uint32_t facet, int axis, const Vec3& p, double to);

/// Does the (perturbed) box meet the facet? Exact.
bool box_meets_facet(const FacetTable& table, std::uint32_t facet, const Box3& box);

/// Does the box meet the segment between two mesh vertices? Exact.
bool box_meets_segment(const Vec3& p, const Vec3& q, const Box3& box);

/// Is a mesh vertex inside the box? Exact.
inline bool box_contains(const Box3& box, const Vec3& p) {
  for (int k = 0; k < 3; ++k)
    if (p[k] <= box.min()[k] || p[k] > box.max()[k]) return false;
  return true;
}

}  // namespace starcell
