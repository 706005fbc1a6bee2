#include "subdivision/grid_line.h"

#include <algorithm>

#include "numerics/predicates.h"

namespace starcell {
namespace {

// Is the rectangle of the box's projection along `axis` strictly on one side of the line p -> q? Returns that side.
// Only the two corners that are extreme across the line decide; differences of doubles have exact signs.
int rectangle_side(const Vec3& p3, const Vec3& q3, const Box3& box, int axis) {
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  const Vec2 p{p3[x], p3[y]}, q{q3[x], q3[y]};
  const bool up = q.x > p.x, right = q.y > p.y;
  if (p.x == q.x && p.y == q.y) return 0;
  const Vec2 leftmost{right ? box.min()[x] : box.max()[x], up ? box.max()[y] : box.min()[y]};
  if (turn_grid(p, q, leftmost, x, y) < 0) return -1;
  const Vec2 rightmost{right ? box.max()[x] : box.min()[x], up ? box.min()[y] : box.max()[y]};
  if (turn_grid(p, q, rightmost, x, y) > 0) return 1;
  return 0;
}

bool outside_slab(const Box3& box, int axis, double low, double high) {
  return high <= box.min()[axis] || low > box.max()[axis];
}

}  // namespace

int line_meets(const FacetTable& table, std::uint32_t facet, int axis, const Vec3& p) {
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  const Vec3 &a = table.corner(facet, 0), &b = table.corner(facet, 1), &c = table.corner(facet, 2);
  // A coordinate equal to the grid's is below it: see below().
  if (std::max({a[x], b[x], c[x]}) <= p[x] || std::min({a[x], b[x], c[x]}) > p[x]) return 0;
  if (std::max({a[y], b[y], c[y]}) <= p[y] || std::min({a[y], b[y], c[y]}) > p[y]) return 0;
  const Vec2 g = project(p, axis), pa = project(a, axis), pb = project(b, axis), pc = project(c, axis);
  const int s = turn_grid(pa, pb, g, x, y);
  if (s == 0 || turn_grid(pb, pc, g, x, y) != s || turn_grid(pc, pa, g, x, y) != s) return 0;
  return s;
}

bool crossing_below(const FacetTable& table, std::uint32_t facet, int sign, const Vec3& p) {
  return side_grid(table.corner(facet, 0), table.corner(facet, 1), table.corner(facet, 2), p) == sign;
}

bool segment_crosses(const FacetTable& table, std::uint32_t facet, int axis, const Vec3& p, double to) {
  const double low = std::min(p[axis], to), high = std::max(p[axis], to);
  const double a = table.corner(facet, 0)[axis], b = table.corner(facet, 1)[axis], c = table.corner(facet, 2)[axis];
  if (std::max({a, b, c}) <= low || std::min({a, b, c}) > high) return false;
  const int sign = line_meets(table, facet, axis, p);
  if (sign == 0) return false;
  Vec3 end = p;
  end[axis] = low;
  if (crossing_below(table, facet, sign, end)) return false;
  end[axis] = high;
  return crossing_below(table, facet, sign, end);
}

bool box_meets_segment(const Vec3& p, const Vec3& q, const Box3& box) {
  for (int k = 0; k < 3; ++k)
    if (outside_slab(box, k, std::min(p[k], q[k]), std::max(p[k], q[k]))) return false;
  if (box_contains(box, p) || box_contains(box, q)) return true;
  for (int axis = 0; axis < 3; ++axis)
    if (rectangle_side(p, q, box, axis) != 0) return false;
  return true;
}

bool box_meets_facet(const FacetTable& table, std::uint32_t facet, const Box3& box) {
  const std::array<const Vec3*, 3> v{&table.corner(facet, 0), &table.corner(facet, 1), &table.corner(facet, 2)};
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax({(*v[0])[k], (*v[1])[k], (*v[2])[k]});
    if (outside_slab(box, k, low, high)) return false;
  }
  for (const Vec3* p : v)
    if (box_contains(box, *p)) return true;
  // Separating axes across an edge and a coordinate axis: the rectangle on one side, the third corner on the other.
  std::array<int, 3> normal{};
  for (int axis = 0; axis < 3; ++axis) {
    const int winding = turn(project(*v[0], axis), project(*v[1], axis), project(*v[2], axis));
    normal[axis] = winding;
    for (int k = 0; k < 3; ++k) {
      const int s = rectangle_side(*v[k], *v[(k + 1) % 3], box, axis);
      if (s != 0 && s != winding) return false;
    }
  }
  // The facet's plane: the box's corners that are extreme along the normal.
  Vec3 high, low;
  for (int k = 0; k < 3; ++k) {
    high[k] = normal[k] >= 0 ? box.max()[k] : box.min()[k];
    low[k] = normal[k] >= 0 ? box.min()[k] : box.max()[k];
  }
  return side_grid(*v[0], *v[1], *v[2], high) > 0 && side_grid(*v[0], *v[1], *v[2], low) < 0;
}

}  // namespace starcell
