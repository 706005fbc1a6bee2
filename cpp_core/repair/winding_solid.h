// The points about which a closed chain of triangles winds at least once: what a mesh that crosses itself, or overlaps, means.
//
// The chain's own triangles contain the boundary; the winding number of a point is the signed number of triangles above it (exact,
// solids/upward_ray.h). Overlapping parts unite, doubled sheets count once, folds that are inside out vanish. Guarantees: those of a
// candidate solid.
#pragma once

#include <memory>

#include "minkowski/facet_tree.h"
#include "solids/candidate_solid.h"
#include "solids/triangle_hierarchy.h"

namespace starcell {

class WindingSolid final : public CandidateSolid {
 public:
  /// Every edge of the triangles runs as often one way as the other.
  WindingSolid(std::vector<Vec3> vertices, const std::vector<Triangle>& triangles);

  const std::vector<Vec3>& points() const override { return points_; }
  const std::vector<char>& merged() const override { return merged_; }
  const std::vector<Triangle>& facets() const override { return facets_; }
  const std::vector<std::uint32_t>& partners() const override { return partners_; }
  std::optional<bool> contains(const Vec3& x) const override;
  std::optional<bool> constant(const Box3& box) const override;

  const Box3& bounding_box() const { return box_; }
  /// The image under an affine map; a mirror image is turned round.
  std::shared_ptr<const WindingSolid> transformed(const Eigen::Matrix4d& map) const;

 private:
  int winding_number(const Vec3& x) const;
  /// Calls visit(facet) for facets whose boxes meet this one, until it returns true; was that so?
  template <class Visit>
  bool near(const Box3& box, const Visit& visit) const;

  std::vector<Vec3> points_;
  std::vector<Triangle> facets_;   ///< with an area
  std::vector<char> merged_;
  std::vector<std::uint32_t> partners_;
  FacetTree tree_;
  TriangleHierarchy rays_;
  Box3 box_;
};

using WindingSolidPtr = std::shared_ptr<const WindingSolid>;

}  // namespace starcell
