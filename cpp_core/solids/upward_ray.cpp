#include "solids/upward_ray.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "solids/triangle_hierarchy.h"

namespace starcell {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Side of the line a-b, seen from above, on which p + (δ, δ²) lies; 0 only if a and b are one point seen from above.
int side_from_above(const Vec3& a, const Vec3& b, const Vec3& p) {
  const auto flat = [](const Vec3& q) { return Kernel::Point_2(q[0], q[1]); };
  const int sign = CGAL::orientation(flat(a), flat(b), flat(p));
  if (sign != 0) return sign;
  if (a[1] != b[1]) return b[1] > a[1] ? -1 : 1;
  return a[0] == b[0] ? 0 : b[0] > a[0] ? 1 : -1;
}

}  // namespace

bool is_above(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const int turn = side_from_above(a, b, p);
  if (turn == 0 || side_from_above(b, c, p) != turn || side_from_above(c, a, p) != turn) return false;
  const auto point = [](const Vec3& q) { return Kernel::Point_3(q[0], q[1], q[2]); };
  // p below the plane of a, b, c, which run counter-clockwise (turn > 0) seen from above
  return CGAL::orientation(point(a), point(b), point(c), point(p)) * turn < 0;
}

void for_each_above(const Polyhedron& solid, const TriangleHierarchy& hierarchy, const Vec3& p, const std::function<void(std::uint32_t)>& visit) {
  const std::vector<Vec3>& v = solid.vertices();
  hierarchy.above(p, [&](std::uint32_t t) {
    const Triangle& corner = solid.triangles()[t];
    if (is_above(v[corner[0]], v[corner[1]], v[corner[2]], p)) visit(t);
  });
}

}  // namespace starcell
