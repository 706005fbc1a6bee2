#include "cad/face_refinement.h"

#include <BRepAdaptor_Surface.hxx>
#include <algorithm>
#include <array>
#include <map>

#include "cad/elementary_surface.h"
#include "cad/free_form_deflection.h"

namespace starcell::cad {
namespace {

constexpr int passes = 24;
constexpr std::size_t most_triangles = 1'000'000;  ///< a face
constexpr double flat = 0.02;                      ///< height over longest side, in lengths on the surface

using Corners = std::array<int, 3>;

class Refinement {
 public:
  Refinement(const FaceMesh& face, double allowed) : face_(face), surface_(face.face), allowed_(allowed) {
    const Poly_Triangulation& mesh = *face.triangulation;
    for (int i = 1; i <= mesh.NbNodes(); ++i) {
      const gp_Pnt p = mesh.Node(i).Transformed(face.placement.Transformation());
      nodes_.push_back({{p.X(), p.Y(), p.Z()}, mesh.UVNode(i).XY()});
    }
    for (int i = 1; i <= mesh.NbTriangles(); ++i) {
      Corners t;
      mesh.Triangle(i).Get(t[0], t[1], t[2]);
      triangles_.push_back({t[0] - 1, t[1] - 1, t[2] - 1});
    }
    bad_.assign(triangles_.size(), 1);
  }

  /// True if anything changed.
  bool run() {
    for (int pass = 0; pass < passes && triangles_.size() < most_triangles; ++pass)
      if (!split_once()) break;
    return changed_;
  }

  Handle(Poly_Triangulation) result() const {
    Handle(Poly_Triangulation) mesh =
        new Poly_Triangulation(static_cast<int>(nodes_.size()), static_cast<int>(triangles_.size()), Standard_True);
    const gp_Trsf back = face_.placement.Transformation().Inverted();
    const int known = face_.triangulation->NbNodes();
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
      const Vec3& p = nodes_[i].point;
      mesh->SetNode(i + 1, i < known ? face_.triangulation->Node(i + 1) : gp_Pnt(p.x(), p.y(), p.z()).Transformed(back));
      mesh->SetUVNode(i + 1, gp_Pnt2d(nodes_[i].parameter));
    }
    for (int i = 0; i < static_cast<int>(triangles_.size()); ++i)
      mesh->SetTriangle(i + 1, Poly_Triangle(triangles_[i][0] + 1, triangles_[i][1] + 1, triangles_[i][2] + 1));
    return mesh;
  }

 private:
  /// An edge inside the face: its two triangles, and which side of each it is.
  struct Inner {
    std::array<int, 2> triangle{-1, -1}, side{};
  };

  double distance_over_middle(int a, int b) const {
    const SurfacePoint middle = over_middle(a, b);
    const Vec3 chord = nodes_[b].point - nodes_[a].point;
    const Vec3 off = middle.point - nodes_[a].point;
    const double length2 = chord.squaredNorm();
    return length2 > 0 ? (off - off.dot(chord) / length2 * chord).norm() : off.norm();
  }

  SurfacePoint over_middle(int a, int b) const {
    const gp_XY uv = (nodes_[a].parameter + nodes_[b].parameter) / 2;
    const gp_Pnt p = surface_.Value(uv.X(), uv.Y());
    return {{p.X(), p.Y(), p.Z()}, uv};
  }

  std::map<std::array<int, 2>, Inner> inner_edges() const {
    std::map<std::array<int, 2>, Inner> edges;
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(triangles_[t][k], triangles_[t][(k + 1) % 3]);
        Inner& edge = edges[{low, high}];
        const int use = edge.triangle[0] < 0 ? 0 : 1;
        edge.triangle[use] = t;
        edge.side[use] = k;
      }
    std::erase_if(edges, [](const auto& edge) { return edge.second.triangle[1] < 0; });
    return edges;
  }

