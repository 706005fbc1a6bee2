// Distances between two meshes. Degenerate triangles, which rounding the exact result can make, are left out: their
// neighbours cover them.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>

#include "certificate/checker_cgal.h"

namespace starcell::checker {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;

Kernel::Point_3 point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// Every triangle by itself, so that no combinatorial defect is in the way.
Mesh triangles_of(const StoredMesh& stored) {
  Mesh mesh;
  for (const Triangle& t : stored.triangles) {
    const auto a = point(stored.vertices[t[0]]), b = point(stored.vertices[t[1]]), c = point(stored.vertices[t[2]]);
    if (!CGAL::collinear(a, b, c)) mesh.add_face(mesh.add_vertex(a), mesh.add_vertex(b), mesh.add_vertex(c));
  }
  if (mesh.number_of_faces() == 0) throw std::runtime_error("every triangle is degenerate");
  return mesh;
}

double one_sided(const StoredMesh& from, const Mesh& to) {
  const Tree tree(faces(to).first, faces(to).second, to);
  double largest = 0;
  for (const Triangle& t : from.triangles)
    for (const std::uint32_t v : t) largest = std::max(largest, tree.squared_distance(point(from.vertices[v])));
  return std::sqrt(largest);
}

}  // namespace

double vertex_distance(const StoredMesh& a, const StoredMesh& b) {
  return std::max(one_sided(a, triangles_of(b)), one_sided(b, triangles_of(a)));
}

double hausdorff_distance(const StoredMesh& a, const StoredMesh& b, double precision) {
  return CGAL::Polygon_mesh_processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(
      triangles_of(a), triangles_of(b), precision);
}

}  // namespace starcell::checker
