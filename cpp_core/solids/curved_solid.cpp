#include "solids/curved_solid.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Dense>

#include "solids/affine_map.h"
#include "solids/quadric_surface.h"
#include "solids/revolved_surface.h"

namespace starcell {
namespace {

void require_finite(const Vec3& v, const char* name) {
  if (!v.allFinite()) throw std::invalid_argument(std::string(name) + ": must be finite");
}

void require_positive(double x, const char* name) {
  if (!(x > 0) || std::isinf(x)) throw std::invalid_argument(std::string(name) + ": must be greater than 0 and finite");
}

void require_direction(const Vec3& v, const char* name) {
  require_finite(v, name);
  if (v.isZero(0.0)) throw std::invalid_argument(std::string(name) + ": must not be zero");
}

Vec3 vec(const std::vector<double>& p, std::size_t at) { return {p[at], p[at + 1], p[at + 2]}; }

// A right-handed orthonormal frame whose third axis is the given direction.
IntervalMatrix frame_about(const Vec3& axis) {
  const Interval3 third = unit(enclose(axis));
  const Interval3 first = unit(cross(enclose(axis.unitOrthogonal().cross(axis)), enclose(axis)));
  return IntervalMatrix{{first, cross(third, first), third}}.transposed();
}

// The affine map from a solid's own coordinates into the model.
struct Placement {
  IntervalMatrix linear;
  Interval3 translation;

  void then(const Eigen::Matrix4d& map) {
    IntervalMatrix m;
    for (int i = 0; i < 3; ++i) m.row[i] = enclose(Vec3(map(i, 0), map(i, 1), map(i, 2)));
    linear = m * linear;
    translation = m * translation + enclose(Vec3(map(0, 3), map(1, 3), map(2, 3)));
  }
  Eigen::Matrix3d approximate() const {
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i) m.row(i) = linear.row[i].middle();
    return m;
  }
};

IntervalMatrix identity() { return {{enclose(Vec3::UnitX()), enclose(Vec3::UnitY()), enclose(Vec3::UnitZ())}}; }

// What the solid is in its own coordinates, by kind.
Placement placement(CurvedSolid::Kind kind, const std::vector<double>& p) {
  switch (kind) {
    case CurvedSolid::Kind::sphere: return {identity(), enclose(vec(p, 0))};
    case CurvedSolid::Kind::ellipsoid: {
      IntervalMatrix m;
      for (std::size_t i = 0; i < 3; ++i) {
        const Interval3 row = enclose(vec(p, 6 + 3 * i));
        m.row[i] = {row.x * p[3], row.y * p[4], row.z * p[5]};
      }
      return {m, enclose(vec(p, 0))};
    }
    case CurvedSolid::Kind::cylinder:
    case CurvedSolid::Kind::cone:
    case CurvedSolid::Kind::torus: return {frame_about(vec(p, 3)), enclose(vec(p, 0))};
    case CurvedSolid::Kind::quadric: break;
  }
  return {identity(), enclose(Vec3::Zero())};
}

// A quadric in a solid's own coordinates, carried into the model.
SmoothSurfacePtr pulled_quadric(const BodyFrame& frame, const IntervalSymmetric& q, const Interval3& linear, const Interval& constant,
                                double least_slope, const std::optional<RoundShape>& shape) {
  const Interval scale(frame.scale);
  const Interval3 q_rest = q * frame.rest;
  const Interval3 b = frame.inverse.transposed() * (q_rest + linear);
  const Interval c = dot(frame.rest, q_rest) + 2.0 * dot(frame.rest, linear) + constant;
  return std::make_shared<QuadricSurface>(frame.origin, scale * frame.inverse.pull_back(q), scale * b, scale * c, least_slope, shape);
}

// The plane sign (y_z - height) = 0 of the solid's own coordinates, solid on the negative side.
EndPlane end_plane(const BodyFrame& frame, double sign, double height, const Vec3& center, double around) {
  const Interval3 row = frame.inverse.row[2];
  const Interval length = norm(row);
  const Interval3 n{sign * row.x / length, sign * row.y / length, sign * row.z / length};
  EndPlane plane;
  plane.normal = n.middle();
  plane.offset = plane.normal.dot(center);
  const Interval3 off = n - enclose(plane.normal);
  const Interval at_center = (dot(row, enclose(center) - enclose(frame.origin)) + frame.rest.z - height) / length;
  const Interval stored = dot(enclose(center), plane.normal) - plane.offset;
  const Interval wrong = sign * at_center - stored + norm(off) * Interval(-around, around);
  plane.thickness = std::max(-wrong.lower(), wrong.upper());
  return plane;
}

// Extent of a disk of radius r across the third axis, of a ball, along each model axis.
Vec3 disk(const Eigen::Matrix3d& m, double r) { return r * (m.col(0).cwiseAbs2() + m.col(1).cwiseAbs2()).cwiseSqrt(); }
Vec3 ball(const Eigen::Matrix3d& m, double r) { return r * m.rowwise().norm(); }

Box3 around(const Vec3& center, const Vec3& extent) { return {center - extent, center + extent}; }

// Of {y . a y + 2 b . y + c < 0}: none if it is not bounded.
std::optional<Box3> ellipsoid_box(const Eigen::Matrix4d& q) {
  const Eigen::Matrix3d a = q.topLeftCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(a);
  if (!(eigen.eigenvalues()[0] > 1e-12 * eigen.eigenvalues().cwiseAbs().maxCoeff())) return std::nullopt;
  const Eigen::Matrix3d inverse = a.inverse();
  const Vec3 b = q.topRightCorner<3, 1>(), center = -inverse * b;
  const double k = -(q(3, 3) + b.dot(center));
  if (!(k > 0)) return Box3();
  return around(center, (k * inverse.diagonal()).cwiseSqrt() * (1 + 1e-9));
}

constexpr double similar = 1e-13;

}  // namespace

