// A solid that is known by facets which together contain its boundary, and by membership; not every facet bounds it everywhere.
//
// DESIGN §2's oracle for what no closed mesh describes: Minkowski sums and erosions. Facets turn the side outward that the
// boundary would have there. Guarantees asked of implementations: the boundary lies on the facets, but for the rounding of their
// corners; contains() and constant() say nothing that is not certain.
#pragma once

#include <optional>

#include "solids/polyhedron.h"

namespace starcell {

class CandidateSolid {
 public:
  virtual ~CandidateSolid() = default;

  virtual const std::vector<Vec3>& points() const = 0;
  /// Per point: of the facets with this corner some have it only to within rounding.
  virtual const std::vector<char>& merged() const = 0;
  virtual const std::vector<Triangle>& facets() const = 0;
  /// Per facet: another one on its plane with a common edge, or itself.
  virtual const std::vector<std::uint32_t>& partners() const = 0;

  /// Is the point inside? None: too near to tell. Safe to call in parallel.
  virtual std::optional<bool> contains(const Vec3& x) const = 0;
  /// The membership that all points of the box have for certain.
  virtual std::optional<bool> constant(const Box3& box) const = 0;
};

using CandidateSolidPtr = std::shared_ptr<const CandidateSolid>;

}  // namespace starcell
