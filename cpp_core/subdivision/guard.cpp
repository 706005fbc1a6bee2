#include "subdivision/guard.h"

#include "numerics/interval.h"
#include "numerics/linear_program.h"

namespace starcell {
namespace {

Interval3 interval_normal(const FacetTable& table, const OrientedFacet& f) {
  const Vec3 &a = table.corner(f.facet, 0), &b = table.corner(f.facet, f.flip ? 2 : 1),
             &c = table.corner(f.facet, f.flip ? 1 : 2);
  const Interval ux = Interval(b.x()) - a.x(), uy = Interval(b.y()) - a.y(), uz = Interval(b.z()) - a.z();
  const Interval vx = Interval(c.x()) - a.x(), vy = Interval(c.y()) - a.y(), vz = Interval(c.z()) - a.z();
  return {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
}

bool sees_all(const FacetTable& table, const std::vector<OrientedFacet>& facets, const Vec3& u) {
  const Rounding rounding;
  for (const OrientedFacet& f : facets) {
    const Interval3 n = interval_normal(table, f);
    if (certain_sign(n.x * u.x() + n.y * u.y() + n.z * u.z()) <= 0) return false;
  }
  return true;
}

// +1 / -1 when o is certified to lie behind / before every facet's plane.
int sees_star(const FacetTable& table, const std::vector<OrientedFacet>& facets, const Vec3& o) {
  const Rounding rounding;
  int all = 0;
  for (const OrientedFacet& f : facets) {
    const Interval3 n = interval_normal(table, f);
    const Vec3& p = table.corner(f.facet, 0);
    const int s = certain_sign(n.x * (Interval(p.x()) - o.x()) + n.y * (Interval(p.y()) - o.y()) +
                               n.z * (Interval(p.z()) - o.z()));
    if (s == 0 || (all != 0 && s != all)) return 0;
    all = s;
  }
  return all;
}

std::vector<Vec3> unit_normals(const FacetTable& table, const std::vector<OrientedFacet>& facets, int flat_axis) {
  std::vector<Vec3> normals;
  for (const OrientedFacet& f : facets) {
    Vec3 n = table.area_vector(f.facet) * (f.flip ? -1.0 : 1.0);
    if (flat_axis >= 0) n[flat_axis] = 0;
    const double length = n.norm();
    normals.push_back(length > 0 ? Vec3(n / length) : n);
  }
  return normals;
}

}  // namespace

std::optional<Vec3> find_direction(const FacetTable& table, const std::vector<OrientedFacet>& facets, int flat_axis,
                                   Statistics& statistics) {
  const std::vector<Vec3> normals = unit_normals(table, facets, flat_axis);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& n : normals) mean += n;
  if (mean.norm() > 0 && sees_all(table, facets, mean)) {
    count(statistics.guard_witness);
    return mean.normalized();
  }
  if (auto u = widest_direction(normals)) {
    if (flat_axis >= 0) (*u)[flat_axis] = 0;
    if (u->norm() > 0 && sees_all(table, facets, *u)) {
      count(statistics.guard_program);
      return u->normalized();
    }
  }
  count(statistics.guard_failed);
  return std::nullopt;
}

std::optional<Vec3> find_guard(const FacetTable& table, const std::vector<OrientedFacet>& facets, const Box3& around,
                               int flat_axis, double plane, Statistics& statistics) {
  const std::vector<Vec3> normals = unit_normals(table, facets, -1);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& n : normals) mean += n;
  const double reach = 4 * around.sizes().norm();
  // The witness: far behind the surface along its mean normal, where a direction is almost a point.
  Vec3 far = around.center() - mean.normalized() * reach;
  if (flat_axis >= 0) far[flat_axis] = plane;
  if (far.allFinite() && sees_star(table, facets, far) != 0) {
    count(statistics.guard_witness);
    return far;
  }
  Box3 search(around.center() - Vec3::Constant(reach), around.center() + Vec3::Constant(reach));
  if (flat_axis >= 0) search.min()[flat_axis] = search.max()[flat_axis] = plane;
  std::vector<Vec3> points, opposite;
  for (const OrientedFacet& f : facets) points.push_back(table.corner(f.facet, 0));
  for (const Vec3& n : normals) opposite.push_back(-n);
  for (const auto& rows : {normals, opposite}) {
    auto o = deepest_point(rows, points, search);
    if (!o) continue;
    if (flat_axis >= 0) (*o)[flat_axis] = plane;
    if (sees_star(table, facets, *o) != 0) {
      count(statistics.guard_program);
      return o;
    }
  }
  count(statistics.guard_failed);
  return std::nullopt;
}

}  // namespace starcell