CurvedSolid::CurvedSolid(Kind kind, std::vector<double> parameters, std::vector<Eigen::Matrix4d> maps)
    : kind_(kind), parameters_(std::move(parameters)), maps_(std::move(maps)) {
  make_faces();
}

void CurvedSolid::make_faces() {
  const std::vector<double>& p = parameters_;
  const Rounding rounding;
  Placement place = placement(kind_, p);
  for (const Eigen::Matrix4d& map : maps_) place.then(map);
  const Eigen::Matrix3d m = place.approximate();
  const Vec3 origin = place.translation.middle();
  if (!m.allFinite() || !origin.allFinite()) throw std::invalid_argument("matrix moves the solid out of the range of floating-point numbers");
  const Vec3 stretch = m.jacobiSvd().singularValues();
  const double largest = stretch[0], smallest = stretch[2];
  // Determinants of what is nearly singular enclose 0, and nothing can be said of the image.
  if (!(smallest > 1e-12 * largest)) throw std::invalid_argument("matrix must not be singular, nor nearly");
  BodyFrame frame{origin, place.linear.inverse(), {}, 1};
  frame.rest = frame.inverse * (enclose(origin) - place.translation);
  frame.scale = smallest;
  const double least_slope = 0.999 * smallest / largest;
  const bool round = largest - smallest <= similar * largest;
  const Vec3 axis = m.col(2) / m.col(2).norm();
  const auto shape = [&](RoundShape::Kind kind, const Vec3& point, double a, double b = 0) -> std::optional<RoundShape> {
    if (!round) return std::nullopt;
    return RoundShape{kind, point, axis, a, b};
  };
  const IntervalSymmetric one{1, 1, 1, 0, 0, 0}, flat{1, 1, 0, 0, 0, 0};
  const Interval3 zero = enclose(Vec3::Zero());
  switch (kind_) {
    case Kind::sphere:
    case Kind::ellipsoid: {
      const double r = kind_ == Kind::sphere ? p[3] : 1.0;
      frame.scale /= 2 * r;
      surfaces_.push_back(pulled_quadric(frame, one, zero, -squared(Interval(r)), least_slope, shape(RoundShape::Kind::sphere, origin, r * largest)));
      box_ = around(origin, ball(m, r));
      break;
    }
    case Kind::cylinder:
    case Kind::cone: {
      const double r1 = p[6], r2 = kind_ == Kind::cylinder ? p[6] : p[7], height = p.back();
      const Vec3 top = origin + height * m.col(2);
      if (r1 == r2) {
        frame.scale /= 2 * r1;
        surfaces_.push_back(pulled_quadric(frame, flat, zero, -squared(Interval(r1)), least_slope, shape(RoundShape::Kind::cylinder, origin, r1 * largest)));
      } else {
        const Interval slope = (Interval(r2) - r1) / height;
        const double tip = -r1 / middle(slope);
        auto cone = shape(RoundShape::Kind::cone, origin + tip * m.col(2), std::abs(middle(slope)));
        if (cone && middle(slope) > 0) cone->axis = -cone->axis;
        surfaces_.push_back(std::make_shared<ConeSurface>(frame, r1, slope, least_slope, cone));
      }
      box_ = around(origin, disk(m, r1)).merged(around(top, disk(m, r2)));
      const double reach = 4 * box_->diagonal().norm();
      if (r1 > 0) ends_.push_back(end_plane(frame, -1, 0, origin, reach));
      if (r2 > 0) ends_.push_back(end_plane(frame, 1, height, top, reach));
      break;
    }
    case Kind::torus:
      surfaces_.push_back(std::make_shared<TorusSurface>(frame, p[6], p[7], least_slope,
                                                         shape(RoundShape::Kind::torus, origin, p[6] * largest, p[7] * largest)));
      box_ = around(origin, disk(m, p[6]) + ball(m, p[7]));
      break;
    case Kind::quadric: {
      const auto q = [&](std::size_t i, std::size_t j) { return Interval(p[4 * i + j]); };
      double size = 0;
      for (const double x : p) size = std::max(size, std::abs(x));
      frame.scale = smallest * smallest / size;
      surfaces_.push_back(pulled_quadric(frame, {q(0, 0), q(1, 1), q(2, 2), q(0, 1), q(0, 2), q(1, 2)}, {q(0, 3), q(1, 3), q(2, 3)}, q(3, 3), 0, std::nullopt));
      Eigen::Matrix4d own, map = Eigen::Matrix4d::Identity();
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) own(i, j) = p[static_cast<std::size_t>(4 * i + j)];
      map.topLeftCorner<3, 3>() = m;
      map.topRightCorner<3, 1>() = origin;
      const Eigen::Matrix4d back = map.inverse();
      box_ = ellipsoid_box(back.transpose() * own * back);
      break;
    }
  }
  if (box_ && !box_->isEmpty()) {
    const Vec3 margin = Vec3::Constant(1e-13 * std::max(box_->min().cwiseAbs().maxCoeff(), box_->max().cwiseAbs().maxCoeff()));
    box_ = Box3(box_->min() - margin, box_->max() + margin);
  }
}

