#include "operations/penetration_depth.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <stdexcept>

#include "minkowski/convolution.h"
#include "minkowski/meeting.h"
#include "operations/operand_mesh.h"
#include "solids/errors.h"

namespace starcell {
namespace {

// What tessellating one operand may take of the error; twice the sum of both widens the bounds.
constexpr double tessellation_share = 0.12;
// How far beyond a facet a way out is looked for, of the error.
constexpr double beyond_share = 0.05;
// Of coordinates: what rounding a + b and a distance may cost.
constexpr double rounding = 1e-13;
constexpr std::size_t steps_between_reports = 256;
constexpr int most_stand_ins = 16;

// Where a facet's point x lies between its corners.
Vec3 weights(const std::array<Vec3, 3>& t, const Vec3& x) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], n = u.cross(v);
  const double area = n.squaredNorm();
  if (!(area > 0)) return Vec3::UnitX();
  Vec3 w(0, (x - t[0]).cross(v).dot(n) / area, u.cross(x - t[0]).dot(n) / area);
  w[0] = 1 - w[1] - w[2];
  w = w.cwiseMax(0);
  return w / w.sum();
}

// The triangle's point nearest to the origin.
Vec3 nearest_to_origin(const std::array<Vec3, 3>& t) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), ua = u.dot(t[0]), va = v.dot(t[0]);
  const double det = uu * vv - uv * uv;
  if (det > 0) {
    const double s = (uv * va - vv * ua) / det, r = (uv * ua - uu * va) / det;
    if (s >= 0 && r >= 0 && s + r <= 1) return t[0] + s * u + r * v;
  }
  Vec3 best = t[0];
  for (int k = 0; k < 3; ++k) {
    const Vec3 &p = t[k], d = t[(k + 1) % 3] - p;
    const double length = d.squaredNorm();
    const Vec3 q = p + (length > 0 ? std::clamp(-p.dot(d) / length, 0.0, 1.0) : 0.0) * d;
    if (q.squaredNorm() < best.squaredNorm()) best = q;
  }
  return best;
}

struct Piece {
  double distance;   // of its nearest point, a lower bound
  std::size_t number;
  std::uint32_t facet;
  std::array<Vec3, 3> corners;
  Vec3 outward;

  // The nearest one comes first, of equal ones the oldest.
  friend bool operator<(const Piece& x, const Piece& y) { return x.distance != y.distance ? x.distance > y.distance : x.number > y.number; }
};

class Search {
 public:
  Search(const SumOperand& a, const SumOperand& b, double error, const Options& options, const Clock& clock)
      : a_(a), b_(b), error_(error), options_(options), clock_(clock), meeting_(a, b),
        facets_(convolve(a, b, {true, [this] { report("adding faces, edges and vertices"); }})) {
    for (const Vec3& p : facets_.points) scale_ = std::max(scale_, p.cwiseAbs().maxCoeff());
    slack_ = rounding * scale_;
    box_ = Box3(a.box().min() + b.box().min(), a.box().max() + b.box().max());
  }

  PenetrationDepth run() {
    for (std::uint32_t f = 0; f < facets_.facets.size(); ++f) {
      const Triangle& t = facets_.facets[f];
      const std::array<Vec3, 3> corners{facets_.points[t[0]], facets_.points[t[1]], facets_.points[t[2]]};
      push(f, corners, (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized(), 0);
    }
    // Every facet is part of the sum: seen from outside, the nearest of them is as far as the sum.
    const auto overlap = origin_inside();
    if (overlap == std::optional(false)) return apart();
    leave_the_box();
    while (!queue_.empty() && upper_ - lower_ > error_ && go_on()) step();
    if (queue_.empty()) lower_ = upper_;
    result_.lower = overlap ? std::clamp(lower_, 0.0, upper_) : 0;
    result_.upper = upper_;
    result_.direction = out_.normalized();
    result_.pieces = made_;
    find_points(touching_, out_);
    return result_;
  }

 private:
  PenetrationDepth apart() {
    const double distance = queue_.top().distance;
    result_.separation_lower = distance;
    result_.separation_upper = distance + 2 * slack_;
    find_points(queue_.top().facet, nearest_to_origin(queue_.top().corners));
    result_.pieces = made_;
    return result_;
  }

  // Nearer than all facets every point is where the origin is: of an origin in line with a face or an edge, another one is asked.
  std::optional<bool> origin_inside() const {
    auto told = meeting_.at(Vec3::Zero());
    const double radius = 0.5 * queue_.top().distance;
    for (int k = 1; !told && k <= most_stand_ins && radius > slack_; ++k) {
      const Vec3 aside(std::cos(2.4 * k), std::sin(2.4 * k), std::cos(1.7 * k));
      told = meeting_.at(radius / aside.norm() * aside);
    }
    return told;
  }

  // A facet's point is a sum of a point of A and one of -B.
  void find_points(std::uint32_t facet, const Vec3& x) {
    const Triangle& t = facets_.facets[facet];
    const Vec3 w = weights({facets_.points[t[0]], facets_.points[t[1]], facets_.points[t[2]]}, x);
    result_.point_a = result_.point_b = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const auto [of_a, of_b] = facets_.origins[facet][k];
      result_.point_a += w[k] * a_.points()[of_a];
      result_.point_b -= w[k] * b_.points()[of_b];
    }
  }

  void push(std::uint32_t facet, const std::array<Vec3, 3>& corners, const Vec3& outward, double least) {
    const double distance = std::max(least, nearest_to_origin(corners).norm() - slack_);
    if (distance < upper_) queue_.push({distance, made_++, facet, corners, outward});
  }