  /// The side of triangle t to halve: the longest inner one whose middle is about as far off as any; -1 if none helps.
  int side_to_halve(int t, const std::map<std::array<int, 2>, Inner>& inner) const {
    double farthest = 0;
    std::array<double, 3> distance{}, length{};
    for (int k = 0; k < 3; ++k) {
      const int a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
      distance[k] = distance_over_middle(a, b);
      length[k] = (nodes_[a].point - nodes_[b].point).norm();
      farthest = std::max(farthest, distance[k]);
    }
    if (*std::min_element(length.begin(), length.end()) == 0) return -1;  // at a pole: vanishes when stitched
    int best = -1;
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles_[t][k], triangles_[t][(k + 1) % 3]);
      const bool helps = distance[k] >= 0.5 * farthest && distance[k] >= 0.1 * allowed_;
      if (helps && inner.contains({low, high}) && (best < 0 || length[k] > length[best])) best = k;
    }
    return best;
  }

  /// Halves or flips one edge of every bad triangle, as far as they do not get in each other's way.
  bool split_once() {
    const auto inner = inner_edges();
    std::vector<char> touched(triangles_.size(), 0);
    std::vector<const Inner*> to_halve, to_flip;
    for (int t = 0; t < static_cast<int>(touched.size()); ++t) {
      if (!bad_[t]) continue;
      std::array<SurfacePoint, 3> corners{nodes_[triangles_[t][0]], nodes_[triangles_[t][1]], nodes_[triangles_[t][2]]};
      bad_[t] = triangle_deflection(corners, surface_, allowed_) > allowed_;
      if (!bad_[t] || touched[t]) continue;
      const int base = base_if_flat(t);
      const Inner* edge = find(inner, t, base >= 0 ? base : side_to_halve(t, inner));
      if (!edge) bad_[t] = 0;
      if (!edge || touched[edge->triangle[0]] || touched[edge->triangle[1]]) continue;
      const int across = edge->triangle[0] == t ? edge->triangle[1] : edge->triangle[0];
      if (base >= 0 && !can_flip(*edge)) continue;  // until the triangle across, flat too, has been flipped
      touched[t] = touched[across] = 1;
      (base >= 0 ? to_flip : to_halve).push_back(edge);
    }
    for (const Inner* edge : to_flip) flip(*edge);
    for (const Inner* edge : to_halve) halve(*edge);
    changed_ = changed_ || !to_flip.empty() || !to_halve.empty();
    return !to_flip.empty() || !to_halve.empty();
  }

  const Inner* find(const std::map<std::array<int, 2>, Inner>& inner, int t, int side) const {
    if (side < 0) return nullptr;
    const auto [low, high] = std::minmax(triangles_[t][side], triangles_[t][(side + 1) % 3]);
    const auto found = inner.find({low, high});
    return found == inner.end() ? nullptr : &found->second;
  }

  /// Scales parameters to lengths on the surface.
  struct Metric {
    double u, v;
  };
  Metric metric_at(int o) const {
    gp_Pnt p;
    gp_Vec du, dv;
    surface_.D1(nodes_[o].parameter.X(), nodes_[o].parameter.Y(), p, du, dv);
    return {du.Magnitude(), dv.Magnitude()};
  }
  /// Twice the area of a triangle of parameters.
  double area(int a, int b, int c, const Metric& metric) const {
    const gp_XY ab = nodes_[b].parameter - nodes_[a].parameter, ac = nodes_[c].parameter - nodes_[a].parameter;
    return (ab.X() * ac.Y() - ab.Y() * ac.X()) * metric.u * metric.v;
  }
  double length2(int a, int b, const Metric& metric) const {
    const gp_XY ab = nodes_[b].parameter - nodes_[a].parameter;
    return ab.X() * ab.X() * metric.u * metric.u + ab.Y() * ab.Y() * metric.v * metric.v;
  }

  /// The longest side of a triangle without height, -1 for others. The mesher leaves such triangles where points line
  /// up; a new node on the long side would fall on the third corner, so it is the other diagonal that is wanted.
  int base_if_flat(int t) const {
    const Corners& c = triangles_[t];
    const Metric metric = metric_at(c[0]);
    int base = 0;
    for (int k = 1; k < 3; ++k)
      if (length2(c[k], c[(k + 1) % 3], metric) > length2(c[base], c[(base + 1) % 3], metric)) base = k;
    const double height = std::abs(area(c[0], c[1], c[2], metric));
    return height < flat * length2(c[base], c[(base + 1) % 3], metric) ? base : -1;
  }

  /// The corners of an edge's two triangles: a and b on the edge, m and x across from it.
  std::array<int, 4> quadrilateral(const Inner& edge) const {
    const Corners &mine = triangles_[edge.triangle[0]], &other = triangles_[edge.triangle[1]];
    const int k = edge.side[0];
    return {mine[k], mine[(k + 1) % 3], mine[(k + 2) % 3], other[(edge.side[1] + 2) % 3]};
  }

  /// Whether the other diagonal lies inside: both new triangles have positive area, in the sense of the old ones.
  bool can_flip(const Inner& edge) const {
    const auto [a, b, m, x] = quadrilateral(edge);
    const Metric metric = metric_at(a);
    const double sense = area(a, b, m, metric) + area(b, a, x, metric);
    const double least = 1e-6 * std::abs(sense);
    const double sign = sense > 0 ? 1 : -1;
    return m != x && sign * area(a, x, m, metric) > least && sign * area(x, b, m, metric) > least;
  }

  void flip(const Inner& edge) {
    const auto [a, b, m, x] = quadrilateral(edge);
    triangles_[edge.triangle[0]] = {a, x, m};
    triangles_[edge.triangle[1]] = {x, b, m};
    bad_[edge.triangle[0]] = bad_[edge.triangle[1]] = 1;
  }

  void halve(const Inner& edge) {
    const Corners& first = triangles_[edge.triangle[0]];
    const int middle = static_cast<int>(nodes_.size());
    nodes_.push_back(over_middle(first[edge.side[0]], first[(edge.side[0] + 1) % 3]));
    for (int use = 0; use < 2; ++use) {
      const Corners old = triangles_[edge.triangle[use]];
      const int k = edge.side[use];
      triangles_[edge.triangle[use]][(k + 1) % 3] = middle;
      triangles_.push_back(old);
      triangles_.back()[k] = middle;
      bad_[edge.triangle[use]] = 1;
      bad_.push_back(1);
    }
  }

  const FaceMesh& face_;
  const BRepAdaptor_Surface surface_;
  const double allowed_;
  std::vector<SurfacePoint> nodes_;
  std::vector<Corners> triangles_;
  bool changed_ = false;
  std::vector<char> bad_;  ///< per triangle: to be looked at
};

}  // namespace

void refine(FaceMesh& face, double allowed) {
  if (face.triangulation.IsNull() || !face.triangulation->HasUVNodes()) return;
  if (ElementarySurface::of(face.face)) return;  // the mesher knows these well
  Refinement refinement(face, allowed);
  if (refinement.run()) face.triangulation = refinement.result();
}

}  // namespace starcell::cad
