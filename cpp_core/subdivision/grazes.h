// Places where operands graze each other, and how to move them apart.
//
// A vertex on a foreign facet, or an edge across a foreign edge, puts four planes and more through one point: no arrangement
// of them has certified signs, at any cell size. DESIGN §1 allows an input moved by less than the contact tolerance
// (verdict `contact`), and a translation makes the position generic. Surfaces that operands share must stay shared.
#pragma once

#include "subdivision/near_facets.h"

namespace starcell {

/// Positions this near, as a share of the coordinates, are meant to coincide: generic ones do not come as close.
constexpr double graze_scale = 1e-11;

/// Vertices on foreign facets and crossing edges, less those that identity explains (a common surface). `pairs`: all pairs of
/// facets within `tolerance`. Ordered.
std::vector<Graze> find_grazes(const FacetTable& table, const std::vector<FacetPair>& pairs, double tolerance);

/// Translations, none longer than `reach`, that take the grazing operands off each other and keep every shared surface
/// shared; all zero if nothing can be done. Different `attempt`s give different directions.
std::vector<Vec3> shifts_off_grazes(const FacetTable& table, const std::vector<Graze>& grazes, double reach, int attempt = 0);

}  // namespace starcell
