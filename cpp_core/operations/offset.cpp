#include "operations/offset.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "operations/closed_offset.h"
#include "operations/critical_width.h"
#include "operations/operand_mesh.h"

namespace starcell {
namespace {

// What tessellating an operand may take of the error.
constexpr double tessellation_share = 0.25;
// What the first of two offsets may take.
constexpr double first_share = 0.4;

class Offsetting {
 public:
  Offsetting(double error, const Options& options) : error_(error), options_(options), clock_(options.budget.max_seconds) {}

  /// What the expression is to be evaluated with.
  Options rest() const {
    Options options = clock_.rest(options_);
    options.error = error_;
    return options;
  }

  Expression of(const Expression& e, double r) const {
    using Kind = Expression::Kind;
    if (e.kind() == Kind::polyhedron && e.polyhedron()->triangles().empty()) return e;   // nothing, or no mesh of it
    if (const auto closed = closed_offset(e, r)) return *closed;
    switch (e.kind()) {
      case Kind::polyhedron: return of_polyhedron(e.polyhedron(), r);
      case Kind::complement: return of(e.operands().front(), -r).complement();
      case Kind::set_union:
        if (r > 0) return Expression::set_union(parts_of(e, r));
        break;
      case Kind::intersection:
        if (r < 0) return Expression::intersection(parts_of(e, r));
        break;
      case Kind::half_space:
      case Kind::curved:
      case Kind::offset:
      case Kind::sum:
      case Kind::winding:
      case Kind::region: break;
    }
    return of(Expression(meshed(e)), r);
  }

  /// The solid as a polyhedron: itself, or a certified mesh of it; none if it is empty, or if no mesh could be proved: then its
  /// provenance says so, and what is made of it is unresolved.
  PolyhedronPtr meshed(const Expression& e) const { return operand_mesh(e, tessellation_share * error_, options_, clock_, "mesh of the solid"); }

 private:
  Expression of_polyhedron(const PolyhedronPtr& solid, double r) const {
    const double contact = options_.contact.value_or(std::isinf(error_) ? longest_side(solid->bounding_box()) / 12800 : error_ / 100);
    const OffsetTask task = off_critical_width(solid, r, contact, [&] { return !options_.progress || options_.progress(0.99, "looking for critical widths"); });
    return Expression(OffsetSolid::make(task.solid, task.distance));
  }

  // One by one where there are closed forms. The others are taken together: their faces may lie on one plane, and so would their
  // offsets' surfaces, which have no identity.
  std::vector<Expression> parts_of(const Expression& e, double r) const {
    std::vector<Expression> result, others;
    for (const Expression& operand : e.operands()) {
      // A polyhedron's half-spaces would meet its neighbours' in one plane.
      const Expression& solid = operand.kind() == Expression::Kind::complement ? operand.operands().front() : operand;
      const auto closed = solid.kind() == Expression::Kind::polyhedron ? std::nullopt : closed_offset(operand, r);
      if (closed)
        result.push_back(*closed);
      else
        others.push_back(operand);
    }
    if (others.size() == 1) result.push_back(of(others.front(), r));
    if (others.size() > 1) {
      const Expression all = e.kind() == Expression::Kind::set_union ? Expression::set_union(others) : Expression::intersection(others);
      result.push_back(of(Expression(meshed(all)), r));
    }
    return result;
  }

  double error_;
  const Options& options_;
  const Clock clock_;
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
  const double most = first_share * error;
  const Options inner = with_error(options, contour_share * most);
  const Offsetting offsetting(error, options);
  const Prepared one = prepare_offset(solid, first, inner);
  Result mesh = evaluate(one.expression, one.options);
  if (mesh.triangles.empty() && mesh.certificate.unresolved.empty()) return {one.expression, offsetting.rest()};   // it is gone, and stays so
  const auto middle = thinned(std::move(mesh), most, first < 0 ? "erosion" : "dilation", options.progress, offsetting.rest().budget.max_seconds);
  const Expression both = offsetting.of(Expression(middle), -first);
  return {both, offsetting.rest()};
}

// All that is within `radius` of the faces that stay.
Expression wall_about(const Expression& solid, double radius, const std::vector<std::int64_t>& open_faces) {
  if (solid.kind() != Expression::Kind::polyhedron) throw std::invalid_argument("open_faces: only a polyhedron, or an import, has faces to leave open");
  const PolyhedronPtr& polyhedron = solid.polyhedron();
  const auto& cad_face = polyhedron->provenance().cad_face;
  const std::set<std::int64_t> open(open_faces.begin(), open_faces.end());
  std::set<std::int64_t> unknown = open;
  std::vector<std::uint32_t> stay;
  for (std::uint32_t t = 0; t < polyhedron->triangles().size(); ++t) {
    const std::int64_t face = cad_face.empty() ? t : cad_face[t];
    unknown.erase(face);
    if (!open.count(face)) stay.push_back(t);
  }
  if (!unknown.empty())
    throw std::invalid_argument("open_faces: the solid has no " + std::string(cad_face.empty() ? "triangle " : "face ") + std::to_string(*unknown.begin()));
  if (stay.empty()) throw std::invalid_argument("open_faces: a shell needs a face that stays");
  return Expression(OffsetSolid::about_faces(polyhedron, std::move(stay), radius));
}

}  // namespace

Prepared prepare_offset(const Expression& solid, double distance, const Options& options) {
  check(distance, "distance");
  const double error = error_for(solid, distance, options);
  const Offsetting offsetting(error, options);
  const Expression result = offsetting.of(solid, distance);
  return {result, offsetting.rest()};
}

Prepared prepare_shell(const Expression& solid, double thickness, const Options& options, const std::vector<std::int64_t>& open_faces) {
  check(thickness, "thickness");
  const double error = error_for(solid, thickness, options);
  const Offsetting offsetting(error, options);
  const Expression reached = open_faces.empty() ? offsetting.of(solid, thickness) : wall_about(solid, std::abs(thickness), open_faces);
  if (thickness > 0) return {Expression::difference(reached, solid), offsetting.rest()};
  return {open_faces.empty() ? Expression::difference(solid, reached) : Expression::intersection({solid, reached}), offsetting.rest()};
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
