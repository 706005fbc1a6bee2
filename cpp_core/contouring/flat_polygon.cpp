#include "contouring/flat_polygon.h"

#include <algorithm>
#include <unordered_map>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace starcell {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                                       CGAL::No_constraint_intersection_requiring_constructions_tag>;

// Faces an odd number of rim edges away from outside.
std::vector<Triangle> inside_triangles(Cdt& cdt, bool upward) {
  for (auto f = cdt.all_faces_begin(); f != cdt.all_faces_end(); ++f) f->info() = -1;
  std::vector<Cdt::Face_handle> front{cdt.infinite_face()};
  cdt.infinite_face()->info() = 0;
  for (std::size_t k = 0; k < front.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const auto n = front[k]->neighbor(i);
      if (n->info() >= 0) continue;
      n->info() = front[k]->info() + (cdt.is_constrained({front[k], i}) ? 1 : 0);
      front.push_back(n);
    }
  // A breadth-first count of crossings is right modulo two whatever path is taken.
  std::vector<Triangle> triangles;
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f)
    if (f->info() % 2 == 1) {
      Triangle t{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
      if (!upward) std::swap(t[1], t[2]);
      triangles.push_back(t);
    }
  return triangles;
}

// A cycle that rounding turned around would be filled from its wrong side.
bool bounded_by(const std::vector<Triangle>& triangles, const std::vector<RimEdge>& rim) {
  std::vector<RimEdge> edges;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  std::sort(edges.begin(), edges.end());
  return std::all_of(rim.begin(), rim.end(), [&](const RimEdge& e) { return std::binary_search(edges.begin(), edges.end(), e); });
}

}  // namespace

std::optional<std::vector<Triangle>> triangulate_flat(const std::vector<Vec3>& vertices, const std::vector<RimEdge>& rim) {
  if (rim.size() < 3) return std::nullopt;
  Vec3 normal = Vec3::Zero();
  for (const RimEdge& e : rim) normal += vertices[e.first].cross(vertices[e.second]);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const bool upward = normal[axis] > 0;
  Cdt cdt;
  std::unordered_map<std::uint32_t, Cdt::Vertex_handle> handles;
  const auto handle = [&](std::uint32_t v) {
    const auto it = handles.find(v);
    if (it != handles.end()) return it->second;
    const Vec3& p = vertices[v];
    const auto h = cdt.insert(Kernel::Point_2(p[(axis + 1) % 3], p[(axis + 2) % 3]));
    h->info() = v;
    handles.emplace(v, h);
    return h;
  };
  for (const RimEdge& e : rim) handle(e.first), handle(e.second);
  if (cdt.number_of_vertices() != handles.size()) return std::nullopt;
  try {
    for (const RimEdge& e : rim) cdt.insert_constraint(handles[e.first], handles[e.second]);
  } catch (const std::exception&) {
    return std::nullopt;  // rim edges cross after rounding
  }
  // Every rim edge must have become one constrained edge: a corner on another rim edge would split it.
  std::size_t constrained = 0;
  for (auto e = cdt.finite_edges_begin(); e != cdt.finite_edges_end(); ++e) constrained += cdt.is_constrained(*e);
  if (constrained != rim.size()) return std::nullopt;
  std::vector<Triangle> triangles = inside_triangles(cdt, upward);
  if (!bounded_by(triangles, rim)) return std::nullopt;
  return triangles;
}

}  // namespace starcell
