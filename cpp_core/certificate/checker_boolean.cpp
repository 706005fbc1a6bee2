// The exact Boolean: the file's expression evaluated by CGAL's corefinement with exact constructions.
//
// Rests on: a node's value is a bounded solid or the complement of one, so by De Morgan union, intersection and difference
// of bounded solids are enough. A half-space is a cuboid that agrees with it on a box around all operands: the expression
// is bounded by them, so what the cuboid cuts off beyond is never seen.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>

#include "certificate/checker_cgal.h"

namespace starcell::checker {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;

struct Undecided : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Solid {
  Mesh boundary;
  bool complement = false;  ///< everything outside the boundary
};

enum class Operation { unite, intersect, subtract };

Mesh combine(Operation operation, Mesh a, Mesh b) {
  Mesh out;
  const auto strict = CGAL::parameters::throw_on_self_intersection(true);
  const bool manifold = operation == Operation::unite       ? PMP::corefine_and_compute_union(a, b, out, strict)
                        : operation == Operation::intersect ? PMP::corefine_and_compute_intersection(a, b, out, strict)
                                                            : PMP::corefine_and_compute_difference(a, b, out, strict);
  if (!manifold) throw Undecided("the exact result, or a part of it, is no manifold: the input touches itself");
  return out;
}

Mesh unite(const Mesh& a, const Mesh& b) {
  if (is_empty(a)) return b;
  return is_empty(b) ? a : combine(Operation::unite, a, b);
}

Mesh intersect(const Mesh& a, const Mesh& b) {
  return is_empty(a) || is_empty(b) ? Mesh() : combine(Operation::intersect, a, b);
}

Mesh subtract(const Mesh& a, const Mesh& b) { return is_empty(a) || is_empty(b) ? a : combine(Operation::subtract, a, b); }

Solid complement(Solid a) {
  a.complement = !a.complement;
  return a;
}

Solid unite(const Solid& a, const Solid& b) {
  if (a.complement && b.complement) return {intersect(a.boundary, b.boundary), true};
  if (a.complement) return {subtract(a.boundary, b.boundary), true};
  if (b.complement) return {subtract(b.boundary, a.boundary), true};
  return {unite(a.boundary, b.boundary), false};
}

Solid intersect(const Solid& a, const Solid& b) { return complement(unite(complement(a), complement(b))); }

Mesh to_cgal(const StoredMesh& stored) {
  Mesh mesh;
  for (const Vec3& p : stored.vertices) mesh.add_vertex(Point(p.x(), p.y(), p.z()));
  for (const Triangle& t : stored.triangles)
    if (mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2])) == Mesh::null_face())
      throw Undecided("CGAL cannot hold an operand's mesh");
  std::vector<Mesh::Vertex_index> loose;
  for (const auto v : mesh.vertices())
    if (mesh.is_isolated(v)) loose.push_back(v);
  for (const auto v : loose) mesh.remove_vertex(v);
  mesh.collect_garbage();
  return mesh;
}

StoredMesh from_cgal(const Mesh& mesh) {
  StoredMesh stored;
  std::vector<std::uint32_t> index(mesh.number_of_vertices() + mesh.number_of_removed_vertices());
  for (const auto v : mesh.vertices()) {
    index[v] = static_cast<std::uint32_t>(stored.vertices.size());
    const Point& p = mesh.point(v);
    CGAL::exact(p);  // so that the rounding below is to the nearest double, or next to it
    stored.vertices.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }
  for (const auto f : mesh.faces()) {
    Triangle triangle{};
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      if (k < 3) triangle[k++] = index[v];
    stored.triangles.push_back(triangle);
  }
  return stored;
}

/// A vector of about the given length along an exact direction: exact direction, rounded length.
Vector stretched(const Vector& direction, double length) {
  return direction * Kernel::FT(length / std::sqrt(CGAL::to_double(direction.squared_length())));
}

