// Planes, cylinders, cones, spheres and tori: their signed distance in closed form, and its largest absolute value
// over triangles, bounded from above.
//
// Notation: f the signed distance, T a triangle, h its longest edge, M a bound of |second derivative of f| near T.
// Rests on: |f - its linear interpolant| <= M h^2 / 6 on T (the smallest circle around T has radius <= h / sqrt 3), and
// on f being 1-Lipschitz. Triangles are quartered, the worst first, until the bound is within 2 % of an attained value.
// Moving every point of T to its nearest point of the surface moves it by |f|, so one bound serves both directions.
// Guarantees: an upper bound up to rounding (doubles, not intervals). A cone is taken with both nappes, a spindle torus
// with both of its sheets.
#pragma once

#include <TopoDS_Face.hxx>
#include <array>
#include <optional>
#include <vector>

#include "numerics/vector.h"

namespace starcell::cad {

class ElementarySurface {
 public:
  /// Nothing if the face lies on another kind of surface.
  static std::optional<ElementarySurface> of(const TopoDS_Face& face);

  bool is_plane() const { return kind_ == Kind::plane; }
  double distance(const Vec3& point) const;
  /// Upper bound of the largest |distance| over all triangles; not refined once it is at most `enough`.
  double largest_distance(const std::vector<std::array<Vec3, 3>>& triangles, double enough = 0) const;

 private:
  enum class Kind { plane, cylinder, cone, sphere, torus };
  double curvature_bound(const Vec3& centre, double radius) const;

  Kind kind_ = Kind::plane;
  Vec3 origin_ = Vec3::Zero();
  Vec3 axis_ = Vec3::UnitZ();
  double major_ = 0;              ///< torus: its circle's radius; cone: radius at the origin
  double minor_ = 0;              ///< radius of the others
  double sine_ = 0, cosine_ = 1;  ///< of a cone's half angle
};

}  // namespace starcell::cad
