#include "minkowski/flat_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/property_map.h>
#include <CGAL/Convex_hull_traits_adapter_2.h>

namespace starcell {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = CGAL::Pointer_property_map<Kernel::Point_2>::type;

constexpr std::uint32_t none = UINT32_MAX;
// Of coordinates: corners this near to one plane are on it, and sums of corners on two such planes on one. Small facets do not know their
// planes so well: a face is gathered with more patience.
constexpr double flatness = 8e-15, patience = 100;
// Faces of fewer facets are never worth a cover, pairs that make fewer candidates neither.
constexpr std::size_t fewest_facets = 8, fewest_candidates = 500;

double largest_coordinate(const SumOperand& mesh) { return std::max(mesh.box().min().cwiseAbs().maxCoeff(), mesh.box().max().cwiseAbs().maxCoeff()); }

}  // namespace

bool FlatFaces::is_level(const SumOperand& mesh, const Face& face, const Vec3& normal, double flat) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::uint32_t v : face.vertices) {
    const double height = normal.dot(mesh.points()[v] - mesh.points()[face.vertices.front()]);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high - low <= 2 * flat;
}

// From the largest facets outwards, as long as corners stay near the first one's plane: then all have to be on that of the whole, whose
// normal is the sum of all areas. Needles have no normal to compare.
FlatFaces::Side FlatFaces::faces_of(const SumOperand& mesh, double flat) {
  const std::vector<Triangle>& facets = mesh.facets();
  const std::vector<Vec3>& points = mesh.points();
  Side side;
  side.of_facet.assign(facets.size(), none);
  side.of_vertex.resize(points.size());
  std::vector<double> area(facets.size());
  std::vector<std::uint32_t> order(facets.size());
  const auto area_vector = [&](std::uint32_t f) { return Vec3((points[facets[f][1]] - points[facets[f][0]]).cross(points[facets[f][2]] - points[facets[f][0]])); };
  for (std::uint32_t f = 0; f < facets.size(); ++f) order[f] = f, area[f] = area_vector(f).norm();
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t f, std::uint32_t g) { return area[f] > area[g]; });
  std::vector<char> seen(facets.size(), 0);
  for (const std::uint32_t seed : order) {
    if (seen[seed] || mesh.faces()[seed].normals.angle > 1) continue;
    Face face;
    face.normal = mesh.faces()[seed].normals.axis;
    const Vec3& from = points[facets[seed][0]];
    const auto is_on = [&](std::uint32_t f) {
      return area_vector(f).dot(face.normal) >= 0 && std::all_of(facets[f].begin(), facets[f].end(), [&](std::uint32_t v) { return std::abs(face.normal.dot(points[v] - from)) <= patience * flat; });
    };
    face.facets.push_back(seed);
    seen[seed] = 1;
    for (std::size_t k = 0; k < face.facets.size(); ++k)
      for (const std::uint32_t g : mesh.neighbours()[face.facets[k]])
        if (!seen[g] && is_on(g)) seen[g] = 1, face.facets.push_back(g);
    if (face.facets.size() < fewest_facets) continue;
    Vec3 normal = Vec3::Zero();
    for (const std::uint32_t f : face.facets) {
      normal += area_vector(f);
      face.vertices.insert(face.vertices.end(), facets[f].begin(), facets[f].end());
    }
    face.normal = normal.normalized();
    std::sort(face.vertices.begin(), face.vertices.end());
    face.vertices.erase(std::unique(face.vertices.begin(), face.vertices.end()), face.vertices.end());
    if (!is_level(mesh, face, face.normal, flat)) continue;
    for (const std::uint32_t f : face.facets) side.of_facet[f] = static_cast<std::uint32_t>(side.faces.size());
    for (const std::uint32_t v : face.vertices) side.of_vertex[v].push_back(static_cast<std::uint32_t>(side.faces.size()));
    side.faces.push_back(std::move(face));
  }
  return side;
}

FlatFaces::FlatFaces(const SumOperand& a, const SumOperand& b) : a_(a), b_(b) {
  flat_ = flatness * (largest_coordinate(a) + largest_coordinate(b));
  side_a_ = faces_of(a, flat_);
  side_b_ = faces_of(b, flat_);
  covered_.assign(side_a_.faces.size() * side_b_.faces.size(), 0);
  for (std::size_t i = 0; i < side_a_.faces.size(); ++i)
    for (std::size_t j = 0; j < side_b_.faces.size(); ++j) {
      const Face &p = side_a_.faces[i], &q = side_b_.faces[j];
      // Facets by vertices both ways, and about as many pairs of edges.
      if (p.facets.size() * q.vertices.size() + p.vertices.size() * q.facets.size() < fewest_candidates || !(p.normal.dot(q.normal) > 0.5)) continue;
      covered_[i * side_b_.faces.size() + j] = is_level(b, q, p.normal, flat_) && is_level(a, p, q.normal, flat_);
    }
}

