#include "minkowski/meeting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solids/disjoint_sets.h"
#include "solids/upward_ray.h"

namespace starcell {
namespace {

// Crossings at a box's middle that are tried before it is said to be uncertain.
constexpr int most_prisms = 48;
// Directions that at least this part of an operand's area faces are looked along, the first so many.
constexpr double worthwhile_share = 0.15;
constexpr std::size_t most_directions = 3, most_clusters = 64;
constexpr double same_direction = 0.9999;

std::vector<std::uint32_t> shells_of(const SumOperand& mesh) {
  DisjointSets sets(mesh.points().size());
  for (const Triangle& t : mesh.facets()) sets.join(sets.root(t[0]), sets.root(t[1])), sets.join(sets.root(t[0]), sets.root(t[2]));
  std::vector<char> seen(mesh.points().size(), 0);
  std::vector<std::uint32_t> result;
  for (const Triangle& t : mesh.facets()) {
    const std::uint32_t r = sets.root(t[0]);
    if (!seen[r]) seen[r] = 1, result.push_back(t[0]);
  }
  return result;
}

double largest(const Vec3& v) { return v.cwiseAbs().maxCoeff(); }

int sign_beyond(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

}  // namespace

bool is_inside(const SumOperand& mesh, const FacetTree& tree, const Vec3& x) {
  bool inside = mesh.inside_out();
  const auto& nodes = tree.nodes();
  if (nodes.empty()) return inside;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const FacetTree::Node& node = nodes[stack.back()];
    stack.pop_back();
    const Vec3 &low = node.box.min(), &high = node.box.max();
    // The ray leaves from a point an infinitesimal step aside: what only touches its line may be above it.
    if (x.x() < low.x() || x.x() > high.x() || x.y() < low.y() || x.y() > high.y() || x.z() > high.z()) continue;
    if (node.child != 0) {
      stack.push_back(node.child);
      stack.push_back(node.child + 1);
      continue;
    }
    for (std::uint32_t k = node.first; k < node.last; ++k) {
      const Triangle& t = mesh.facets()[tree.order()[k]];
      if (is_above(mesh.points()[t[0]], mesh.points()[t[1]], mesh.points()[t[2]], x)) inside = !inside;
    }
  }
  return inside;
}

Meeting::Meeting(const SumOperand& a, const SumOperand& b)
    : a_(a), b_(b), tree_a_(a.points(), a.facets()), tree_b_(b.points(), b.facets()), shapes_a_(shapes_of(a)), shapes_b_(shapes_of(b)), directions_(directions_of(a, b)),
      reaches_a_(reaches_of(a, tree_a_, directions_)), reaches_b_(reaches_of(b, tree_b_, directions_)), shells_a_(shells_of(a)), shells_b_(shells_of(b)) {
  // x is of the size of a + b where it matters; x - b and its difference from a round a few times at most.
  const double size = std::max(largest(a.box().min()), largest(a.box().max())) + std::max(largest(b.box().min()), largest(b.box().max()));
  rounding_ = 16 * 1.1102230246251565e-16 * size;
}

std::vector<Meeting::Shape> Meeting::shapes_of(const SumOperand& mesh) {
  std::vector<Shape> shapes;
  for (const Triangle& t : mesh.facets()) {
    const Vec3 &p = mesh.points()[t[0]], &q = mesh.points()[t[1]], &r = mesh.points()[t[2]];
    const std::array<Vec3, 3> edges{q - p, r - q, p - r};
    shapes.push_back({edges, edges[0].cross(r - p), std::max({largest(edges[0]), largest(edges[1]), largest(edges[2])})});
  }
  return shapes;
}

// Rounded as in crosses().
bool Meeting::beside(const Shape& facet, const Vec3& p, const std::array<Vec3, 3>& points) const {
  const double error = 24 * rounding_ * facet.base * facet.base;
  int side = 0;
  for (const Vec3& q : points) {
    const int s = sign_beyond(facet.normal.dot(q - p), error);
    if (s == 0 || s == -side) return false;
    side = s;
  }
  return true;
}

// The volumes of the tetrahedra between segment and facet. Only the place of one in respect of the other is known no better than to
// `rounding_`: it meets products of two edges, six of them a volume. (What the products round by is less than that again, since no
// length here is more than three times the coordinates'.)
Meeting::Answer Meeting::crosses(const Shape& facet, double sense, const Vec3& corner, const Vec3& s, const Vec3& d) const {
  const Vec3 p = corner - s;
  const double error = 24 * rounding_ * facet.base * facet.base;
  const double at_s = -facet.normal.dot(p), at_t = facet.normal.dot(d) + at_s;
  const int side_s = sign_beyond(at_s, error), side_t = sign_beyond(at_t, error);
  if (side_s * side_t > 0) return Answer::no;
  const Vec3 q = p + sense * facet.edges[0], r = p - sense * facet.edges[2];
  const double around = 24 * rounding_ * facet.base * largest(d);
  const int a = sign_beyond(d.dot(p.cross(facet.edges[0])), around), b = sign_beyond(d.dot(q.cross(facet.edges[1])), around);
  if (a * b < 0) return Answer::no;
  const int c = sign_beyond(d.dot(r.cross(facet.edges[2])), around);
  if (a * c < 0 || b * c < 0) return Answer::no;
  return side_s * side_t < 0 && a != 0 && a == b && a == c ? Answer::yes : Answer::unknown;
}

template <class Visit>
bool Meeting::facets_cross(std::uint32_t f, std::uint32_t g, const Vec3& x, bool& uncertain, Visit& visit) const {
  const Triangle &of_a = a_.facets()[f], &of_b = b_.facets()[g];
  const std::vector<Vec3> &p = a_.points(), &q = b_.points();
  const std::array<Vec3, 3> fixed{p[of_a[0]], p[of_a[1]], p[of_a[2]]}, moved{x - q[of_b[0]], x - q[of_b[1]], x - q[of_b[2]]};
  const Shape &one = shapes_a_[f], &other = shapes_b_[g];
  if (beside(one, fixed[0], moved) || beside(other, moved[0], fixed)) return false;
  for (int k = 0; k < 3; ++k) {
    // Every edge belongs to two facets: one of its two directions is looked at.
    const int l = (k + 1) % 3;
    if (of_b[k] < of_b[l]) {
      const Answer answer = crosses(one, 1, fixed[0], moved[k], -other.edges[k]);
      if (answer == Answer::unknown) uncertain = true;
      if (answer == Answer::yes && visit(f, of_b[k], of_b[l], true)) return true;
    }
    if (of_a[k] < of_a[l]) {
      const Answer answer = crosses(other, -1, moved[0], fixed[k], one.edges[k]);
      if (answer == Answer::unknown) uncertain = true;
      if (answer == Answer::yes && visit(g, of_a[k], of_a[l], false)) return true;
    }
  }
  return false;
}

std::vector<Vec3> Meeting::directions_of(const SumOperand& a, const SumOperand& b) {
  std::vector<std::pair<double, Vec3>> areas;   // of clusters of normals, up to sense
  for (const SumOperand* mesh : {&a, &b}) {
    std::vector<std::pair<double, Vec3>> own;
    double whole = 0;
    for (const SumOperand::Face& face : mesh->faces()) {
      const Triangle& t = mesh->facets()[face.facet];
      const double area = (mesh->points()[t[1]] - mesh->points()[t[0]]).cross(mesh->points()[t[2]] - mesh->points()[t[0]]).norm();
      whole += area;
      const auto same = std::find_if(own.begin(), own.end(), [&](const auto& cluster) { return std::abs(cluster.second.dot(face.normals.axis)) > same_direction; });
      if (same != own.end()) same->first += area;
      else if (own.size() < most_clusters) own.emplace_back(area, face.normals.axis);
    }
    for (const auto& [area, normal] : own)
      if (area > worthwhile_share * whole) areas.emplace_back(area / whole, normal);
  }
  std::stable_sort(areas.begin(), areas.end(), [](const auto& s, const auto& t) { return s.first > t.first; });
  std::vector<Vec3> directions;
  for (const auto& [area, normal] : areas) {
    const bool known = normal.cwiseAbs().maxCoeff() > same_direction || std::any_of(directions.begin(), directions.end(), [&](const Vec3& d) { return std::abs(d.dot(normal)) > same_direction; });
    if (!known && directions.size() < most_directions) directions.push_back(normal);
  }
  return directions;
}

std::vector<Meeting::Reach> Meeting::reaches_of(const SumOperand& mesh, const FacetTree& tree, const std::vector<Vec3>& directions) {
  const std::size_t n = directions.size();
  std::vector<Reach> reaches(n * tree.nodes().size(), {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
  for (std::size_t node = tree.nodes().size(); node-- > 0;) {   // children come after their parents
    const FacetTree::Node& of = tree.nodes()[node];
    const auto extend = [&](std::size_t k, double low, double high) {
      Reach& reach = reaches[n * node + k];
      reach = {std::min(reach.low, low), std::max(reach.high, high)};
    };
    for (std::size_t k = 0; k < n; ++k)
      if (of.child != 0) {
        for (const std::size_t child : {of.child, of.child + 1}) extend(k, reaches[n * child + k].low, reaches[n * child + k].high);
      } else {
        for (std::uint32_t f = of.first; f < of.last; ++f)
          for (const std::uint32_t v : mesh.facets()[tree.order()[f]]) extend(k, directions[k].dot(mesh.points()[v]), directions[k].dot(mesh.points()[v]));
      }
  }
  return reaches;
}

// Along a direction as along an axis: products of three terms round by no more than three coordinates do.
bool Meeting::are_apart(std::uint32_t of_a, std::uint32_t of_b, const Vec3& x) const {
  const FacetTree::Node &m = tree_a_.nodes()[of_a], &n = tree_b_.nodes()[of_b];
  for (int k = 0; k < 3; ++k)
    if (x[k] - n.box.max()[k] - m.box.max()[k] > rounding_ || m.box.min()[k] - x[k] + n.box.min()[k] > rounding_) return true;
  const std::size_t count = directions_.size();
  for (std::size_t k = 0; k < count; ++k) {
    const double at = directions_[k].dot(x);
    const Reach &a = reaches_a_[count * of_a + k], &b = reaches_b_[count * of_b + k];
    if (at - b.high - a.high > 3 * rounding_ || a.low - at + b.low > 3 * rounding_) return true;
  }
  return false;
}

template <class Visit>
bool Meeting::crossings(const Vec3& x, Visit visit) const {
  const auto &nodes_a = tree_a_.nodes(), &nodes_b = tree_b_.nodes();
  if (nodes_a.empty() || nodes_b.empty()) return false;
  bool uncertain = false;
  thread_local std::vector<std::pair<std::uint32_t, std::uint32_t>> reused;
  auto& stack = reused;
  stack.assign(1, {0, 0});
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    const FacetTree::Node &m = nodes_a[i], &n = nodes_b[j];
    if (are_apart(i, j, x)) continue;
    if (m.child == 0 && n.child == 0) {
      for (std::uint32_t k = m.first; k < m.last; ++k)
        for (std::uint32_t l = n.first; l < n.last; ++l)
          if (facets_cross(tree_a_.order()[k], tree_b_.order()[l], x, uncertain, visit)) return uncertain;
    } else if (n.child == 0 || (m.child != 0 && m.last - m.first >= n.last - n.first)) {
      stack.emplace_back(m.child, j);
      stack.emplace_back(m.child + 1, j);
    } else {
      stack.emplace_back(i, n.child);
      stack.emplace_back(i, n.child + 1);
    }
  }
  return uncertain;
}

// With boundaries apart. (x - b is rounded, by less than what keeps the boundaries apart.)
bool Meeting::contained(const Vec3& x) const {
  for (const std::uint32_t v : shells_b_)
    if (is_inside(a_, tree_a_, x - b_.points()[v])) return true;
  for (const std::uint32_t v : shells_a_)
    if (is_inside(b_, tree_b_, x - a_.points()[v])) return true;
  return false;
}

std::optional<bool> Meeting::at(const Vec3& x) const {
  bool yes = false;
  const bool uncertain = crossings(x, [&](std::uint32_t, std::uint32_t, std::uint32_t, bool) { return yes = true; });
  if (yes) return true;
  if (uncertain) return std::nullopt;
  return contained(x);
}

bool Meeting::throughout(const Box3& box) const {
  bool found = false;
  int tried = 0;
  const std::vector<Vec3> &p = a_.points(), &q = b_.points();
  const auto holds_all = [&](std::uint32_t facet, std::uint32_t from, std::uint32_t to, bool of_a) {
    const Triangle& t = of_a ? a_.facets()[facet] : b_.facets()[facet];
    found = true;
    for (int corner = 0; corner < 8 && found; ++corner) {
      const Vec3 x = box.corner(static_cast<Box3::CornerType>(corner));
      found = (of_a ? crosses(shapes_a_[facet], 1, p[t[0]], x - q[from], q[from] - q[to])
                    : crosses(shapes_b_[facet], -1, x - q[t[0]], p[from], p[to] - p[from])) == Answer::yes;
    }
    return found || ++tried >= most_prisms;
  };
  crossings(box.center(), holds_all);
  return found;
}

}  // namespace starcell
