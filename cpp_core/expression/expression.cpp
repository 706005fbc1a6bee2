#include "expression/expression.h"

#include <stdexcept>

#include "solids/errors.h"

namespace starcell {

Expression::Expression(PolyhedronPtr solid)
    : node_(std::make_shared<Node>(Node{.kind = Kind::polyhedron, .polyhedron = std::move(solid)})) {
  if (!node_->polyhedron) throw std::invalid_argument("solid: must not be null");
}

Expression::Expression(const HalfSpace& half_space)
    : node_(std::make_shared<Node>(Node{.kind = Kind::half_space, .half_space = std::make_shared<HalfSpace>(half_space)})) {}

Expression::Expression(CurvedSolidPtr solid)
    : node_(std::make_shared<Node>(Node{.kind = Kind::curved, .curved = std::move(solid)})) {
  if (!node_->curved) throw std::invalid_argument("solid: must not be null");
}

Expression::Expression(OffsetSolidPtr solid)
    : node_(std::make_shared<Node>(Node{.kind = Kind::offset, .offset = std::move(solid)})) {
  if (!node_->offset) throw std::invalid_argument("solid: must not be null");
}

Expression::Expression(SumSolidPtr solid)
    : node_(std::make_shared<Node>(Node{.kind = Kind::sum, .sum = std::move(solid)})) {
  if (!node_->sum) throw std::invalid_argument("solid: must not be null");
}

Expression::Expression(WindingSolidPtr solid)
    : node_(std::make_shared<Node>(Node{.kind = Kind::winding, .winding = std::move(solid)})) {
  if (!node_->winding) throw std::invalid_argument("solid: must not be null");
}

Expression::Expression(SmoothSurfacePtr region)
    : node_(std::make_shared<Node>(Node{.kind = Kind::region, .region = std::move(region)})) {
  if (!node_->region) throw std::invalid_argument("region: must not be null");
}

Expression Expression::combine(Kind kind, const std::vector<Expression>& operands) {
  if (operands.empty())
    throw std::invalid_argument("operands: a union or an intersection needs at least one solid");
  std::vector<Expression> flat;
  for (const Expression& operand : operands) {
    if (operand.kind() == kind)
      flat.insert(flat.end(), operand.operands().begin(), operand.operands().end());
    else
      flat.push_back(operand);
  }
  if (flat.size() == 1) return flat.front();
  return Expression(std::make_shared<const Node>(Node{.kind = kind, .operands = std::move(flat)}));
}

Expression Expression::set_union(const std::vector<Expression>& operands) { return combine(Kind::set_union, operands); }

Expression Expression::intersection(const std::vector<Expression>& operands) {
  return combine(Kind::intersection, operands);
}

Expression Expression::difference(const Expression& a, const Expression& b) { return intersection({a, b.complement()}); }

Expression Expression::complement() const {
  if (kind() == Kind::complement) return operands().front();
  return Expression(std::make_shared<const Node>(Node{.kind = Kind::complement, .operands = {*this}}));
}

Expression Expression::transformed(const Eigen::Matrix4d& map) const {
  switch (kind()) {
    case Kind::polyhedron: return Expression(polyhedron()->transformed(map));
    case Kind::half_space: return Expression(half_space().transformed(map));
    case Kind::curved: return Expression(curved()->transformed(map));
    case Kind::offset: return Expression(offset()->transformed(map));
    case Kind::sum: return Expression(sum()->transformed(map));
    case Kind::winding: return Expression(winding()->transformed(map));
    case Kind::region: throw std::invalid_argument("matrix: a region of a configuration space cannot be transformed");
    default: break;
  }
  std::vector<Expression> moved;
  for (const Expression& operand : operands()) moved.push_back(operand.transformed(map));
  return Expression(std::make_shared<const Node>(Node{.kind = kind(), .operands = std::move(moved)}));
}

namespace {

// A box that contains the solid, or "none": the solid may be unbounded. An empty box is a proof of emptiness.
struct Bound {
  bool known;
  Box3 box;
};

Bound bound_of(const Expression& e, bool negated);

Bound bound_of_set(const Expression& e, bool as_union, bool negated) {
  Bound bound{as_union, Box3()};
  for (const Expression& operand : e.operands()) {
    const Bound part = bound_of(operand, negated);
    if (as_union) {
      if (!part.known) return {false, Box3()};
      if (!part.box.isEmpty()) bound.box.extend(part.box);
    } else if (part.known) {
      bound.box = bound.known ? bound.box.intersection(part.box) : part.box;
      bound.known = true;
    }
  }
  return bound;
}

Bound bound_of(const Expression& e, bool negated) {
  switch (e.kind()) {
    case Expression::Kind::polyhedron: return {!negated, negated ? Box3() : e.polyhedron()->bounding_box()};
    case Expression::Kind::half_space:
    case Expression::Kind::region: return {false, Box3()};
    case Expression::Kind::curved: {
      const auto& box = e.curved()->bounding_box();
      return {!negated && box.has_value(), negated || !box ? Box3() : *box};
    }
    case Expression::Kind::offset: return {!negated, negated ? Box3() : e.offset()->bounding_box()};
    case Expression::Kind::sum: return {!negated, negated ? Box3() : e.sum()->bounding_box()};
    case Expression::Kind::winding: return {!negated, negated ? Box3() : e.winding()->bounding_box()};
    case Expression::Kind::complement: return bound_of(e.operands().front(), !negated);
    case Expression::Kind::set_union: return bound_of_set(e, !negated, negated);
    case Expression::Kind::intersection: return bound_of_set(e, negated, negated);
  }
  return {false, Box3()};
}

}  // namespace

bool Expression::is_bounded() const { return bound_of(*this, false).known; }

Box3 Expression::bounding_box() const {
  const Bound bound = bound_of(*this, false);
  if (!bound.known)
    throw UnboundedError(
        "The expression is unbounded: a half-space, an open quadric or a complement is not cut down by any bounded solid. "
        "Intersect it with one.");
  return bound.box;
}

}  // namespace starcell
