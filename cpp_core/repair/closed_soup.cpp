#include "repair/closed_soup.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include "numerics/predicates.h"
#include "solids/connectivity.h"
#include "solids/disjoint_sets.h"
#include "solids/errors.h"
#include "solids/upward_ray.h"
#include "solids/welding.h"

namespace starcell {
namespace {

using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;   // the smaller vertex first

struct Use {
  std::uint32_t triangle;
  bool forward;   ///< from the smaller vertex to the larger
};

using Edges = std::map<EdgeKey, std::vector<Use>>;

Edges edges_of(const std::vector<Triangle>& triangles) {
  Edges edges;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t u = triangles[t][k], v = triangles[t][(k + 1) % 3];
      edges[{std::min(u, v), std::max(u, v)}].push_back({t, u < v});
    }
  return edges;
}

// How often more an edge runs forward than back.
int excess(const std::vector<Use>& uses) {
  int sum = 0;
  for (const Use& use : uses) sum += use.forward ? 1 : -1;
  return sum;
}

bool balanced(const Edges& edges) {
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return excess(edge.second) == 0; });
}

Box3 box_of(const std::vector<Vec3>& points, const Triangle& t) { return Box3(points[t[0]]).extend(points[t[1]]).extend(points[t[2]]); }

std::string length_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

class Closing {
 public:
  Closing(std::vector<Vec3> vertices, std::vector<Triangle> triangles) { soup_.vertices = std::move(vertices), soup_.triangles = std::move(triangles); }

  ClosedSoup run(double widest) {
    clean();
    if (!balanced(edges_of(soup_.triangles))) {
      turn_neighbours_alike();
      fill_holes(widest);
    }
    find_pieces();
    turn_outward();
    return std::move(soup_);
  }

