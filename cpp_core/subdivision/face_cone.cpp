#include "subdivision/face_cone.h"

#include <cmath>

#include <Eigen/Dense>

namespace starcell {
namespace {

using Vec2d = Eigen::Vector2d;

Vec2d normal_of(const FaceLine& line) { return {middle(line.nb), middle(line.nc)}; }

// The point nearest to all lines, if it is on all of their planes to within thickness and rounding.
std::optional<Vec2d> common_point(const FaceProblem& in, const FaceLines& face) {
  Eigen::Matrix2d a = Eigen::Matrix2d::Zero();
  Vec2d b = Vec2d::Zero();
  for (const FaceLine& line : face.lines) {
    const Vec2d n = normal_of(line);
    a += n * n.transpose() / n.squaredNorm();
    b += n * middle(line.d) / n.squaredNorm();
  }
  const Vec2d x = a.fullPivLu().solve(b);
  const double margin = 1e-9 * face.size;
  if (!(x.minCoeff() > margin) || !(x.maxCoeff() < face.size - margin)) return std::nullopt;
  const Vec3 far = face.low.cwiseAbs() + Vec3::Constant(face.size);
  const double rounding = 1e-13 * far.maxCoeff();
  for (const FaceLine& line : face.lines) {
    const double thickness = in.restriction.table().surfaces[line.surface].thickness;
    if (std::abs(normal_of(line).dot(x) - middle(line.d)) > thickness + rounding) return std::nullopt;
  }
  return x;
}

// A ray of E: from the common point to an end on the rim.
struct Ray {
  int line;
  bool start;
  bool enters;   // the walk around the rim passes into E's solid
};

std::vector<Ray> rays_of_surface(const FaceProblem& in, const FaceLines& face) {
  Membership mask = in.restriction.mask_at(in.problem, in.face.corner(0, 0));
  bool value = in.problem.expression.value(mask);
  std::vector<Ray> rays;
  for (const LineEnd& end : face.ends) {
    const FaceLine& line = face.lines[end.line];
    mask ^= end.start ? line.covered.front() : line.covered.back();
    const bool next = in.problem.expression.value(mask);
    if (next != value) rays.push_back({end.line, end.start, next});
    value = next;
  }
  return rays;
}

// Along a ray, away from the common point: lines run from start to end in direction (-nc, nb).
Vec2d direction(const FaceLines& face, const Ray& ray) {
  const Vec2d n = normal_of(face.lines[ray.line]).normalized();
  const Vec2d along(-n.y(), n.x());
  return ray.start ? Vec2d(-along) : along;
}

// The middle of the sector from u counter-clockwise to v.
Vec2d bisector(const Vec2d& u, const Vec2d& v) {
  const Vec2d sum = u + v;
  if (sum.norm() < 1e-6) return {-u.y(), u.x()};
  return u.x() * v.y() - u.y() * v.x() > 0 ? Vec2d(sum.normalized()) : Vec2d(-sum.normalized());
}

}  // namespace

std::optional<std::vector<Arc>> cone_pieces(const FaceProblem& in) {
  auto face = face_lines(in);
  if (!face || face->lines.size() < 3) return std::nullopt;  // two lines always cross: F-planes
  const auto x = common_point(in, *face);
  if (!x) return std::nullopt;
  for (FaceLine& line : face->lines) line.others.assign(1, -1);  // two rays each
  const bool covered = face->cover(in, [](const FaceLine& line, const PieceEnd& end) {
    if (end.side < 0) return 1;
    return end.side == side_name[line.start_side] ? 0 : end.side == side_name[line.end_side] ? 2 : -1;
  });
  if (!covered) return std::nullopt;
  const std::vector<Ray> rays = rays_of_surface(in, *face);
  if (rays.size() % 2 != 0) return std::nullopt;
  std::vector<Arc> arcs;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const Ray &enter = rays[k], &leave = rays[(k + 1) % rays.size()];
    if (!enter.enters) continue;
    Arc arc;
    arc.start = face->crossing(in, enter.line, enter.start);
    arc.end = face->crossing(in, leave.line, leave.start);
    arc.surfaces.push_back(face->lines[enter.line].surface);
    arc.facet = facet_on(in, face->lines[enter.line].surface);
    arc.concurrent = true;
    arc.contact = rays.size() > 2;
    if (arc.contact || enter.line != leave.line) {
      Vec2d at = *x;
      if (arc.contact) at += in.pull * bisector(direction(*face, enter), direction(*face, leave));
      Vec3 bend = face->low;
      bend[in.face.b_axis()] += at.x();
      bend[in.face.c_axis()] += at.y();
      arc.bends.push_back(bend);
      arc.surfaces.push_back(face->lines[leave.line].surface);
    }
    arcs.push_back(std::move(arc));
  }
  return arcs;
}

}  // namespace starcell
