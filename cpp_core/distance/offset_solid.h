// The rounded offset of a polyhedron: all points within r of it (r > 0), or all of its points farther than |r| from its boundary.
//
// One region, bounded by a distance surface. T§4.2; Rossignac & Requicha 1986.
#pragma once

#include "distance/distance_surface.h"

namespace starcell {

class OffsetSolid {
 public:
  /// Throws std::invalid_argument for a distance that is 0 or not finite.
  static std::shared_ptr<const OffsetSolid> make(PolyhedronPtr solid, double distance);

  /// The image under a similarity; throws std::invalid_argument for other maps, which turn balls into ellipsoids.
  std::shared_ptr<const OffsetSolid> transformed(const Eigen::Matrix4d& map) const;

  const PolyhedronPtr& solid() const { return solid_; }
  double distance() const { return distance_; }
  const SmoothSurfacePtr& surface() const { return surface_; }
  /// Empty if the solid is certainly gone.
  const Box3& bounding_box() const { return box_; }

 private:
  OffsetSolid(PolyhedronPtr solid, double distance);

  PolyhedronPtr solid_;
  double distance_;
  SmoothSurfacePtr surface_;
  Box3 box_;
};

using OffsetSolidPtr = std::shared_ptr<const OffsetSolid>;

}  // namespace starcell
