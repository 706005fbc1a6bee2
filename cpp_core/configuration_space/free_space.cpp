#include "configuration_space/free_space.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "configuration_space/crossing_links.h"
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

ConfigurationProblem planar_robot(const std::vector<PlanarPolygon>& robot, const std::vector<PlanarPolygon>& obstacles, const std::array<double, 2>& lower, const std::array<double, 2>& upper) {
  if (robot.empty()) throw std::invalid_argument("polygon: the robot has none");
  for (std::size_t k = 0; k < 2; ++k)
    if (!std::isfinite(lower[k]) || !std::isfinite(upper[k]) || !(lower[k] < upper[k]))
      throw std::invalid_argument("bounds: the lower corner must be finite and below the upper one");
  ConfigurationProblem problem;
  Body body{nullptr, std::make_shared<const PieceTree>(piece_tree(robot, "polygon")), std::make_shared<const PieceTree>(piece_tree(obstacles, "obstacles"))};
  double radius = 0;
  for (const PlanarPolygon& polygon : robot)
    for (const Point2& p : polygon.outer) radius = std::max(radius, std::hypot(p[0], p[1]));
  problem.unit = unit_for(radius);
  body.frame = free_frame(problem.unit);
  if (!body.fixed->roots.empty()) problem.bodies.push_back(std::move(body));
  problem.domain = {Vec3(lower[0], lower[1], 0), Vec3(upper[0], upper[1], problem.unit * 2 * M_PI)};
  return problem;
}

namespace {

void check(const Arm& arm) {
  const auto finite = [](const auto& numbers) { return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }); };
  for (const double length : arm.lengths)
    if (!(std::isfinite(length) && length > 0)) throw std::invalid_argument("link_lengths: must be finite and greater than 0");
  if (!finite(arm.base)) throw std::invalid_argument("base: must be finite");
  for (std::size_t k = 0; k < 3; ++k)
    if (const auto& limits = arm.limits[k]; limits && !(finite(*limits) && (*limits)[0] < (*limits)[1] && (*limits)[1] - (*limits)[0] <= 2 * M_PI))
      throw std::invalid_argument("joint_limits: those of joint " + std::to_string(k) + " must be finite, the lower before the upper, within 2 pi of it");
}

}  // namespace

ConfigurationProblem planar_arm(const Arm& arm, const std::vector<PlanarPolygon>& obstacles) {
  check(arm);
  ConfigurationProblem problem;
  const auto fixed = std::make_shared<const PieceTree>(piece_tree(obstacles, "obstacles"));
  std::array<std::shared_ptr<const PieceTree>, 3> links;
  double radius = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    links[k] = std::make_shared<const PieceTree>(arm.shapes[k].empty() ? segment_piece(arm.lengths[k]) : piece_tree(arm.shapes[k], "link_shapes"));
    radius += arm.lengths[k];
  }
  problem.unit = unit_for(radius);
  problem.first_angle = 0;
  for (int k = 0; k < 3; ++k) {
    const auto& limits = arm.limits[static_cast<std::size_t>(k)];
    problem.goes_round[static_cast<std::size_t>(k)] = !limits;
    problem.domain.min()[k] = limits ? problem.unit * (*limits)[0] : 0;
    problem.domain.max()[k] = problem.unit * (limits ? (*limits)[1] : 2 * M_PI);
    if (!fixed->roots.empty()) problem.bodies.push_back({link_frame(arm.lengths, arm.base, problem.unit, k, -1), links[static_cast<std::size_t>(k)], fixed});
  }
  if (!arm.self_collision) return problem;
  if (arm.shapes[0].empty() && arm.shapes[2].empty())
    problem.crossing = arm.lengths;
  else
    problem.bodies.push_back({link_frame(arm.lengths, arm.base, problem.unit, 2, 0), links[2], links[0]});
  return problem;
}

ConfigurationProblem::Collision ConfigurationProblem::collision(double contact) const {
  constexpr double move_share = 0.25;
  Collision found;
  std::vector<Expression> all;
  if (!bodies.empty()) all.emplace_back(SmoothSurfacePtr(std::make_shared<const CollisionSurface>(bodies)));
  if (crossing)
    if (auto links = crossing_links(*crossing, unit, domain, 0)) {
      if (!links->contacts.empty()) links = crossing_links(*crossing, unit, domain, move_share * contact);
      all.push_back(links->set);
      found.moved = links->moved;
      found.contacts = std::move(links->contacts);
    }
  if (!all.empty()) found.set = Expression::set_union(all);
  return found;
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
  space.components = wrapped_components(space.result, std::nullopt, domain, {false, false, false});
  return space;
}

FreeSpace free_space(const ConfigurationProblem& problem, const Options& options, bool decimate) {
  const Expression domain(make_box(problem.domain.min(), problem.domain.max()));
  const double error = error_for(options, problem.domain);
  Options exact = options;
  exact.error = error;
  exact.contact = split_error(exact, problem.domain, 0).contact;
  const ConfigurationProblem::Collision collision = problem.collision(*exact.contact);
  exact.error = error - collision.moved;
  const Expression free = collision.set ? Expression::difference(domain, *collision.set) : domain;
  FreeSpace space;
  // Components by the mesh as contoured: its points are still on the domain's sides.
  const auto count = [&](const Result& contoured) { space.components = wrapped_components(contoured, collision.set, problem.domain, problem.goes_round); };
  if (decimate) {
    space.result = evaluate_in_few(free, exact, count);
  } else {
    space.result = evaluate(free, exact);
    count(space.result);
  }
  Certificate& c = space.result.certificate;
  c.error_bound += collision.moved;
  c.requested_error = error;
  if (!collision.contacts.empty() && c.verdict == Verdict::exact) c.verdict = Verdict::contact;
  c.contacts.insert(c.contacts.end(), collision.contacts.begin(), collision.contacts.end());
  for (const Triangle& t : space.result.triangles) space.facet_kind.push_back(kind_of(space.result, t, problem.domain));
  Vec3 by = Vec3::Ones();
  for (int axis = problem.first_angle; axis < 3; ++axis) by[axis] = 1 / problem.unit;
  scale_back(space.result, by);
  return space;
}

}  // namespace starcell
