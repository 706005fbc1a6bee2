#include "repair/winding_solid.h"

#include "numerics/predicates.h"
#include "solids/triangle_pair.h"
#include "solids/upward_ray.h"

namespace starcell {
namespace {

std::vector<Triangle> with_area(const std::vector<Vec3>& points, std::vector<Triangle> triangles) {
  std::erase_if(triangles, [&](const Triangle& t) { return has_no_area(points[t[0]], points[t[1]], points[t[2]]); });
  return triangles;
}

}  // namespace

WindingSolid::WindingSolid(std::vector<Vec3> vertices, const std::vector<Triangle>& triangles)
    : points_(std::move(vertices)), facets_(with_area(points_, triangles)), merged_(points_.size(), 0), tree_(points_, facets_), rays_(points_, facets_) {
  for (std::uint32_t f = 0; f < facets_.size(); ++f) {
    partners_.push_back(f);
    for (const std::uint32_t v : facets_[f]) box_.extend(points_[v]);
  }
}

std::shared_ptr<const WindingSolid> WindingSolid::transformed(const Eigen::Matrix4d& map) const {
  std::vector<Vec3> moved;
  for (const Vec3& p : points_) moved.push_back(map.block<3, 3>(0, 0) * p + map.block<3, 1>(0, 3));
  std::vector<Triangle> triangles = facets_;
  if (map.block<3, 3>(0, 0).determinant() < 0)
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return std::make_shared<const WindingSolid>(std::move(moved), triangles);
}

int WindingSolid::winding_number(const Vec3& x) const {
  int sum = 0;
  rays_.above(x, [&](std::uint32_t f) {
    const Vec3 &a = points_[facets_[f][0]], &b = points_[facets_[f][1]], &c = points_[facets_[f][2]];
    if (is_above(a, b, c, x)) sum += turn(project(a, 2), project(b, 2), project(c, 2)) > 0 ? 1 : -1;
  });
  return sum;
}

template <class Visit>
bool WindingSolid::near(const Box3& box, const Visit& visit) const {
  if (facets_.empty()) return false;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const FacetTree::Node& node = tree_.nodes()[stack.back()];
    stack.pop_back();
    if (!node.box.intersects(box)) continue;
    if (node.child != 0) {
      stack.push_back(node.child);
      stack.push_back(node.child + 1);
      continue;
    }
    for (std::uint32_t k = node.first; k < node.last; ++k)
      if (visit(tree_.order()[k])) return true;
  }
  return false;
}

std::optional<bool> WindingSolid::contains(const Vec3& x) const {
  const auto on_plane = [&](std::uint32_t f) {
    const Vec3 &a = points_[facets_[f][0]], &b = points_[facets_[f][1]], &c = points_[facets_[f][2]];
    return Box3(a).extend(b).extend(c).contains(x) && side(a, b, c, x) == 0;
  };
  if (near(Box3(x, x), on_plane)) return std::nullopt;
  return winding_number(x) >= 1;
}

std::optional<bool> WindingSolid::constant(const Box3& box) const {
  const auto may_meet = [&](std::uint32_t f) {
    const Vec3 &a = points_[facets_[f][0]], &b = points_[facets_[f][1]], &c = points_[facets_[f][2]];
    if (!Box3(a).extend(b).extend(c).intersects(box)) return false;
    int sides = 0;   // of its plane, that corners of the box are on
    for (int corner = 0; corner < 8; ++corner) {
      const int s = side(a, b, c, box.corner(static_cast<Box3::CornerType>(corner)));
      sides |= s > 0 ? 1 : s < 0 ? 2 : 3;
    }
    return sides == 3;
  };
  if (near(box, may_meet)) return std::nullopt;
  return winding_number(box.center()) >= 1;
}

}  // namespace starcell