 private:
  void clean() {
    for (const Triangle& t : soup_.triangles)
      for (const std::uint32_t v : t)
        if (v >= soup_.vertices.size()) throw std::invalid_argument("triangles: index " + std::to_string(v) + " is out of range; there are " + std::to_string(soup_.vertices.size()) + " vertices");
    std::size_t infinite = 0;
    for (const Vec3& p : soup_.vertices) infinite += !p.allFinite();
    if (infinite > 0) throw InvalidSolidError("The triangles have no inside: " + std::to_string(infinite) + " vertices have coordinates that are not finite.");
    for (const Triangle& t : soup_.triangles)
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) soup_.findings.emplace_back("triangle without area", box_of(soup_.vertices, t));
    std::vector<std::int32_t> labels;
    const std::size_t gone = weld(soup_.vertices, soup_.triangles, labels);
    if (soup_.findings.size() < gone) soup_.findings.emplace_back("triangles whose corners coincide: " + std::to_string(gone - soup_.findings.size()), whole());
    if (soup_.triangles.empty()) throw InvalidSolidError("The triangles have no inside: there is none with three different corners.");
  }

  Box3 whole() const {
    Box3 box;
    for (const Vec3& p : soup_.vertices) box.extend(p);
    return box;
  }

  // Across edges of two triangles, from each piece's first one; then the whole piece as most of its triangles were.
  void turn_neighbours_alike() {
    const Edges edges = edges_of(soup_.triangles);
    std::vector<std::vector<std::pair<std::uint32_t, bool>>> beside(soup_.triangles.size());   // and whether it faces the same way
    for (const auto& [key, uses] : edges)
      if (uses.size() == 2) {
        const bool alike = uses[0].forward != uses[1].forward;
        beside[uses[0].triangle].emplace_back(uses[1].triangle, alike);
        beside[uses[1].triangle].emplace_back(uses[0].triangle, alike);
      }
    std::vector<char> seen(soup_.triangles.size(), 0), turned(soup_.triangles.size(), 0);
    for (std::uint32_t first = 0; first < soup_.triangles.size(); ++first) {
      if (seen[first]) continue;
      std::vector<std::uint32_t> piece{first};
      seen[first] = 1;
      std::size_t against = 0;
      for (std::size_t k = 0; k < piece.size(); ++k)
        for (const auto& [t, alike] : beside[piece[k]])
          if (!seen[t]) {
            seen[t] = 1;
            turned[t] = turned[piece[k]] != (alike ? 0 : 1);
            against += turned[t];
            piece.push_back(t);
          }
      const bool most = 2 * against > piece.size();
      for (const std::uint32_t t : piece)
        if ((turned[t] != 0) != most) {
          std::swap(soup_.triangles[t][1], soup_.triangles[t][2]);
          soup_.findings.emplace_back("turned triangle", box_of(soup_.vertices, soup_.triangles[t]));
        }
    }
  }

  // What is missing closes up into loops: at every vertex as many missing edges end as begin.
  void fill_holes(double widest) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> missing;
    for (const auto& [key, uses] : edges_of(soup_.triangles)) {
      const int more = excess(uses);
      for (int k = 0; k < std::abs(more); ++k) more > 0 ? missing[key.second].push_back(key.first) : missing[key.first].push_back(key.second);
    }
    std::size_t too_wide = 0;
    double width = 0;
    Vec3 where = Vec3::Zero();
    while (!missing.empty()) {
      std::vector<std::uint32_t> path{missing.begin()->first};
      while (!missing.empty()) {
        const auto at = missing.find(path.back());
        const std::uint32_t next = at->second.back();
        at->second.pop_back();
        if (at->second.empty()) missing.erase(at);
        const auto before = std::find(path.begin(), path.end(), next);
        if (before == path.end()) {
          path.push_back(next);
          continue;
        }
        const std::vector<std::uint32_t> loop(before, path.end());
        path.erase(before + 1, path.end());
        Box3 box;
        for (const std::uint32_t v : loop) box.extend(soup_.vertices[v]);
        if (box.diagonal().norm() > widest) {
          ++too_wide;
          if (box.diagonal().norm() > width) width = box.diagonal().norm(), where = box.center();
        } else {
          fill(loop, box);
        }
        if (path.size() == 1) break;
      }
    }
    if (too_wide > 0)
      throw InvalidSolidError("The triangles have no inside: " + std::to_string(too_wide) + (too_wide == 1 ? " hole is wider than " : " holes are wider than ") + length_text(widest) + " (" + (too_wide == 1 ? "" : "the widest, ") + length_text(width) +
                              ", about " + place(where) + "); close them, or ask for a larger error.");
  }

  void fill(const std::vector<std::uint32_t>& loop, const Box3& box) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_3> points;
    for (const std::uint32_t v : loop) points.emplace_back(soup_.vertices[v].x(), soup_.vertices[v].y(), soup_.vertices[v].z());
    std::vector<CGAL::Triple<int, int, int>> patch;
    if (loop.size() == 3) patch.emplace_back(0, 1, 2);
    else if (loop.size() > 3) CGAL::Polygon_mesh_processing::triangulate_hole_polyline(points, std::back_inserter(patch));
    if (patch.empty())   // no good triangulation was found: any has the same boundary
      for (int k = 2; k < static_cast<int>(loop.size()); ++k) patch.emplace_back(0, k - 1, k);
    for (const auto& t : patch) {
      std::array<int, 3> order{t.first, t.second, t.third};
      std::sort(order.begin(), order.end());   // along the loop
      soup_.triangles.push_back({loop[order[0]], loop[order[1]], loop[order[2]]});
    }
    soup_.findings.emplace_back("hole", box);
  }

  void find_pieces() {
    DisjointSets sets(soup_.triangles.size());
    for (const auto& [key, uses] : edges_of(soup_.triangles))
      for (const Use& use : uses) sets.join(sets.root(use.triangle), sets.root(uses.front().triangle));
    std::vector<std::uint32_t> number(soup_.triangles.size(), UINT32_MAX);
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      std::uint32_t& n = number[sets.root(t)];
      if (n == UINT32_MAX) n = soup_.pieces++;
      soup_.piece.push_back(n);
    }
  }

  void turn_outward() {
    std::vector<double> volume(soup_.pieces, 0);
    std::vector<Box3> box(soup_.pieces);
    const Vec3 origin = whole().center();
    for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
      const auto& [a, b, c] = soup_.triangles[t];
      volume[soup_.piece[t]] += (soup_.vertices[a] - origin).dot((soup_.vertices[b] - origin).cross(soup_.vertices[c] - origin));
      box[soup_.piece[t]].extend(box_of(soup_.vertices, soup_.triangles[t]));
    }
    for (std::uint32_t p = 0; p < soup_.pieces; ++p) {
      if (volume[p] >= 0) continue;
      const auto first = static_cast<std::size_t>(std::find(soup_.piece.begin(), soup_.piece.end(), p) - soup_.piece.begin());
      int about = 0;   // how often the others wind about it
      for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
        if (soup_.piece[t] == p) continue;
        const auto& [a, b, c] = soup_.triangles[t];
        if (is_above(soup_.vertices[a], soup_.vertices[b], soup_.vertices[c], soup_.vertices[soup_.triangles[first][0]]))
          about += turn(project(soup_.vertices[a], 2), project(soup_.vertices[b], 2), project(soup_.vertices[c], 2)) > 0 ? 1 : -1;
      }
      if (about > 0) continue;   // a cavity
      for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t)
        if (soup_.piece[t] == p) std::swap(soup_.triangles[t][1], soup_.triangles[t][2]);
      soup_.findings.emplace_back("piece inside out", box[p]);
    }
  }

  ClosedSoup soup_;
};

}  // namespace

ClosedSoup close(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double widest) { return Closing(std::move(vertices), std::move(triangles)).run(widest); }

}  // namespace starcell