const char* CurvedSolid::name_of(Kind kind) {
  switch (kind) {
    case Kind::sphere: return "sphere";
    case Kind::ellipsoid: return "ellipsoid";
    case Kind::cylinder: return "cylinder";
    case Kind::cone: return "cone";
    case Kind::torus: return "torus";
    case Kind::quadric: return "quadric";
  }
  return "";
}

CurvedSolidPtr CurvedSolid::sphere(const Vec3& center, double radius) {
  require_finite(center, "center");
  require_positive(radius, "radius");
  return CurvedSolidPtr(new CurvedSolid(Kind::sphere, {center.x(), center.y(), center.z(), radius}, {}));
}

CurvedSolidPtr CurvedSolid::ellipsoid(const Vec3& center, const Vec3& semi_axes, const Eigen::Matrix3d& rotation) {
  require_finite(center, "center");
  for (int k = 0; k < 3; ++k) require_positive(semi_axes[k], "semi_axes");
  if (!rotation.allFinite() || !(rotation.transpose() * rotation).isIdentity(1e-6))
    throw std::invalid_argument("rotation: must be a 3x3 matrix with orthonormal columns");
  std::vector<double> p{center.x(), center.y(), center.z(), semi_axes.x(), semi_axes.y(), semi_axes.z()};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) p.push_back(rotation(i, j));
  return CurvedSolidPtr(new CurvedSolid(Kind::ellipsoid, std::move(p), {}));
}

