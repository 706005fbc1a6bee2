// The rounded offset of a polyhedron: all points within r of it (r > 0), or all of its points farther than |r| from its boundary.
// And what is within r of some of its faces: the wall that a shell with open faces keeps.
//
// One region, bounded by a distance surface. T§4.2; Rossignac & Requicha 1986.
#pragma once

#include "distance/distance_surface.h"

namespace starcell {

class OffsetSolid {
 public:
  /// Throws std::invalid_argument for a distance that is 0 or not finite.
  static std::shared_ptr<const OffsetSolid> make(PolyhedronPtr solid, double distance);

  /// All points within `radius` of the given triangles, which are ascending. Throws std::invalid_argument for a radius that is not positive
  /// and finite, and for no triangles or one out of range.
  static std::shared_ptr<const OffsetSolid> about_faces(PolyhedronPtr solid, std::vector<std::uint32_t> faces, double radius);

  /// The image under a similarity; throws std::invalid_argument for other maps, which turn balls into ellipsoids.
  std::shared_ptr<const OffsetSolid> transformed(const Eigen::Matrix4d& map) const;

  const PolyhedronPtr& solid() const { return solid_; }
  double distance() const { return distance_; }
  /// What it is measured from: none: the whole solid.
  const std::vector<std::uint32_t>& faces() const { return faces_; }
  const SmoothSurfacePtr& surface() const { return surface_; }
  /// Empty if the solid is certainly gone.
  const Box3& bounding_box() const { return box_; }

 private:
  OffsetSolid(PolyhedronPtr solid, double distance);
  OffsetSolid(PolyhedronPtr solid, std::vector<std::uint32_t> faces, double radius);

  PolyhedronPtr solid_;
  std::vector<std::uint32_t> faces_;
  double distance_;
  SmoothSurfacePtr surface_;
  Box3 box_;
};

using OffsetSolidPtr = std::shared_ptr<const OffsetSolid>;

}  // namespace starcell