  // Past the sum's box, whatever the sum is.
  void leave_the_box() {
    for (int axis = 0; axis < 3; ++axis)
      for (const double to : {box_.min()[axis], box_.max()[axis]}) {
        Vec3 v = Vec3::Zero();
        v[axis] = to + (to < 0 ? -2 : 2) * slack_;
        if (v.norm() < upper_) upper_ = v.norm(), out_ = v;
      }
    // The facet that reaches farthest that way holds the box's side.
    double farthest = -std::numeric_limits<double>::infinity();
    for (std::uint32_t f = 0; f < facets_.facets.size(); ++f)
      for (const std::uint32_t v : facets_.facets[f])
        if (const double far = facets_.points[v].dot(out_); far > farthest) farthest = far, touching_ = f;
  }

  void step() {
    const Piece piece = queue_.top();
    queue_.pop();
    lower_ = std::max(lower_, piece.distance);
    if (lower_ >= upper_) {
      lower_ = upper_;
      return;
    }
    const Vec3 nearest = nearest_to_origin(piece.corners);
    if (piece.outward.allFinite()) try_out(nearest + std::max(beyond_share * error_, 4 * slack_) * piece.outward, piece.facet);
    Box3 around;
    for (const Vec3& p : piece.corners) around.extend(p);
    const Box3 padded(around.min() - Vec3::Constant(slack_), around.max() + Vec3::Constant(slack_));
    if (meeting_.throughout(padded)) return;
    // Smaller than what is left to be told apart: what it hides is within the error of here.
    int longest = 0;
    double length = 0;
    for (int k = 0; k < 3; ++k)
      if (const double l = (piece.corners[(k + 1) % 3] - piece.corners[k]).norm(); l > length) length = l, longest = k;
    if (length <= 64 * slack_) {
      open_ = std::min(open_, piece.distance);
      return;
    }
    const Vec3 middle = 0.5 * (piece.corners[longest] + piece.corners[(longest + 1) % 3]);
    std::array<Vec3, 3> one = piece.corners, other = piece.corners;
    one[(longest + 1) % 3] = middle;
    other[longest] = middle;
    push(piece.facet, one, piece.outward, piece.distance);
    push(piece.facet, other, piece.outward, piece.distance);
  }

  void try_out(const Vec3& v, std::uint32_t facet) {
    if (v.norm() >= upper_ || meeting_.at(v) != std::optional(false)) return;
    upper_ = v.norm() * (1 + 1e-15);
    out_ = v;
    touching_ = facet;
  }

  bool go_on() {
    lower_ = std::min(lower_, open_);
    if (open_ < std::numeric_limits<double>::infinity()) return false;   // at a place that rounding hides
    if (++steps_ % steps_between_reports != 0) return true;
    report("looking for a way out");
    return clock_.left() > 0;
  }

  void report(const char* stage) const {
    const double share = upper_ < std::numeric_limits<double>::infinity() ? std::clamp(lower_ / upper_, 0.0, 1.0) : 0;
    if (options_.progress && !options_.progress(share, stage)) throw CancelledError("The run was cancelled.");
  }

  const SumOperand& a_;
  const SumOperand& b_;
  const double error_;
  const Options& options_;
  const Clock& clock_;
  double lower_ = 0, upper_ = std::numeric_limits<double>::infinity();
  const Meeting meeting_;
  const Convolution facets_;
  double scale_ = 0, slack_ = 0;
  Box3 box_;
  std::priority_queue<Piece> queue_;
  double open_ = std::numeric_limits<double>::infinity();
  Vec3 out_ = Vec3::UnitX();
  std::uint32_t touching_ = 0;   // the facet that out_ comes from
  std::size_t made_ = 0, steps_ = 0;
  PenetrationDepth result_;
};

}  // namespace

PenetrationDepth penetration_depth(const Expression& a, const Expression& b, const Options& options) {
  const Clock clock(options.budget.max_seconds);
  const double error = options.error.value_or(std::min(longest_side(a.bounding_box()), longest_side(b.bounding_box())) / 100);
  if (!(error > 0)) throw std::invalid_argument("error: must be greater than 0");
  const PolyhedronPtr one = operand_mesh(a, tessellation_share * error, options, clock, "mesh of the first solid");
  const PolyhedronPtr other = operand_mesh(b, tessellation_share * error, options, clock, "mesh of the second solid");
  for (const PolyhedronPtr& solid : {one, other}) {
    if (!solid->provenance().unresolved.empty()) throw std::invalid_argument("solid: no certified mesh of it was found within the budget");
    if (solid->triangles().empty()) throw std::invalid_argument("solid: must not be empty");
  }
  const double deflection = one->provenance().deflection + one->provenance().moved + other->provenance().deflection + other->provenance().moved;
  const SumOperand placed(one, {}), turned(other, {true, false});
  PenetrationDepth depth = Search(placed, turned, std::max(error - 2 * deflection, 0.25 * error), options, clock).run();
  depth.deflection = deflection;
  const auto widen = [&](double& low, double& high) { low = std::max(0.0, low - deflection), high += deflection; };
  const bool overlap = depth.upper > 0;
  if (overlap) widen(depth.lower, depth.upper);
  else widen(depth.separation_lower, depth.separation_upper);
  // Meshes that are apart by less than they deflect: the solids may overlap by as much.
  if (!overlap && depth.separation_lower == 0 && deflection > 0) depth.upper = deflection;
  return depth;
}

}  // namespace starcell
