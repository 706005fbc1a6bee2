#include "distance/offset_solid.h"

#include <cmath>
#include <stdexcept>

namespace starcell {

OffsetSolidPtr OffsetSolid::make(PolyhedronPtr solid, double distance) {
  if (!std::isfinite(distance) || distance == 0) throw std::invalid_argument("distance: must be finite and not 0");
  return std::shared_ptr<const OffsetSolid>(new OffsetSolid(std::move(solid), distance));
}

OffsetSolidPtr OffsetSolid::transformed(const Eigen::Matrix4d& map) const {
  const Eigen::Matrix3d a = map.topLeftCorner<3, 3>();
  const double square = a.squaredNorm() / 3;
  if (!((a.transpose() * a - square * Eigen::Matrix3d::Identity()).norm() <= 1e-12 * square))
    throw std::invalid_argument("matrix: an offset solid can be moved, mirrored and scaled evenly; for other maps, take the solid of its result");
  return make(solid_->transformed(map), distance_ * std::sqrt(square));
}

OffsetSolid::OffsetSolid(PolyhedronPtr solid, double distance)
    : solid_(std::move(solid)), distance_(distance),
      surface_(std::make_shared<DistanceSurface>(std::make_shared<const MeshFeatures>(solid_), distance)) {
  const Vec3 by = Vec3::Constant(distance);
  box_ = {solid_->bounding_box().min() - by, solid_->bounding_box().max() + by};
  if ((box_.sizes().array() < 0).any()) box_.setEmpty();
}

}  // namespace starcell
