// Does A meet x - B? That is membership of x in A ⊕ B, without any decomposition (T§4.1; DESIGN §6).
//
// Two solids meet if an edge of one crosses a facet of the other, or if, their boundaries being apart, a component of one's boundary
// lies in the other. A pair of trees finds crossings. The x for which one edge crosses one facet are the inside of a prism, facet ⊕
// edge: a box with its corners in one prism is inside the sum as a whole. So is one for which a point of A is in x - B throughout
// (common_point.cpp).
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
  /// The same, from a point that both have for all of them: where faces are in line it sees what throughout() does not, more slowly.
  bool share_a_point(const Box3& box) const;

 private:
  /// A facet wherever it may be placed. Its edges are known far better than its place.
  struct Shape {
    std::array<Vec3, 3> edges;   ///< from each corner to the next
    Vec3 normal;                 ///< up to length
    double base;                 ///< how long its edges are at most, along any axis
  };
  static std::vector<Shape> shapes_of(const SumOperand& mesh);
  /// Certainly all three points on one side of the plane through p?
  bool beside(const Shape& facet, const Vec3& p, const std::array<Vec3, 3>& points) const;

  struct Reach {
    double low, high;
  };

  enum class Answer { no, yes, unknown };
  /// Does the segment from s along d cross the facet whose first corner is `corner`? `sense` -1: the facet is reflected.
  Answer crosses(const Shape& facet, double sense, const Vec3& corner, const Vec3& s, const Vec3& d) const;
  /// Pairs of a facet and an edge that cross for certain at x; visit returns true to stop. Is any pair uncertain?
  template <class Visit>
  bool crossings(const Vec3& x, Visit visit) const;
  template <class Visit>
  bool facets_cross(std::uint32_t f, std::uint32_t g, const Vec3& x, bool& uncertain, Visit& visit) const;
  bool contained(const Vec3& x) const;
  /// Directions, beside the axes, that much of the operands' area faces: plates that are turned lie apart along them, not along axes.
  static std::vector<Vec3> directions_of(const SumOperand& a, const SumOperand& b);
  /// Of every node of the tree and every direction, how far the node's facets reach along it.
  static std::vector<Reach> reaches_of(const SumOperand& mesh, const FacetTree& tree, const std::vector<Vec3>& directions);
  /// Do the nodes lie apart, b's being turned round x?
  bool are_apart(std::uint32_t of_a, std::uint32_t of_b, const Vec3& x) const;
  /// Is p in A, and certainly in x - B for all x within `half` of the middle?
  bool have_in_common(const Vec3& p, const Vec3& middle, const Vec3& half) const;
  /// Does no facet meet the box?
  static bool is_clear(const SumOperand& mesh, const FacetTree& tree, const std::vector<Shape>& shapes, const Vec3& middle, const Vec3& half);

  const SumOperand& a_;
  const SumOperand& b_;
  FacetTree tree_a_, tree_b_;
  std::vector<Shape> shapes_a_, shapes_b_;
  std::vector<Vec3> directions_;
  std::vector<Reach> reaches_a_, reaches_b_;         // of each node, by directions
  std::vector<std::uint32_t> shells_a_, shells_b_;   // a vertex of every boundary component
  double rounding_;                                  // of any coordinate's difference
};

/// Is the point inside the mesh, as its facets are turned? Exact for points that are not on it.
bool is_inside(const SumOperand& mesh, const FacetTree& tree, const Vec3& x);

}  // namespace starcell
