// A point of A that lies in x - B for every x of a box: so the box is inside A ⊕ B, even where no crossing of an edge and a facet lasts
// through the box, as when faces of both solids are in line.
//
// Points are looked for where facets of both cross at the box's middle, a little way inwards from there: whether one does is proved apart
// from how it was found. Guarantees: true is certain (exact parity, and facets kept clear of by boxes wider than all rounding); false says
// nothing.
#include <algorithm>
#include <cmath>

#include "minkowski/meeting.h"

namespace starcell {
namespace {

// Pairs of facets that are looked at, and points that are tried.
constexpr int most_pairs = 4096, most_points = 96;
// How far from where facets cross points are tried, of the box's half diagonal.
constexpr double ways_in[] = {1.5, 4, 16, 64};

// Might the triangle meet the box? Axes and the triangle's plane are asked; `rounding` is of a coordinate.
bool may_meet(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& normal, const Vec3& middle, const Vec3& half) {
  const Vec3 low = p.cwiseMin(q).cwiseMin(r), high = p.cwiseMax(q).cwiseMax(r);
  if ((low.array() > (middle + half).array()).any() || (high.array() < (middle - half).array()).any()) return false;
  const double off = std::abs(normal.dot(middle - p)), reach = normal.cwiseAbs().dot(half);
  const double error = 1e-14 * normal.cwiseAbs().dot((middle - p).cwiseAbs() + half);
  return off <= reach + error;
}

// Where the triangle crosses the plane: the ends of a segment. None: it does not, or lies in the plane.
bool cut(const std::array<Vec3, 3>& t, const Vec3& normal, const Vec3& p, std::array<Vec3, 2>& ends) {
  std::array<double, 3> at;
  for (int k = 0; k < 3; ++k) at[k] = normal.dot(t[k] - p);
  const double flat = 1e-9 * std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
  int found = 0;
  std::array<Vec3, 6> points;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    if (std::abs(at[k]) <= flat) points[found++] = t[k];
    else if (std::abs(at[l]) > flat && at[k] * at[l] < 0) points[found++] = t[k] + at[k] / (at[k] - at[l]) * (t[l] - t[k]);
  }
  if (found < 2) return false;
  ends = {points[0], points[1]};
  return true;
}

// The middle of what both triangles cross in, roughly.
bool crossing_of(const std::array<Vec3, 3>& one, const Vec3& n, const std::array<Vec3, 3>& other, const Vec3& m, Vec3& middle) {
  std::array<Vec3, 2> s, t;
  if (!cut(one, m, other[0], s) || !cut(other, n, one[0], t)) return false;
  const Vec3 along = n.cross(m);
  const auto sorted = [&](std::array<Vec3, 2>& ends) {
    if (along.dot(ends[0]) > along.dot(ends[1])) std::swap(ends[0], ends[1]);
  };
  sorted(s);
  sorted(t);
  const Vec3 &low = along.dot(s[0]) > along.dot(t[0]) ? s[0] : t[0], &high = along.dot(s[1]) < along.dot(t[1]) ? s[1] : t[1];
  if (along.dot(low) > along.dot(high)) return false;
  middle = 0.5 * (low + high);
  return true;
}

}  // namespace

bool Meeting::is_clear(const SumOperand& mesh, const FacetTree& tree, const std::vector<Shape>& shapes, const Vec3& middle, const Vec3& half) {
  const auto& nodes = tree.nodes();
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const FacetTree::Node& node = nodes[stack.back()];
    stack.pop_back();
    if ((node.box.min().array() > (middle + half).array()).any() || (node.box.max().array() < (middle - half).array()).any()) continue;
    if (node.child != 0) {
      stack.push_back(node.child);
      stack.push_back(node.child + 1);
      continue;
    }
    for (std::uint32_t k = node.first; k < node.last; ++k) {
      const std::uint32_t f = tree.order()[k];
      const Triangle& t = mesh.facets()[f];
      if (may_meet(mesh.points()[t[0]], mesh.points()[t[1]], mesh.points()[t[2]], shapes[f].normal, middle, half)) return false;
    }
  }
  return true;
}

bool Meeting::have_in_common(const Vec3& p, const Vec3& middle, const Vec3& half) const {
  const Vec3 edge = Vec3::Constant(rounding_);
  return is_clear(a_, tree_a_, shapes_a_, p, edge) && is_clear(b_, tree_b_, shapes_b_, middle - p, half + edge) && is_inside(a_, tree_a_, p) &&
         is_inside(b_, tree_b_, middle - p);
}

bool Meeting::share_a_point(const Box3& box) const {
  const auto &nodes_a = tree_a_.nodes(), &nodes_b = tree_b_.nodes();
  if (nodes_a.empty() || nodes_b.empty()) return false;
  const Vec3 x = box.center(), half = (box.max() - x).cwiseMax(x - box.min());
  const double reach = half.norm() + 4 * rounding_;
  int pairs = 0, points = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const FacetTree::Node &m = nodes_a[i], &n = nodes_b[j];
    if (are_apart(i, j, x)) continue;
    if (m.child != 0 && (n.child == 0 || m.last - m.first >= n.last - n.first)) {
      stack.emplace_back(m.child, j);
      stack.emplace_back(m.child + 1, j);
      continue;
    }
    if (n.child != 0) {
      stack.emplace_back(i, n.child);
      stack.emplace_back(i, n.child + 1);
      continue;
    }
    for (std::uint32_t k = m.first; k < m.last; ++k)
      for (std::uint32_t l = n.first; l < n.last; ++l) {
        if (++pairs > most_pairs) return false;
        const std::uint32_t f = tree_a_.order()[k], g = tree_b_.order()[l];
        const Triangle &s = a_.facets()[f], &t = b_.facets()[g];
        const std::vector<Vec3> &p = a_.points(), &q = b_.points();
        const Vec3 &out_a = shapes_a_[f].normal, &out_b = shapes_b_[g].normal;
        Vec3 middle;
        if (!crossing_of({p[s[0]], p[s[1]], p[s[2]]}, out_a, {x - q[t[0]], x - q[t[1]], x - q[t[2]]}, out_b, middle)) continue;
        // Inwards of both: x - B is turned round.
        Vec3 inwards = out_b.normalized() - out_a.normalized();
        if (!(inwards.norm() > 1e-3)) continue;
        inwards.normalize();
        for (const double far : ways_in) {
          if (++points > most_points) return false;
          if (have_in_common(middle + far * reach * inwards, x, half)) return true;
        }
      }
  }
  return false;
}

}  // namespace starcell
