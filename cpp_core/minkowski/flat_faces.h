// Large flat faces of both operands, one parallel to the other: what all their facets, edges and vertices can bound, in few facets.
//
// Where faces P of A and Q of B have one normal, every facet of P meets every vertex of Q and every edge of P every edge of Q: as many
// candidates as the product of both. All of them lie in conv(P) ⊕ conv(Q), a convex polygon of |P| + |Q| corners at most, each the sum of two
// vertices. Candidates only have to cover the boundary (membership tells what is boundary), so the polygon stands for them.
// Guarantees: what the features of a covered pair can bound is within rounding of the polygon. It may reach farther than the sum does.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "minkowski/sum_operand.h"

namespace starcell {

/// A vertex of a and one of b.
using SumOrigin = std::array<std::uint32_t, 2>;

class FlatFaces {
 public:
  FlatFaces(const SumOperand& a, const SumOperand& b);

  /// The facets that stand for all covered pairs, turned as the faces are.
  std::vector<std::array<SumOrigin, 3>> cover() const;
  /// Do a facet of `faces` and a vertex of `vertices` belong to a covered pair? `turned`: the facet is b's.
  bool cover_facet(std::uint32_t facet, std::uint32_t vertex, bool turned) const;
  bool cover_edges(const SumOperand::Edge& e, const SumOperand::Edge& f) const;

 private:
  struct Face {
    std::vector<std::uint32_t> facets, vertices;
    Vec3 normal;
  };
  struct Side {
    std::vector<Face> faces;
    std::vector<std::uint32_t> of_facet;                    // none: a small face
    std::vector<std::vector<std::uint32_t>> of_vertex;
  };
  /// Are all corners within `flat` of one plane with this normal?
  static bool is_level(const SumOperand& mesh, const Face& face, const Vec3& normal, double flat);
  static Side faces_of(const SumOperand& mesh, double flat);
  bool covered(std::uint32_t p, std::uint32_t q) const { return covered_[p * side_b_.faces.size() + q] != 0; }
  /// Of the whole hull of a face the corners, anticlockwise seen from outside.
  static std::vector<std::uint32_t> hull(const SumOperand& mesh, const Face& face, int axis, double sense);
  std::vector<SumOrigin> straightened(const std::vector<SumOrigin>& polygon, double within) const;

  const SumOperand& a_;
  const SumOperand& b_;
  Side side_a_, side_b_;
  std::vector<char> covered_;
  double flat_ = 0;   // how far from a plane or a line counts as on it
};

}  // namespace starcell
