// What distance from a polyhedron is measured to: its faces, edges and vertices, and how the surface bends about them.
//
// Seen from outside, only convex edges and vertices are nearest to anything but themselves; from inside, only concave ones; flat
// ones never matter. The directions in which points lie whose nearest point is on a feature are normals of its *cap*: those of the
// faces about it and what lies between them (Rossignac & Requicha 1986; the pseudo-normals of Bærentzen & Aanæs 2005).
// Guarantees: bends are exact but for edges flatter than `flat_angle`, which count as flat; normals carry what they lose.
#pragma once

#include <array>
#include <vector>

#include "solids/polyhedron.h"

namespace starcell {

enum class Bend : std::uint8_t { flat, convex, concave, saddle };

/// All unit vectors within `radius` (a chord) of the axis; useless from sqrt(2) on.
struct Cap {
  Vec3 axis = Vec3::Zero();
  double radius = 2;
};

class MeshFeatures {
 public:
  struct Face {
    std::array<Vec3, 3> corners;
    Vec3 middle;
    double radius;                  ///< no corner is farther from the middle
    Vec3 normal;                    ///< outward, of unit length
    double loss;                    ///< how far the true normal may be from it
    std::array<Vec3, 3> along;      ///< unit vectors from corner k to the next
    std::array<Vec3, 3> inward;     ///< unit vectors in the plane, across edge k
    std::array<double, 3> length;
  };
  struct Edge {
    std::uint32_t a, b;
    std::array<std::uint32_t, 2> faces;
    Vec3 along;                     ///< from a to b, of unit length to rounding
    Bend bend;                      ///< never saddle
    double cosine;                  ///< between the two faces' normals
    Cap cap;
  };
  struct Vertex {
    Bend bend = Bend::flat;
    Vec3 pseudo_normal = Vec3::Zero();   ///< the faces' normals weighted by their angles
    Cap cap;
  };

  explicit MeshFeatures(PolyhedronPtr solid);

  const PolyhedronPtr& solid() const { return solid_; }
  std::size_t size() const { return faces.size(); }
  const Vec3& corner(std::uint32_t face, int k) const { return faces[face].corners[static_cast<std::size_t>(k)]; }
  /// The largest coordinate.
  double scale() const { return scale_; }

  std::vector<Face> faces;                              ///< per triangle
  std::vector<Edge> edges;
  std::vector<std::array<std::uint32_t, 3>> edge_of;    ///< per triangle: its edges, from corner k to the next
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> plane_of;                  ///< per triangle: faces joined by flat edges have one number
  std::vector<std::uint32_t> first_on_plane;            ///< per plane: its first triangle
  std::vector<std::uint32_t> faces_about;               ///< per vertex: first_about[v] .. first_about[v+1]
  std::vector<std::uint32_t> first_about;

 private:
  void make_faces();
  void make_edges();
  void make_vertices();
  void make_planes();

  PolyhedronPtr solid_;
  double scale_ = 0;
};

}  // namespace starcell
