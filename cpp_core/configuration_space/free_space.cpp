#include "configuration_space/free_space.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "configuration_space/wrapped_components.h"
#include "operations/evaluate_in_few.h"
#include "operations/minkowski.h"
#include "operations/tolerances.h"
#include "solids/box.h"

namespace starcell {
namespace {

// A power of two, at least the radius.
double unit_for(double radius) { return radius > 0 ? std::exp2(std::ceil(std::log2(radius))) : 1; }

// Does a triangle lie on a side of the domain, but for rounding?
std::uint8_t kind_of(const Result& r, const Triangle& t, const Box3& domain) {
  const double near = 1e-12 * domain.sizes().maxCoeff();
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {domain.min()[axis], domain.max()[axis]})
      if (std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return std::abs(r.vertices[v][axis] - side) <= near; })) return 1;
  return 0;
}

void scale_back(Result& r, const Vec3& by) {
  for (Vec3& p : r.vertices) p = p.cwiseProduct(by);
  for (auto* boxes : {&r.certificate.contacts, &r.certificate.unresolved})
    for (Box3& box : *boxes) box = Box3(box.min().cwiseProduct(by), box.max().cwiseProduct(by));
}

}  // namespace

ConfigurationProblem planar_robot(const std::vector<Ring>& robot, const std::vector<Ring>& obstacles, const std::array<double, 2>& lower, const std::array<double, 2>& upper) {
  if (robot.empty()) throw std::invalid_argument("polygon: the robot has none");
  for (std::size_t k = 0; k < 2; ++k)
    if (!std::isfinite(lower[k]) || !std::isfinite(upper[k]) || !(lower[k] < upper[k]))
      throw std::invalid_argument("bounds: the lower corner must be finite and below the upper one");
  ConfigurationProblem problem;
  Body body{nullptr, std::make_shared<const PieceTree>(piece_tree(robot, "polygon")), std::make_shared<const PieceTree>(piece_tree(obstacles, "obstacles"))};
  double radius = 0;
  for (const Ring& ring : robot)
    for (const Point2& p : ring) radius = std::max(radius, std::hypot(p[0], p[1]));
  problem.unit = unit_for(radius);
  body.frame = free_frame(problem.unit);
  if (!body.fixed->roots.empty()) problem.bodies.push_back(std::move(body));
  problem.domain = {Vec3(lower[0], lower[1], 0), Vec3(upper[0], upper[1], problem.unit * 2 * M_PI)};
  return problem;
}

ConfigurationProblem planar_arm(const std::array<double, 3>& lengths, const std::array<double, 2>& base, bool self_collision, const std::vector<Ring>& obstacles) {
  for (const double length : lengths)
    if (!(std::isfinite(length) && length > 0)) throw std::invalid_argument("link_lengths: must be finite and greater than 0");
  if (!std::isfinite(base[0]) || !std::isfinite(base[1])) throw std::invalid_argument("base: must be finite");
  ConfigurationProblem problem;
  problem.unit = unit_for(lengths[0] + lengths[1] + lengths[2]);
  problem.first_angle = 0;
  const auto fixed = std::make_shared<const PieceTree>(piece_tree(obstacles, "obstacles"));
  std::array<std::shared_ptr<const PieceTree>, 3> links;
  for (std::size_t k = 0; k < 3; ++k) links[k] = std::make_shared<const PieceTree>(segment_piece(lengths[k]));
  for (int k = 0; k < 3 && !fixed->roots.empty(); ++k) problem.bodies.push_back({link_frame(lengths, base, problem.unit, k, -1), links[static_cast<std::size_t>(k)], fixed});
  if (self_collision) problem.bodies.push_back({link_frame(lengths, base, problem.unit, 2, 0), links[2], links[0]});
  problem.domain = {Vec3::Zero(), Vec3::Constant(problem.unit * 2 * M_PI)};
  return problem;
}

FreeSpace free_translations(const Expression& robot, const Expression& obstacles, const Vec3& lower, const Vec3& upper, const Options& options, bool decimate) {
  if (!lower.allFinite() || !upper.allFinite() || !(lower.array() < upper.array()).all())
    throw std::invalid_argument("bounds: the lower corner must be finite and below the upper one");
  const Box3 domain(lower, upper);
  Options with_error = options;
  with_error.error = error_for(options, domain);
  const Eigen::Matrix4d mirror = Eigen::Vector4d(-1, -1, -1, 1).asDiagonal();
  const Prepared sum = prepare_minkowski_sum(obstacles, robot.transformed(mirror), with_error);
  const Expression free = Expression::difference(Expression(make_box(lower, upper)), sum.expression);
  FreeSpace space{decimate ? evaluate_in_few(free, sum.options) : evaluate(free, sum.options), {}, {}};
  for (const Triangle& t : space.result.triangles) space.facet_kind.push_back(kind_of(space.result, t, domain));
  space.components = wrapped_components(space.result, nullptr, domain, 3);
  return space;
}

FreeSpace free_space(const ConfigurationProblem& problem, const Options& options, bool decimate) {
  const Expression domain(make_box(problem.domain.min(), problem.domain.max()));
  std::shared_ptr<const CollisionSurface> surface;
  if (!problem.bodies.empty()) surface = std::make_shared<const CollisionSurface>(problem.bodies);
  const Expression free = surface ? Expression::difference(domain, Expression(SmoothSurfacePtr(surface))) : domain;
  // Components by the mesh as contoured: its points are still on the domain's sides.
  FreeSpace space;
  const auto count = [&](const Result& contoured) { space.components = wrapped_components(contoured, surface.get(), problem.domain, problem.first_angle); };
  if (decimate) {
    space.result = evaluate_in_few(free, options, count);
  } else {
    space.result = evaluate(free, options);
    count(space.result);
  }
  for (const Triangle& t : space.result.triangles) space.facet_kind.push_back(kind_of(space.result, t, problem.domain));
  Vec3 by = Vec3::Ones();
  for (int axis = problem.first_angle; axis < 3; ++axis) by[axis] = 1 / problem.unit;
  scale_back(space.result, by);
  return space;
}

}  // namespace starcell
