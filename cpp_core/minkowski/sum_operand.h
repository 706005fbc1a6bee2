// An operand of a Minkowski sum: a mesh, perhaps reflected in the origin or turned inside out, and what of it can bound a sum.
//
// ∂(A ⊕ B) is part of the convolution (Guibas, Ramshaw & Stolfi 1983; Lien 2008; Campen & Kobbelt 2010): faces of one operand placed
// at vertices of the other, and parallelograms of two edges, wherever both features have an outward normal in common. A feature's
// *normals* are the directions in which its operand is, near the feature, nowhere higher: one of a face, an arc of a convex edge, a
// polyhedral cone of a vertex. Reflex edges have none, saddles of vertices neither: they never bound a sum, because what lies beside
// them reaches over them. Features of a flat face's inside have those of the face alone, and the face stands for them.
// Guarantees: every normal of a feature is within its cap; a feature that is left out has none of its own.
#pragma once

#include <array>

#include "solids/polyhedron.h"

namespace starcell {

/// All unit vectors within `angle` of the axis.
struct NormalCap {
  Vec3 axis = Vec3::UnitZ();
  double angle = 0;   ///< radians; at least pi: every direction
};

/// How an operand stands in the sum.
struct Placement {
  bool reflected = false;    ///< -P
  bool inside_out = false;   ///< the complement of P
};

class SumOperand {
 public:
  SumOperand(PolyhedronPtr solid, const Placement& placement);

  struct Edge {
    std::uint32_t from, to;        ///< vertices
    std::uint32_t left, right;     ///< the third corners of the faces beside it
    std::array<std::uint32_t, 2> facets;   ///< those faces
    NormalCap normals;
  };
  struct Vertex {
    std::uint32_t vertex;
    std::uint32_t first, last;     ///< its edges are links()[first] .. links()[last - 1]
    NormalCap normals;
  };
  struct Face {
    std::uint32_t facet;
    NormalCap normals;
    double slack;   ///< how far the axis may be off the normal, radians
  };

  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Triangle>& facets() const { return facets_; }
  /// Of every facet those across the edges from corner k to k + 1.
  const std::vector<Triangle>& neighbours() const { return neighbours_; }
  /// Of every facet.
  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<Edge>& edges() const { return edges_; }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  /// An edge of a vertex: where it ends, and the face on one side.
  struct Link {
    std::uint32_t vertex, facet;
  };
  const std::vector<Link>& links() const { return links_; }
  /// Of the whole operand, as it stands.
  const Box3& box() const { return box_; }
  bool inside_out() const { return inside_out_; }

  /// Is the operand nowhere higher than the vertex along n, as far as its edges and faces there go? Conservatively true. Where that is so, at least
  /// one of the faces looks along n: of a level place edges alone do not say which side is up.
  bool supports(const Vertex& v, const Vec3& n, double slack) const;
  /// The same of an edge and its faces.
  bool supports(const Edge& e, const Vec3& n, double slack) const;

 private:
  /// Not certainly turned away from n.
  bool may_face(std::uint32_t facet, const Vec3& n) const;
  void find_edges();
  void find_vertices();

  bool inside_out_;
  std::vector<Vec3> points_;
  std::vector<Triangle> facets_, neighbours_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  std::vector<Vertex> vertices_;
  std::vector<Link> links_;
  Box3 box_;
};

/// The angle between two vectors, accurate for small ones too.
double angle_between(const Vec3& u, const Vec3& v);

}  // namespace starcell
