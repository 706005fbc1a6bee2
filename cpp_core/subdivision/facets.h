// What bounds the operands, in one table: facets, which the octree pushes down its cells, and regions.
//
// An operand is a polyhedron, a solid known by *candidate* facets and membership (solids/candidate_solid.h), or a *region*: one side
// of a smooth surface or of a plane. They come in this order. Facets of one operand are consecutive; membership in a polyhedron is their
// parity, a candidate's facets flip membership only where it says so. A *surface* is a supporting plane or a smooth surface with an identity: facets of one operand that
// are coplanar to within rounding share it, and so do facets of different operands within the contact tolerance
// (DESIGN §4). Every facet lies within `thickness` of its surface's canonical plane.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "solids/candidate_solid.h"
#include "solids/curved_solid.h"
#include "solids/polyhedron.h"

namespace starcell {

struct Surface {
  Vec3 normal;             ///< unit length up to rounding; taken as exact
  double offset = 0;       ///< the plane is normal . x = offset
  double thickness = 0;    ///< |normal . x - offset| <= thickness on every facet of the surface
  bool shared = false;     ///< several operands lie on it: a possible contact
  SmoothSurfacePtr form = nullptr;   /// null: the plane above; thickness holds for those who share it

  double distance(const Vec3& p) const { return std::abs(normal.dot(p) - offset); }
  /// Needs a Rounding object.
  Expansion expand(const Vec3& center, const Vec3& reach) const;
  Interval slope_along(const Vec3& center, const Vec3& reach, const Vec3& u) const {
    return form ? form->slope_along(center, reach, u) : dot(enclose(normal), u);
  }
  /// Its function and gradient to rounding: proposals, no proof.
  double value(const Vec3& x, Vec3* gradient = nullptr) const;
};

/// A place where operands touch although no surface is shared: a vertex of one on a facet of another, or two edges that
/// cross. More than three planes pass through such a point, and their arrangement there has no certified signs.
struct Graze {
  std::uint32_t of, on;   ///< operands
  Vec3 place;
};

/// The solid where F < 0 (or, `complement`, where F > 0) of a surface.
struct Region {
  std::uint32_t surface = 0;
  bool complement = false;
  std::uint32_t body = 0;   ///< the first operand of the solid that it bounds: they move together
  std::uint32_t first_plane = 0;   ///< the surface's planes are this one of the table and those after it
};

/// A region as it comes in: a smooth surface, or the plane that ends a curved solid. `box`: where it matters.
struct RegionOperand {
  SmoothSurfacePtr form;
  EndPlane end;
  Box3 box;
  std::uint32_t body = 0;   ///< index of the solid's first region
};

struct FacetTable {
  std::vector<Vec3> points;
  std::vector<Triangle> corners;
  std::vector<Triangle> neighbours;      ///< across the edge from corner k to k+1
  std::vector<std::uint32_t> surface;    ///< per facet
  std::vector<std::uint32_t> first;      ///< facets of operand s are first[s] .. first[s+1]
  std::vector<Surface> surfaces;
  std::vector<CandidateSolidPtr> candidates;   ///< per operand with facets; null: a polyhedron
  std::vector<Vec3> shifts;              ///< how far each candidate was moved
  std::vector<char> merged;              ///< per point: not one and the same for all facets with this corner; none: no such point
  std::vector<Region> regions;           ///< operand k >= faceted() is regions[k - faceted()]
  std::vector<Graze> grazes;
  double thickest = 0;                   ///< largest thickness: how far canonical planes stand for facets

  std::size_t size() const { return corners.size(); }
  /// Operands that have facets.
  std::size_t faceted() const { return first.size() - 1; }
  std::size_t operands() const { return faceted() + regions.size(); }
  bool is_region(std::uint32_t operand) const { return operand >= faceted(); }
  const Region& region(std::uint32_t operand) const { return regions[operand - faceted()]; }
  /// Null: it has no candidates.
  const CandidateSolid* candidate(std::uint32_t operand) const { return operand < candidates.size() ? candidates[operand].get() : nullptr; }
  std::uint32_t operand_of(std::uint32_t facet) const;
  /// As the operand has it where it was moved to.
  std::optional<bool> candidate_contains(std::uint32_t operand, const Vec3& x) const { return candidates[operand]->contains(x - shifts[operand]); }
  /// The largest distance of a facet's corners from a plane.
  double distance(const Surface& s, std::uint32_t facet) const;
  Box3 box(std::uint32_t facet) const;
  bool is_merged(std::uint32_t point) const { return point < merged.size() && merged[point]; }
  const Vec3& corner(std::uint32_t facet, int k) const { return points[corners[facet][k]]; }
  /// Does the facet face the way its surface's plane does?
  bool is_along(std::uint32_t facet) const { return area_vector(facet).dot(surfaces[surface[facet]].normal) > 0; }
  Vec3 area_vector(std::uint32_t facet) const {
    const Vec3& a = corner(facet, 0);
    return 0.5 * (corner(facet, 1) - a).cross(corner(facet, 2) - a);
  }
};

/// Gathers the operands' facets and finds their surfaces. Facets of different operands are on one surface when each lies
/// within `contact` of the other's plane and their boxes come that near; regions when their surfaces are within it
/// wherever both matter. `shifts`: a translation for each operand; empty: none.
FacetTable gather_facets(const std::vector<PolyhedronPtr>& operands, double contact, const std::vector<Vec3>& shifts = {},
                         const std::vector<RegionOperand>& regions = {}, const std::vector<CandidateSolidPtr>& candidates = {});

}  // namespace starcell
