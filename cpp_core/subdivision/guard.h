// Guards: directions that see E∩C as a graph, and points that see it as star-shaped (T§3.5.2).
//
// Cheap witnesses first (one plane, the mean normal), then the small linear program. Whatever proposes the guard, it is
// verified with intervals: a Direction that exists is a proof.
#pragma once

#include <optional>

#include "subdivision/facets.h"
#include "subdivision/statistics.h"

namespace starcell {

/// A facet as it bounds E: its normal may have to be turned.
struct OrientedFacet {
  std::uint32_t facet;
  bool flip;
};

/// A unit vector u with n . u > 0 for every facet's outward normal n, certified. `flat_axis`: u has no component along
/// that axis (a direction in a face's plane), or -1.
std::optional<Vec3> find_direction(const FacetTable& table, const std::vector<OrientedFacet>& facets, int flat_axis,
                                   Statistics& statistics);

/// A point o with n . (p - o) of one certified sign for every facet: E is star-shaped about it. In the plane x_axis =
/// `plane` when flat_axis >= 0 (the facets' traces there are star-shaped).
std::optional<Vec3> find_guard(const FacetTable& table, const std::vector<OrientedFacet>& facets, const Box3& around,
                               int flat_axis, double plane, Statistics& statistics);

}  // namespace starcell