/// The half-space cut down to a cuboid that contains the ball of `radius` around `centre` as far as it is inside.
Mesh cuboid(const HalfSpace& half_space, const Vec3& centre, double radius) {
  // The plane is the stored one: scaling by a power of two rounds nothing.
  const int exponent = std::ilogb(half_space.normal.cwiseAbs().maxCoeff());
  const Vec3 unit = half_space.normal.unaryExpr([&](double x) { return std::scalbn(x, -exponent); });
  const Vector normal(unit.x(), unit.y(), unit.z());
  const Point on_plane(half_space.point.x(), half_space.point.y(), half_space.point.z());
  const Point middle(centre.x(), centre.y(), centre.z());
  const Kernel::FT height = (middle - on_plane) * normal / normal.squared_length();
  const Point foot = middle - normal * height;
  const int smallest = std::abs(unit.x()) <= std::abs(unit.y()) && std::abs(unit.x()) <= std::abs(unit.z()) ? 0
                       : std::abs(unit.y()) <= std::abs(unit.z())                                           ? 1
                                                                                                            : 2;
  const Vector axis(smallest == 0, smallest == 1, smallest == 2);
  const Vector side = CGAL::cross_product(normal, axis), up = CGAL::cross_product(normal, side);
  const double distance = std::sqrt(CGAL::to_double((middle - foot).squared_length()));
  const Vector u = stretched(side, 2 * radius), v = stretched(up, 2 * radius),
               n = stretched(normal, 2 * (radius + distance));
  Mesh mesh;
  for (const int z : {-1, 0})
    for (const int y : {-1, 1})
      for (const int x : {-1, 1}) mesh.add_vertex(foot + u * x + v * y + n * z);
  constexpr int faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  for (const auto& f : faces) mesh.add_face(Mesh::Vertex_index(f[0]), Mesh::Vertex_index(f[1]), Mesh::Vertex_index(f[2]));
  return mesh;
}

Mesh evaluate(const CertificateFile& file) {
  Box3 box;
  for (const StoredOperand& operand : file.operands)
    for (const Vec3& p : operand.mesh.vertices) box.extend(p);
  if (box.isEmpty()) throw Undecided("there is no bounded operand");
  const double radius = box.diagonal().norm() * 1.01;
  if (!(radius > 1e-100)) throw Undecided("the operands are too small for double arithmetic");
  std::vector<Solid> values;
  for (const StoredNode& node : file.expression) {
    switch (node.kind) {
      case Expression::Kind::polyhedron: values.push_back({to_cgal(file.operands[node.leaf].mesh)}); continue;
      case Expression::Kind::half_space:
        values.push_back({cuboid(file.half_spaces[node.leaf], box.center(), radius)});
        continue;
      case Expression::Kind::curved: throw Undecided("an operand is curved, and CGAL's Booleans are of polyhedra");
      case Expression::Kind::offset: throw Undecided("an operand is an offset, and CGAL's Booleans are of polyhedra");
      case Expression::Kind::sum: throw Undecided("an operand is a Minkowski sum, and CGAL's Booleans are of polyhedra");
      case Expression::Kind::winding: throw Undecided("an operand is what crossing triangles wind about, and CGAL's Booleans are of polyhedra");
      case Expression::Kind::complement: values.push_back(complement(values[node.children.front()])); continue;
      default: break;
    }
    Solid value = values[node.children.front()];
    for (std::size_t k = 1; k < node.children.size(); ++k)
      value = node.kind == Expression::Kind::set_union ? unite(value, values[node.children[k]])
                                                       : intersect(value, values[node.children[k]]);
    values.push_back(std::move(value));
  }
  if (values.back().complement) throw Undecided("the expression is unbounded");
  return std::move(values.back().boundary);
}

}  // namespace

ExactBoolean exact_boolean(const CertificateFile& file) {
  if (file.expression.empty()) return {false, "the file has no expression: the result is no Boolean", {}};
  try {
    return {true, "", from_cgal(evaluate(file))};
  } catch (const Undecided& reason) {
    return {false, reason.what(), {}};
  } catch (const std::exception& error) {
    return {false, std::string("CGAL gave up: ") + error.what(), {}};
  }
}

}  // namespace starcell::checker
