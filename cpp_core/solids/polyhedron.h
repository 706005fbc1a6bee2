// A closed, bounded solid whose boundary is a triangle mesh: the leaf of every expression.
//
// Guarantees, once made: every coordinate is finite; bit-identical vertices are one vertex; every edge belongs to
// exactly two triangles that run through it in opposite directions; the triangles around a vertex form one cycle; no
// two triangles meet except in the vertices and edges they share; normals point outward, nested shells alternate.
// Does not guarantee: anything about near-degenerate shapes (slivers and thin walls are allowed and kept).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "numerics/vector.h"

namespace starcell {

using Triangle = std::array<std::uint32_t, 3>;

/// Where a solid came from, carried along into the certificate.
struct Provenance {
  std::string name;              ///< operand's name in reports; may be empty
  double deflection = 0.0;       ///< measured two-sided distance to the CAD shape; 0: the polyhedron is the shape
  std::vector<std::int32_t> cad_face;  ///< per triangle: index of the CAD face it came from; empty: none
  std::vector<Box3> unresolved{};      ///< where a mesh made on the way is not certified: `deflection` does not hold there
  std::vector<Box3> contacts{};        ///< where it touches itself, or nearly, and was moved by no more than `moved`
  double moved = 0.0;                  ///< how far the surface moved off such contacts

  /// The deflection that holds everywhere.
  double proved_deflection() const { return unresolved.empty() ? deflection : std::numeric_limits<double>::infinity(); }
};

class Polyhedron {
 public:
  /// Validates and orients. Throws InvalidSolidError with counts and the first place of every kind of defect,
  /// std::invalid_argument for an index out of range. `triangles` index `vertices`.
  /// Triangles with a repeated vertex after welding are an InvalidSolidError ("degenerate") unless the rest closes
  /// without them, in which case they are dropped.
  static std::shared_ptr<const Polyhedron> make(std::vector<Vec3> vertices, std::vector<Triangle> triangles,
                                                Provenance provenance = {});

  /// As make(), for meshes that are valid by construction: nothing is checked. The caller owns the proof.
  static std::shared_ptr<const Polyhedron> trusted(std::vector<Vec3> vertices, std::vector<Triangle> triangles,
                                                   Provenance provenance = {});

  /// The image under an affine map. Rounding can make a valid mesh self-intersect, so the image is validated again.
  /// Mirror images are re-oriented. Throws std::invalid_argument for a singular matrix or a projective last row.
  std::shared_ptr<const Polyhedron> transformed(const Eigen::Matrix4d& map) const;

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// neighbours()[t][k]: the triangle across the edge from corner k to corner k+1 of triangle t.
  const std::vector<Triangle>& neighbours() const { return neighbours_; }
  const Provenance& provenance() const { return provenance_; }
  const Box3& bounding_box() const { return box_; }

 private:
  Polyhedron() = default;
  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Triangle> neighbours_;
  Provenance provenance_;
  Box3 box_;
};

using PolyhedronPtr = std::shared_ptr<const Polyhedron>;

}  // namespace starcell
