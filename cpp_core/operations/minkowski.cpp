#include "operations/minkowski.h"

#include <cmath>

#include "operations/operand_mesh.h"
#include "operations/tolerances.h"
#include "solids/errors.h"

namespace starcell {
namespace {

// What tessellating one operand may take of the error.
constexpr double tessellation_share = 0.2;
// What the first of two operations may take.
constexpr double first_share = 0.4;

struct Ball {
  Vec3 center;
  double radius;
};

std::optional<Ball> ball_of(const Expression& e) {
  if (e.kind() != Expression::Kind::curved || e.curved()->kind() != CurvedSolid::Kind::sphere || !e.curved()->maps().empty()) return std::nullopt;
  const std::vector<double>& p = e.curved()->parameters();
  return Ball{Vec3(p[0], p[1], p[2]), p[3]};
}

Expression moved(const Expression& e, const Vec3& by) {
  if (by.isZero(0.0)) return e;
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  map.block<3, 1>(0, 3) = by;
  return e.transformed(map);
}

Options with_error(const Options& options, double error) {
  Options result = options;
  result.error = error;
  return result;
}

Box3 sum_of(const Box3& a, const Box3& b) { return a.isEmpty() || b.isEmpty() ? Box3() : Box3(a.min() + b.min(), a.max() + b.max()); }

void announce(const Progress& progress, const char* stage) {
  if (progress && !progress(0, stage)) throw CancelledError("The run was cancelled.");
}

struct OutOfTime {};

// All that is known is where it would be.
PolyhedronPtr left_open(SumSolid::Kind kind, const Polyhedron& a, const Polyhedron& b) {
  Provenance provenance;
  provenance.name = kind == SumSolid::Kind::sum ? "sum" : "erosion";
  provenance.unresolved.push_back(kind == SumSolid::Kind::sum ? sum_of(a.bounding_box(), b.bounding_box()) : a.bounding_box());
  return Polyhedron::trusted({}, {}, std::move(provenance));
}

bool is_nothing(const PolyhedronPtr& solid) { return solid->triangles().empty(); }

// The sum or erosion as a leaf. Of what is empty, or has no mesh in time, nothing is made: its provenance says which of the two it is.
Expression combined(SumSolid::Kind kind, const Expression& a, const Expression& b, double error, const Options& options, const Clock& clock) {
  const PolyhedronPtr one = operand_mesh(a, tessellation_share * error, options, clock, "mesh of the first solid");
  if (is_nothing(one)) return Expression(one);
  const PolyhedronPtr other = operand_mesh(b, tessellation_share * error, options, clock, "mesh of the second solid");
  if (is_nothing(other)) return Expression(other);
  const auto pause = [&] {
    announce(options.progress, "adding faces, edges and vertices");
    if (!(clock.left() > 0)) throw OutOfTime{};
  };
  try {
    return Expression(SumSolid::make(kind, one, other, pause));
  } catch (const OutOfTime&) {
    return Expression(left_open(kind, *one, *other));
  }
}

// Of two steps the first one's result is the second one's operand.
Prepared twice(SumSolid::Kind first, const Expression& a, const Expression& b, const Options& options) {
  const Clock clock(options.budget.max_seconds);
  const double error = error_for(options, a.bounding_box());
  const double most = first_share * error;
  const bool erodes = first == SumSolid::Kind::erosion;
  const Options inner = with_error(options, contour_share * most);
  const Prepared one = erodes ? prepare_erosion(a, b, inner) : prepare_minkowski_sum(a, b, inner);
  Result mesh = evaluate(one.expression, one.options);
  const bool gone = mesh.triangles.empty() && mesh.certificate.unresolved.empty();
  if (gone) return {one.expression, clock.rest(with_error(options, error))};
  const Expression middle(thinned(std::move(mesh), most, erodes ? "erosion" : "dilation", options.progress, clock.left()));
  const Options rest = clock.rest(with_error(options, error));
  return erodes ? prepare_minkowski_sum(middle, b, rest) : prepare_erosion(middle, b, rest);
}

}  // namespace

Prepared prepare_minkowski_sum(const Expression& a, const Expression& b, const Options& options) {
  const Clock clock(options.budget.max_seconds);
  const double error = error_for(options, sum_of(a.bounding_box(), b.bounding_box()));
  for (const bool turned : {false, true}) {
    const Expression &solid = turned ? b : a, &element = turned ? a : b;
    if (const auto ball = ball_of(element)) {
      Prepared offset = prepare_offset(solid, ball->radius, with_error(options, error));
      return {moved(offset.expression, ball->center), offset.options};
    }
  }
  const Expression sum = combined(SumSolid::Kind::sum, a, b, error, options, clock);
  return {sum, clock.rest(with_error(options, error))};
}

Prepared prepare_erosion(const Expression& a, const Expression& b, const Options& options) {
  const Clock clock(options.budget.max_seconds);
  const double error = error_for(options, a.bounding_box());
  if (const auto ball = ball_of(b)) {
    Prepared offset = prepare_offset(a, -ball->radius, with_error(options, error));
    return {moved(offset.expression, -ball->center), offset.options};
  }
  const Expression rest = combined(SumSolid::Kind::erosion, a, b, error, options, clock);
  return {rest, clock.rest(with_error(options, error))};
}

Prepared prepare_opening(const Expression& a, const Expression& b, const Options& options) {
  if (const auto ball = ball_of(b)) return prepare_opening(a, ball->radius, options);
  return twice(SumSolid::Kind::erosion, a, b, options);
}

Prepared prepare_closing(const Expression& a, const Expression& b, const Options& options) {
  if (const auto ball = ball_of(b)) return prepare_closing(a, ball->radius, options);
  return twice(SumSolid::Kind::sum, a, b, options);
}

}  // namespace starcell
