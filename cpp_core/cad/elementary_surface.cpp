#include "cad/elementary_surface.h"

#include <BRepAdaptor_Surface.hxx>
#include <cmath>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>
#include <limits>
#include <queue>

namespace starcell::cad {
namespace {

struct Piece {
  double bound;
  std::array<Vec3, 3> corners;
  std::array<double, 3> values;  ///< |distance| at the corners
  bool operator<(const Piece& other) const { return bound < other.bound; }
};

double longest_edge(const std::array<Vec3, 3>& t) {
  return std::max({(t[0] - t[1]).norm(), (t[1] - t[2]).norm(), (t[2] - t[0]).norm()});
}

/// The longest edge's shadow along the axis.
double longest_edge_across(const std::array<Vec3, 3>& t, const Vec3& axis) {
  const auto across = [&](const Vec3& edge) { return (edge - edge.dot(axis) * axis).norm(); };
  return std::max({across(t[0] - t[1]), across(t[1] - t[2]), across(t[2] - t[0])});
}

}  // namespace

std::optional<ElementarySurface> ElementarySurface::of(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face, Standard_False);
  ElementarySurface known;
  const auto place = [&](const gp_Ax3& frame) {
    const gp_Pnt& o = frame.Location();
    const gp_Dir& d = frame.Direction();
    known.origin_ = {o.X(), o.Y(), o.Z()};
    known.axis_ = {d.X(), d.Y(), d.Z()};
  };
  switch (surface.GetType()) {
    case GeomAbs_Plane:
      known.kind_ = Kind::plane;
      place(surface.Plane().Position());
      return known;
    case GeomAbs_Cylinder:
      known.kind_ = Kind::cylinder;
      place(surface.Cylinder().Position());
      known.minor_ = surface.Cylinder().Radius();
      return known;
    case GeomAbs_Cone:
      known.kind_ = Kind::cone;
      place(surface.Cone().Position());
      known.major_ = surface.Cone().RefRadius();
      known.sine_ = std::sin(surface.Cone().SemiAngle());
      known.cosine_ = std::cos(surface.Cone().SemiAngle());
      return known;
    case GeomAbs_Sphere:
      known.kind_ = Kind::sphere;
      place(surface.Sphere().Position());
      known.minor_ = surface.Sphere().Radius();
      return known;
    case GeomAbs_Torus:
      known.kind_ = Kind::torus;
      place(surface.Torus().Position());
      known.major_ = surface.Torus().MajorRadius();
      known.minor_ = surface.Torus().MinorRadius();
      return known;
    default: return std::nullopt;
  }
}

double ElementarySurface::distance(const Vec3& point) const {
  const Vec3 p = point - origin_;
  const double height = p.dot(axis_);
  const double radius = (p - height * axis_).norm();
  switch (kind_) {
    case Kind::plane: return height;
    case Kind::cylinder: return radius - minor_;
    case Kind::cone: {
      // The half plane through the axis meets the two nappes in two lines; the nearer one counts.
      const double here = (radius - major_) * cosine_ - height * sine_;
      const double there = (-radius - major_) * cosine_ - height * sine_;
      return std::abs(here) <= std::abs(there) ? here : there;
    }
    case Kind::sphere: return p.norm() - minor_;
    case Kind::torus: {
      // The half plane through the axis meets the tube in this circle and, if it is a spindle, in the opposite one.
      const double here = std::hypot(radius - major_, height) - minor_;
      const double there = std::hypot(radius + major_, height) - minor_;
      return std::abs(here) <= std::abs(there) ? here : there;
    }
  }
  return 0;
}

/// Largest |second derivative| of the distance in a ball: 1 / (distance to where the distance is not smooth).
double ElementarySurface::curvature_bound(const Vec3& centre, double ball) const {
  const Vec3 p = centre - origin_;
  const double height = p.dot(axis_);
  const double radius = (p - height * axis_).norm();
  double to_focus = std::numeric_limits<double>::infinity();
  switch (kind_) {
    case Kind::plane: return 0;
    case Kind::cylinder:
    case Kind::cone: to_focus = radius; break;
    case Kind::sphere: to_focus = p.norm(); break;
    case Kind::torus: to_focus = std::min(radius, std::hypot(radius - major_, height)); break;
  }
  return to_focus > ball ? 1 / (to_focus - ball) : std::numeric_limits<double>::infinity();
}

double ElementarySurface::largest_distance(const std::vector<std::array<Vec3, 3>>& triangles, double enough) const {
  constexpr std::size_t most_pieces = 4'000'000;
  double attained = 0;
  const auto bounded = [&](const std::array<Vec3, 3>& corners, const std::array<double, 3>& values) {
    const double h = longest_edge(corners);
    // Beside a term linear in the height, the distance to a cylinder or cone depends on the shadow along the axis only.
    const bool straight = kind_ == Kind::cylinder || kind_ == Kind::cone;
    const double bent = straight ? longest_edge_across(corners, axis_) : h;
    const double top = std::max({values[0], values[1], values[2]});
    attained = std::max(attained, top);
    // Every point of T is within 2h/3 of the centroid, and within h / sqrt 3 of some corner.
    const double bend = curvature_bound((corners[0] + corners[1] + corners[2]) / 3, 2 * bent / 3) * bent * bent / 6;
    return Piece{top + std::min(bend, h / std::sqrt(3.0)), corners, values};
  };
  std::priority_queue<Piece> worst;
  double scale = 0;
  for (const auto& t : triangles) {
    scale = std::max({scale, t[0].norm(), t[1].norm(), t[2].norm()});
    worst.push(bounded(t, {std::abs(distance(t[0])), std::abs(distance(t[1])), std::abs(distance(t[2]))}));
  }
  const double rounding = 1e-14 * scale;
  for (std::size_t pieces = worst.size(); !worst.empty() && pieces < most_pieces + triangles.size(); pieces += 4) {
    const Piece p = worst.top();
    if (p.bound <= std::max(enough, 1.02 * attained + rounding)) break;
    worst.pop();
    std::array<Vec3, 3> mid;
    std::array<double, 3> value;
    for (int k = 0; k < 3; ++k) {
      mid[k] = (p.corners[k] + p.corners[(k + 1) % 3]) / 2;
      value[k] = std::abs(distance(mid[k]));
    }
    for (int k = 0; k < 3; ++k)
      worst.push(bounded({p.corners[k], mid[k], mid[(k + 2) % 3]}, {p.values[k], value[k], value[(k + 2) % 3]}));
    worst.push(bounded(mid, value));
  }
  return worst.empty() ? 0 : worst.top().bound;
}

}  // namespace starcell::cad
