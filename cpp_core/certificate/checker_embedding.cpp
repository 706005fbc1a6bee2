// Self-intersections and shells, with CGAL's exact predicates.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <optional>

#include "certificate/checker_cgal.h"
#include "certificate/checker_mesh.h"

namespace starcell::checker {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

std::optional<Mesh> to_cgal(const StoredMesh& stored) {
  Mesh mesh;
  for (const Vec3& p : stored.vertices) mesh.add_vertex({p.x(), p.y(), p.z()});
  for (const Triangle& t : stored.triangles)
    if (mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2])) == Mesh::null_face())
      return std::nullopt;
  return mesh;
}

std::string place(const StoredMesh& mesh, std::size_t triangle) {
  const Vec3& p = mesh.vertices[mesh.triangles[triangle][0]];
  return "at (" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " + std::to_string(p.z()) + ")";
}

Finding no_degenerate_triangle(const StoredMesh& mesh) {
  const auto point = [&](std::uint32_t v) {
    return Kernel::Point_3(mesh.vertices[v].x(), mesh.vertices[v].y(), mesh.vertices[v].z());
  };
  std::size_t count = 0, first = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    if (CGAL::collinear(point(c[0]), point(c[1]), point(c[2])) && count++ == 0) first = t;
  }
  if (count == 0) return {Answer::yes, ""};
  return {Answer::no, std::to_string(count) + " triangles have no area, the first " + place(mesh, first)};
}

template <class Question>
Finding ask_cgal(const Question& question) {
  try {
    return question();
  } catch (const std::exception& error) {
    return {Answer::unknown, std::string("CGAL gave up: ") + error.what()};
  }
}

Finding no_self_intersection(const StoredMesh& stored) {
  const auto mesh = to_cgal(stored);
  if (!mesh) return {Answer::unknown, "CGAL cannot hold this mesh"};
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(*mesh, std::back_inserter(pairs));
  if (pairs.empty()) return {Answer::yes, "no two of " + std::to_string(stored.triangles.size()) + " triangles intersect"};
  return {Answer::no, std::to_string(pairs.size()) + " pairs of triangles intersect, one " + place(stored, pairs[0].first)};
}

}  // namespace

Finding embedded(const StoredMesh& mesh) {
  for (const Vec3& p : mesh.vertices)
    if (!p.allFinite()) return {Answer::no, "a coordinate is out of range"};
  if (!in_range(mesh)) return {Answer::unknown, "a coordinate is too large or too small for CGAL"};
  const Finding degenerate = no_degenerate_triangle(mesh);
  if (degenerate.answer != Answer::yes) return degenerate;
  return ask_cgal([&] { return no_self_intersection(mesh); });
}

Finding bounds_a_volume(const StoredMesh& mesh) {
  Finding finding = embedded(mesh);
  if (finding.answer != Answer::yes || mesh.triangles.empty()) return finding;
  return ask_cgal([&]() -> Finding {
    if (CGAL::Polygon_mesh_processing::does_bound_a_volume(*to_cgal(mesh)))
      // CGAL lets the outside be the volume: then the sum has the other sign.
      return volume(mesh) > 0 ? finding : Finding{Answer::no, "it is inside out: its volume is not positive"};
    return {Answer::no, "its shells are not oriented outward and inward in turn"};
  });
}

StoredMesh rounded_to_float32(const StoredMesh& mesh) {
  StoredMesh rounded = mesh;
  for (Vec3& p : rounded.vertices)
    for (int k = 0; k < 3; ++k) {
      volatile float value = static_cast<float>(p[k]);  // g++ 12's vectoriser drops the round trip without it
      p[k] = static_cast<double>(value);
    }
  return rounded;
}

}  // namespace starcell::checker
