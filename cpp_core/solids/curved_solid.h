// Solids with closed-form surfaces: sphere, ellipsoid, cylinder, cone, torus and the inside of a quadric (API.md).
//
// Each is the intersection of a few *faces*: smooth surfaces, and planes for the ends of cylinders and cones. Affine maps are
// remembered, not applied: the surfaces of the image are made from the original by interval arithmetic, so nothing is rounded
// on the way. Guarantees: the surfaces enclose those of the solid as it was defined; the bounding box contains it and, but for
// rounding, touches it on all sides.
#pragma once

#include <string>
#include <vector>

#include "solids/smooth_surface.h"

namespace starcell {

/// A plane that ends a curved solid, as nearly as doubles have it: normal . x = offset, and how far the true one may be.
struct EndPlane {
  Vec3 normal = Vec3::Zero();
  double offset = 0;
  double thickness = 0;
};

class CurvedSolid {
 public:
  enum class Kind { sphere, ellipsoid, cylinder, cone, torus, quadric };

  /// Lengths in model units. They throw std::invalid_argument, which names the argument, for what is not finite, not positive
  /// or no direction.
  static std::shared_ptr<const CurvedSolid> sphere(const Vec3& center, double radius);
  /// rotation: columns are the semi-axes' directions, orthonormal to 1e-6.
  static std::shared_ptr<const CurvedSolid> ellipsoid(const Vec3& center, const Vec3& semi_axes, const Eigen::Matrix3d& rotation);
  static std::shared_ptr<const CurvedSolid> cylinder(const Vec3& base, const Vec3& axis, double radius, double height);
  /// radius1 at the base, radius2 at the top; one of them may be 0, and they may be equal.
  static std::shared_ptr<const CurvedSolid> cone(const Vec3& base, const Vec3& axis, double radius1, double radius2, double height);
  /// minor < major: no surface that meets itself.
  static std::shared_ptr<const CurvedSolid> torus(const Vec3& center, const Vec3& axis, double major, double minor);
  /// {x : (x, 1) . m (x, 1) < 0} for a symmetric matrix; possibly unbounded.
  static std::shared_ptr<const CurvedSolid> quadric(const Eigen::Matrix4d& matrix);

  std::shared_ptr<const CurvedSolid> transformed(const Eigen::Matrix4d& map) const;

  Kind kind() const { return kind_; }
  const std::vector<SmoothSurfacePtr>& surfaces() const { return surfaces_; }
  const std::vector<EndPlane>& ends() const { return ends_; }
  /// None for a quadric that is no ellipsoid.
  const std::optional<Box3>& bounding_box() const { return box_; }
  const char* name() const { return name_of(kind_); }
  static const char* name_of(Kind kind);

  /// What it was made from: up to 16 numbers, in the order of the maker's arguments, and the maps since.
  const std::vector<double>& parameters() const { return parameters_; }
  const std::vector<Eigen::Matrix4d>& maps() const { return maps_; }
  /// The solid that parameters and maps describe; throws as the makers do.
  static std::shared_ptr<const CurvedSolid> restored(Kind kind, const std::vector<double>& parameters, const std::vector<Eigen::Matrix4d>& maps);

 private:
  CurvedSolid(Kind kind, std::vector<double> parameters, std::vector<Eigen::Matrix4d> maps);
  void make_faces();

  Kind kind_;
  std::vector<double> parameters_;
  std::vector<Eigen::Matrix4d> maps_;
  std::vector<SmoothSurfacePtr> surfaces_;
  std::vector<EndPlane> ends_;
  std::optional<Box3> box_;
};

using CurvedSolidPtr = std::shared_ptr<const CurvedSolid>;

}  // namespace starcell
