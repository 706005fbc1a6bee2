// Does A meet x - B? That is membership of x in A ⊕ B, without any decomposition (T§4.1; DESIGN §6).
//
// Two solids meet if an edge of one crosses a facet of the other, or if, their boundaries being apart, a component of one's boundary
// lies in the other. A pair of trees finds crossings. The x for which one edge crosses one facet are the inside of a prism, facet ⊕
// edge: a box with its corners in one prism is inside the sum as a whole.
// Guarantees: signs are taken with bounds on their rounding; where none of the crossings is certain and some cannot be excluded
// there is no answer.
#pragma once

#include <array>
#include <optional>

#include "minkowski/facet_tree.h"
#include "minkowski/sum_operand.h"

namespace starcell {

class Meeting {
 public:
  /// The operands must outlive it. `b` is not inside out.
  Meeting(const SumOperand& a, const SumOperand& b);

  /// Safe to call in parallel.
  std::optional<bool> at(const Vec3& x) const;
  /// Certainly for all x of the box?
  bool throughout(const Box3& box) const;

 private:
  /// A facet's plane, up to length.
  struct Plane {
    Vec3 normal;
    double base;   ///< how long its edges are at most, along any axis
  };
  static std::vector<Plane> planes_of(const SumOperand& mesh);
  /// Certainly all three points on one side of the plane through p?
  bool beside(const Plane& plane, const Vec3& p, const std::array<Vec3, 3>& points) const;

  enum class Answer { no, yes, unknown };
  /// Does the segment from s to t cross the triangle?
  Answer crosses(const std::array<Vec3, 3>& triangle, const Vec3& s, const Vec3& t) const;
  /// Pairs of a facet and an edge that cross for certain at x; visit returns true to stop. Is any pair uncertain?
  template <class Visit>
  bool crossings(const Vec3& x, Visit visit) const;
  template <class Visit>
  bool facets_cross(std::uint32_t f, std::uint32_t g, const Vec3& x, bool& uncertain, Visit& visit) const;
  bool contained(const Vec3& x) const;

  const SumOperand& a_;
  const SumOperand& b_;
  FacetTree tree_a_, tree_b_;
  std::vector<Plane> planes_a_, planes_b_;
  std::vector<std::uint32_t> shells_a_, shells_b_;   // a vertex of every boundary component
  double rounding_;                                  // of any coordinate's difference
};

/// Is the point inside the mesh, as its facets are turned? Exact for points that are not on it.
bool is_inside(const SumOperand& mesh, const FacetTree& tree, const Vec3& x);

}  // namespace starcell
