#include "cad/free_form_deflection.h"

#include <limits>

#include "cad/edge_deflection.h"

namespace starcell::cad {
namespace {

constexpr int steps = 4;  ///< samples sit at barycentric coordinates that are multiples of 1 / steps

struct Sample {
  Vec3 point;
  Vec3 du, dv;
};

Sample evaluate(const BRepAdaptor_Surface& surface, const gp_XY& uv) {
  gp_Pnt p;
  gp_Vec du, dv;
  surface.D1(uv.X(), uv.Y(), p, du, dv);
  return {{p.X(), p.Y(), p.Z()}, {du.X(), du.Y(), du.Z()}, {dv.X(), dv.Y(), dv.Z()}};
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length2 = (b - a).squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
  return (p - a - s * (b - a)).norm();
}

double distance_to_triangle(const Vec3& p, const std::array<SurfacePoint, 3>& t) {
  const Vec3 normal = (t[1].point - t[0].point).cross(t[2].point - t[0].point);
  bool above = normal.squaredNorm() > 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = t[k].point, &b = t[(k + 1) % 3].point;
    above = above && normal.cross(b - a).dot(p - a) >= 0;
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return above ? std::abs(normal.normalized().dot(p - t[0].point)) : nearest;
}

/// Upper bound of the distance from p to the surface: Gauss-Newton from uv, kept while it comes nearer.
double distance_to_surface(const Vec3& p, gp_XY uv, Sample at, const BRepAdaptor_Surface& surface) {
  double best = (p - at.point).norm();
  for (int round = 0; round < 3; ++round) {
    const double a = at.du.dot(at.du), b = at.du.dot(at.dv), c = at.dv.dot(at.dv), determinant = a * c - b * b;
    if (!(determinant > 1e-12 * a * c)) break;
    const Vec3 off = p - at.point;
    const double x = off.dot(at.du), y = off.dot(at.dv);
    uv += gp_XY((c * x - b * y) / determinant, (a * y - b * x) / determinant);
    uv.SetX(std::clamp(uv.X(), surface.FirstUParameter(), surface.LastUParameter()));
    uv.SetY(std::clamp(uv.Y(), surface.FirstVParameter(), surface.LastVParameter()));
    at = evaluate(surface, uv);
    const double now = (p - at.point).norm();
    if (now >= best) break;
    best = now;
  }
  return best;
}

}  // namespace

double triangle_deflection(const std::array<SurfacePoint, 3>& t, const BRepAdaptor_Surface& surface, double worst) {
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      if (i == steps || j == steps || i + j == 0) continue;  // corners
      const double wa = double(i) / steps, wb = double(j) / steps, wc = 1 - wa - wb;
      const gp_XY uv = t[0].parameter * wa + t[1].parameter * wb + t[2].parameter * wc;
      const Vec3 p = t[0].point * wa + t[1].point * wb + t[2].point * wc;
      const Sample at = evaluate(surface, uv);
      if ((p - at.point).norm() <= worst) continue;
      worst = std::max(worst, distance_to_triangle(at.point, t));
      if ((p - at.point).norm() > worst) worst = std::max(worst, distance_to_surface(p, uv, at, surface));
    }
  return worst;
}

double free_form_deflection(const FaceMesh& face, const std::vector<std::uint32_t>& node_vertices,
                            const std::vector<Vec3>& vertices) {
  const Poly_Triangulation& triangulation = *face.triangulation;
  if (!triangulation.HasUVNodes()) return std::numeric_limits<double>::infinity();
  const BRepAdaptor_Surface surface(face.face);
  double worst = 0;
  for (int i = 1; i <= triangulation.NbTriangles(); ++i) {
    int node[3];
    triangulation.Triangle(i).Get(node[0], node[1], node[2]);
    std::array<SurfacePoint, 3> t;
    for (int k = 0; k < 3; ++k) {
      t[k] = {vertices[node_vertices[node[k] - 1]], triangulation.UVNode(node[k]).XY()};
      const Sample at = evaluate(surface, t[k].parameter);
      worst = std::max(worst, distance_to_surface(t[k].point, t[k].parameter, at, surface) / sampling_margin);
    }
    worst = triangle_deflection(t, surface, worst);
  }
  return worst * sampling_margin;
}

}  // namespace starcell::cad
