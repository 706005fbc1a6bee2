#include "operations/offset.h"

#include <cmath>
#include <stdexcept>

namespace starcell {
namespace {

// What tessellating an operand may take of the error.
constexpr double tessellation_share = 0.25;
// What the first of two offsets may take.
constexpr double first_share = 0.4;

class Offsetting {
 public:
  Offsetting(double error, const Options& options) : error_(error), options_(options) {}

  Expression of(const Expression& e, double r) const {
    using Kind = Expression::Kind;
    switch (e.kind()) {
      case Kind::polyhedron: return Expression(OffsetSolid::make(e.polyhedron(), r));
      case Kind::half_space: {
        HalfSpace moved = e.half_space();
        moved.point += r * moved.normal.normalized();
        return Expression(moved);
      }
      case Kind::curved:
        if (const auto closed = closed_form(*e.curved(), r)) return Expression(closed);
        break;
      case Kind::complement: return of(e.operands().front(), -r).complement();
      case Kind::set_union:
        if (r > 0) return Expression::set_union(all_of(e, r));
        break;
      case Kind::intersection:
        if (r < 0) return Expression::intersection(all_of(e, r));
        break;
      case Kind::offset: break;
    }
    return Expression(OffsetSolid::make(meshed(e), r));
  }

  /// The solid as a polyhedron: itself, or a certified mesh of it.
  PolyhedronPtr meshed(const Expression& e) const {
    if (e.kind() == Expression::Kind::polyhedron) return e.polyhedron();
    Options options = options_;
    options.error = tessellation_share * error_;
    options.contact.reset();
    Result mesh = evaluate(e, options);
    if (mesh.triangles.empty()) throw std::invalid_argument("solid: it is empty, or has no certified mesh within the error");
    Provenance provenance;
    provenance.name = "mesh of the solid";
    provenance.deflection = mesh.certificate.error_bound;
    return Polyhedron::trusted(std::move(mesh.vertices), std::move(mesh.triangles), std::move(provenance));
  }

 private:
  std::vector<Expression> all_of(const Expression& e, double r) const {
    std::vector<Expression> result;
    for (const Expression& operand : e.operands()) result.push_back(of(operand, r));
    return result;
  }

  // Balls and tori that were only moved.
  static CurvedSolidPtr closed_form(const CurvedSolid& solid, double r) {
    const std::vector<double>& p = solid.parameters();
    if (!solid.maps().empty()) return nullptr;
    if (solid.kind() == CurvedSolid::Kind::sphere && p[3] + r > 0) return CurvedSolid::sphere({p[0], p[1], p[2]}, p[3] + r);
    if (solid.kind() == CurvedSolid::Kind::torus && p[7] + r > 0 && p[7] + r < p[6])
      return CurvedSolid::torus({p[0], p[1], p[2]}, {p[3], p[4], p[5]}, p[6], p[7] + r);
    return nullptr;
  }

  double error_;
  const Options& options_;
};

void check(double value, const char* name) {
  if (!std::isfinite(value) || value == 0) throw std::invalid_argument(std::string(name) + ": must be finite and not 0");
}

// The error asked for, or what it is if it was not: the result's longest side / 128.
double error_for(const Expression& solid, double grown, const Options& options) {
  if (options.error) return *options.error;
  const double length = longest_side(solid.bounding_box()) + 2 * std::max(0.0, grown);
  return length / 128;
}

Options with_error(const Options& options, double error) {
  Options result = options;
  result.error = error;
  return result;
}

// Offset by `first` and back by -first: the first result is the second one's operand.
Prepared twice(const Expression& solid, double first, const Options& options) {
  const double error = error_for(solid, 0, options);
  const Options inner = with_error(options, first_share * error);
  const Prepared one = prepare_offset(solid, first, inner);
  const Offsetting offsetting(error, options);
  Result mesh = evaluate(one.expression, one.options);
  if (mesh.triangles.empty()) return {one.expression, with_error(options, error)};   // it is gone, and stays so
  Provenance provenance;
  provenance.name = first < 0 ? "erosion" : "dilation";
  provenance.deflection = mesh.certificate.error_bound;
  const auto middle = Polyhedron::trusted(std::move(mesh.vertices), std::move(mesh.triangles), std::move(provenance));
  return {offsetting.of(Expression(middle), -first), with_error(options, error)};
}

}  // namespace

Prepared prepare_offset(const Expression& solid, double distance, const Options& options) {
  check(distance, "distance");
  const double error = error_for(solid, distance, options);
  return {Offsetting(error, options).of(solid, distance), with_error(options, error)};
}

Prepared prepare_shell(const Expression& solid, double thickness, const Options& options) {
  check(thickness, "thickness");
  const double error = error_for(solid, thickness, options);
  const Expression moved = Offsetting(error, options).of(solid, thickness);
  return {thickness > 0 ? Expression::difference(moved, solid) : Expression::difference(solid, moved), with_error(options, error)};
}

Prepared prepare_opening(const Expression& solid, double radius, const Options& options) {
  check(radius, "radius");
  if (radius < 0) throw std::invalid_argument("radius: must be positive");
  return twice(solid, -radius, options);
}

Prepared prepare_closing(const Expression& solid, double radius, const Options& options) {
  check(radius, "radius");
  if (radius < 0) throw std::invalid_argument("radius: must be positive");
  return twice(solid, radius, options);
}

}  // namespace starcell