std::vector<std::uint32_t> FlatFaces::hull(const SumOperand& mesh, const Face& face, int axis, double sense) {
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  std::vector<Kernel::Point_2> flat;
  std::vector<std::size_t> all, corners;
  for (const std::uint32_t v : face.vertices) {
    all.push_back(flat.size());
    flat.emplace_back(mesh.points()[v][x], mesh.points()[v][y]);
  }
  CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(corners), CGAL::Convex_hull_traits_adapter_2<Kernel, Points>(CGAL::make_property_map(flat)));
  if (sense < 0) std::reverse(corners.begin(), corners.end());
  std::vector<std::uint32_t> result;
  for (const std::size_t k : corners) result.push_back(face.vertices[k]);
  return result;
}

// Corners on a straight side are rounding's: triangles between them would have no plane.
std::vector<SumOrigin> FlatFaces::straightened(const std::vector<SumOrigin>& polygon, double within) const {
  const auto at = [&](std::size_t k) { return Vec3(a_.points()[polygon[k % polygon.size()][0]] + b_.points()[polygon[k % polygon.size()][1]]); };
  std::vector<SumOrigin> kept{polygon.front()};   // extreme along an axis: a corner
  std::size_t last = 0;
  for (std::size_t k = 1; k < polygon.size(); ++k) {
    const Vec3 from = at(last), along = (at(k + 1) - from).normalized();
    bool straight = true;
    for (std::size_t l = last + 1; l <= k && straight; ++l) straight = (at(l) - from).cross(along).norm() <= within;
    if (straight) continue;
    kept.push_back(polygon[k]);
    last = k;
  }
  return kept;
}

// Sides of both hulls, merged by their directions; the polygon is halved again and again, which makes few thin triangles.
std::vector<std::array<SumOrigin, 3>> FlatFaces::cover() const {
  std::vector<std::array<SumOrigin, 3>> result;
  for (std::uint32_t i = 0; i < side_a_.faces.size(); ++i)
    for (std::uint32_t j = 0; j < side_b_.faces.size(); ++j) {
      if (!covered(i, j)) continue;
      const Vec3& n = side_a_.faces[i].normal;
      int axis = 0;
      n.cwiseAbs().maxCoeff(&axis);
      const std::vector<std::uint32_t> p = hull(a_, side_a_.faces[i], axis, n[axis]), q = hull(b_, side_b_.faces[j], axis, n[axis]);
      const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
      const auto extreme = [&](const SumOperand& mesh, const std::vector<std::uint32_t>& corners) {
        const auto lower = [&](std::uint32_t s, std::uint32_t t) {
          const Vec3 d = mesh.points()[s] - mesh.points()[t];
          return d.dot(v) != 0 ? d.dot(v) < 0 : d.dot(u) < 0;
        };
        return static_cast<std::size_t>(std::min_element(corners.begin(), corners.end(), lower) - corners.begin());
      };
      const std::size_t first_p = extreme(a_, p), first_q = extreme(b_, q);
      const auto side = [](const SumOperand& mesh, const std::vector<std::uint32_t>& corners, std::size_t k) {
        return Vec3(mesh.points()[corners[(k + 1) % corners.size()]] - mesh.points()[corners[k % corners.size()]]);
      };
      std::vector<SumOrigin> polygon;
      for (std::size_t s = 0, t = 0; s < p.size() || t < q.size();) {
        polygon.push_back({p[(first_p + s) % p.size()], q[(first_q + t) % q.size()]});
        const double turn = s == p.size() ? -1 : t == q.size() ? 1 : n.dot(side(a_, p, first_p + s).cross(side(b_, q, first_q + t)));
        if (turn >= 0) ++s;
        if (turn <= 0) ++t;
      }
      polygon = straightened(polygon, flat_);
      std::vector<std::pair<std::size_t, std::size_t>> spans{{0, polygon.size() - 1}};
      while (!spans.empty()) {
        const auto [from, to] = spans.back();
        spans.pop_back();
        if (to - from < 2) continue;
        const std::size_t middle = (from + to) / 2;
        result.push_back({polygon[from], polygon[middle], polygon[to]});
        spans.emplace_back(from, middle);
        spans.emplace_back(middle, to);
      }
    }
  return result;
}

bool FlatFaces::cover_facet(std::uint32_t facet, std::uint32_t vertex, bool turned) const {
  const Side &with_facet = turned ? side_b_ : side_a_, &with_vertex = turned ? side_a_ : side_b_;
  const std::uint32_t face = with_facet.of_facet[facet];
  if (face == none) return false;
  const auto& others = with_vertex.of_vertex[vertex];
  return std::any_of(others.begin(), others.end(), [&](std::uint32_t other) { return turned ? covered(other, face) : covered(face, other); });
}

// Edges of one plane have its normal in common, and no other.
bool FlatFaces::cover_edges(const SumOperand::Edge& e, const SumOperand::Edge& f) const {
  for (const std::uint32_t s : e.facets)
    for (const std::uint32_t t : f.facets)
      if (side_a_.of_facet[s] != none && side_b_.of_facet[t] != none && covered(side_a_.of_facet[s], side_b_.of_facet[t])) return true;
  return false;
}

}  // namespace starcell