CurvedSolidPtr CurvedSolid::cylinder(const Vec3& base, const Vec3& axis, double radius, double height) {
  require_finite(base, "base");
  require_direction(axis, "axis");
  require_positive(radius, "radius");
  require_positive(height, "height");
  return CurvedSolidPtr(new CurvedSolid(Kind::cylinder, {base.x(), base.y(), base.z(), axis.x(), axis.y(), axis.z(), radius, height}, {}));
}

CurvedSolidPtr CurvedSolid::cone(const Vec3& base, const Vec3& axis, double radius1, double radius2, double height) {
  require_finite(base, "base");
  require_direction(axis, "axis");
  if (!(radius1 >= 0) || std::isinf(radius1)) throw std::invalid_argument("radius1: must not be negative and must be finite");
  if (!(radius2 >= 0) || std::isinf(radius2)) throw std::invalid_argument("radius2: must not be negative and must be finite");
  if (radius1 == 0 && radius2 == 0) throw std::invalid_argument("radius2: the two radii must not both be 0");
  require_positive(height, "height");
  return CurvedSolidPtr(new CurvedSolid(Kind::cone, {base.x(), base.y(), base.z(), axis.x(), axis.y(), axis.z(), radius1, radius2, height}, {}));
}

CurvedSolidPtr CurvedSolid::torus(const Vec3& center, const Vec3& axis, double major, double minor) {
  require_finite(center, "center");
  require_direction(axis, "axis");
  require_positive(major, "major");
  require_positive(minor, "minor");
  if (!(minor < major)) throw std::invalid_argument("minor: must be less than major, or the torus meets itself");
  return CurvedSolidPtr(new CurvedSolid(Kind::torus, {center.x(), center.y(), center.z(), axis.x(), axis.y(), axis.z(), major, minor}, {}));
}

CurvedSolidPtr CurvedSolid::quadric(const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite()) throw std::invalid_argument("matrix4x4: must be finite");
  if (matrix != matrix.transpose()) throw std::invalid_argument("matrix4x4: must be symmetric");
  if (matrix.topRows<3>().isZero(0.0)) throw std::invalid_argument("matrix4x4: must not be constant");
  std::vector<double> p;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) p.push_back(matrix(i, j));
  return CurvedSolidPtr(new CurvedSolid(Kind::quadric, std::move(p), {}));
}

CurvedSolidPtr CurvedSolid::transformed(const Eigen::Matrix4d& map) const {
  require_affine(map);
  std::vector<Eigen::Matrix4d> maps = maps_;
  maps.push_back(map);
  return CurvedSolidPtr(new CurvedSolid(kind_, parameters_, std::move(maps)));
}

CurvedSolidPtr CurvedSolid::restored(Kind kind, const std::vector<double>& p, const std::vector<Eigen::Matrix4d>& maps) {
  const std::size_t wanted[] = {4, 15, 8, 9, 8, 16};
  if (p.size() != wanted[static_cast<std::size_t>(kind)]) throw std::invalid_argument("parameters: wrong number of them");
  CurvedSolidPtr solid;
  switch (kind) {
    case Kind::sphere: solid = sphere(vec(p, 0), p[3]); break;
    case Kind::ellipsoid: {
      Eigen::Matrix3d rotation;
      for (int i = 0; i < 3; ++i) rotation.row(i) = vec(p, static_cast<std::size_t>(6 + 3 * i));
      solid = ellipsoid(vec(p, 0), vec(p, 3), rotation);
      break;
    }
    case Kind::cylinder: solid = cylinder(vec(p, 0), vec(p, 3), p[6], p[7]); break;
    case Kind::cone: solid = cone(vec(p, 0), vec(p, 3), p[6], p[7], p[8]); break;
    case Kind::torus: solid = torus(vec(p, 0), vec(p, 3), p[6], p[7]); break;
    case Kind::quadric: {
      Eigen::Matrix4d m;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) m(i, j) = p[static_cast<std::size_t>(4 * i + j)];
      solid = quadric(m);
      break;
    }
  }
  for (const Eigen::Matrix4d& map : maps) solid = solid->transformed(map);
  return solid;
}

}  // namespace starcell
