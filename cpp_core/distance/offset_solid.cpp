#include "distance/offset_solid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace starcell {

OffsetSolidPtr OffsetSolid::make(PolyhedronPtr solid, double distance) {
  if (!std::isfinite(distance) || distance == 0) throw std::invalid_argument("distance: must be finite and not 0");
  return std::shared_ptr<const OffsetSolid>(new OffsetSolid(std::move(solid), distance));
}

OffsetSolidPtr OffsetSolid::about_faces(PolyhedronPtr solid, std::vector<std::uint32_t> faces, double radius) {
  if (!std::isfinite(radius) || !(radius > 0)) throw std::invalid_argument("radius: must be finite and positive");
  if (faces.empty()) throw std::invalid_argument("faces: must not be empty");
  if (!std::is_sorted(faces.begin(), faces.end()) || faces.back() >= solid->triangles().size())
    throw std::invalid_argument("faces: must ascend and be triangles of the solid");
  return std::shared_ptr<const OffsetSolid>(new OffsetSolid(std::move(solid), std::move(faces), radius));
}

OffsetSolidPtr OffsetSolid::transformed(const Eigen::Matrix4d& map) const {
  const Eigen::Matrix3d a = map.topLeftCorner<3, 3>();
  const double square = a.squaredNorm() / 3;
  if (!((a.transpose() * a - square * Eigen::Matrix3d::Identity()).norm() <= 1e-12 * square))
    throw std::invalid_argument("matrix: an offset solid can be moved, mirrored and scaled evenly; for other maps, take the solid of its result");
  if (!faces_.empty()) {
    const PolyhedronPtr image = solid_->transformed(map);
    if (image->triangles().size() != solid_->triangles().size()) throw std::invalid_argument("matrix: some of the solid's triangles vanish");
    return about_faces(image, faces_, distance_ * std::sqrt(square));
  }
  return make(solid_->transformed(map), distance_ * std::sqrt(square));
}

OffsetSolid::OffsetSolid(PolyhedronPtr solid, double distance)
    : solid_(std::move(solid)), distance_(distance),
      surface_(std::make_shared<DistanceSurface>(std::make_shared<const MeshFeatures>(solid_), distance)) {
  const Vec3 by = Vec3::Constant(distance);
  box_ = {solid_->bounding_box().min() - by, solid_->bounding_box().max() + by};
  if ((box_.sizes().array() < 0).any()) box_.setEmpty();
}

OffsetSolid::OffsetSolid(PolyhedronPtr solid, std::vector<std::uint32_t> faces, double radius)
    : solid_(std::move(solid)), faces_(std::move(faces)), distance_(radius),
      surface_(std::make_shared<DistanceSurface>(std::make_shared<const MeshFeatures>(solid_), faces_, radius)) {
  for (const std::uint32_t face : faces_)
    for (const std::uint32_t v : solid_->triangles()[face]) box_.extend(solid_->vertices()[v]);
  const Vec3 by = Vec3::Constant(radius);
  box_ = {box_.min() - by, box_.max() + by};
}

}  // namespace starcell
