// Boolean expressions over solids: n-ary union and intersection, complement, and difference built from them.
// Immutable and shared: copying an expression copies a pointer.
//
// Rests on T§3.10.2 (the simplification inside a cell is in local_expression.h).
// Guarantees: children of a union are never unions, children of an intersection never intersections, a complement's
// child is never a complement: chains of | and & stay flat however the user built them.
#pragma once

#include <memory>
#include <vector>

#include "distance/offset_solid.h"
#include "minkowski/sum_solid.h"
#include "numerics/vector.h"
#include "repair/winding_solid.h"
#include "solids/curved_solid.h"
#include "solids/half_space.h"
#include "solids/polyhedron.h"

namespace starcell {

class Expression {
 public:
  enum class Kind { polyhedron, half_space, curved, offset, sum, winding, region, set_union, intersection, complement };

  explicit Expression(PolyhedronPtr solid);
  explicit Expression(const HalfSpace& half_space);
  explicit Expression(CurvedSolidPtr solid);
  explicit Expression(OffsetSolidPtr solid);
  explicit Expression(SumSolidPtr solid);
  explicit Expression(WindingSolidPtr solid);
  /// Where the surface's function is negative, bounded or not; it is not transformed.
  explicit Expression(SmoothSurfacePtr region);

  /// Union and intersection of one or more expressions. Throws std::invalid_argument when empty.
  static Expression set_union(const std::vector<Expression>& operands);
  static Expression intersection(const std::vector<Expression>& operands);
  static Expression difference(const Expression& a, const Expression& b);
  Expression complement() const;

  /// The image of every leaf under an affine map.
  Expression transformed(const Eigen::Matrix4d& map) const;

  Kind kind() const { return node_->kind; }
  const PolyhedronPtr& polyhedron() const { return node_->polyhedron; }     ///< kind() == polyhedron
  const HalfSpace& half_space() const { return *node_->half_space; }        ///< kind() == half_space
  const CurvedSolidPtr& curved() const { return node_->curved; }            ///< kind() == curved
  const OffsetSolidPtr& offset() const { return node_->offset; }            ///< kind() == offset
  const SumSolidPtr& sum() const { return node_->sum; }                     ///< kind() == sum
  const WindingSolidPtr& winding() const { return node_->winding; }         ///< kind() == winding
  const SmoothSurfacePtr& region() const { return node_->region; }          ///< kind() == region
  const std::vector<Expression>& operands() const { return node_->operands; }

  /// A box that contains the solid. Throws UnboundedError if none can be derived.
  Box3 bounding_box() const;
  bool is_bounded() const;

 private:
  struct Node {
    Kind kind;
    PolyhedronPtr polyhedron{};
    std::shared_ptr<const HalfSpace> half_space{};
    CurvedSolidPtr curved{};
    OffsetSolidPtr offset{};
    SumSolidPtr sum{};
    WindingSolidPtr winding{};
    SmoothSurfacePtr region{};
    std::vector<Expression> operands{};
  };
  explicit Expression(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  static Expression combine(Kind kind, const std::vector<Expression>& operands);

  std::shared_ptr<const Node> node_;
};

}  // namespace starcell
