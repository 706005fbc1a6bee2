#include "operations/penetration_depth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <stdexcept>

#include "minkowski/convolution.h"
#include "minkowski/facet_tree.h"
#include "minkowski/meeting.h"
#include "numerics/predicates.h"
#include "operations/offset.h"
#include "operations/operand_mesh.h"
#include "solids/disjoint_sets.h"
#include "solids/errors.h"

namespace starcell {
namespace {

// What tessellating one operand may take of the error; twice the sum of both widens the bounds.
constexpr double tessellation_share = 0.12;
// Solids that are not both convex have a lower bound of their own, from meshes inside them: what tessellating one of those may take, and
// what the searches for the upper and for the lower bound leave open.
constexpr double inner_share = 0.06, upper_share = 0.4, lower_share = 0.05;
// How far beyond a facet a way out is looked for, of the error.
constexpr double beyond_share = 0.05;
// Of coordinates: what rounding a + b and a distance may cost.
constexpr double rounding = 1e-13;
constexpr std::size_t steps_between_reports = 256;
constexpr int most_stand_ins = 16;
// Pieces are not cut smaller than this, of the error: what rounding hides in them, it hides in smaller ones.
constexpr double smallest_share = 1.0 / 64;
// Pieces that are looked at after the first that rounding hides.
constexpr std::size_t most_steps_past_open = 4096;

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

// A point of the triangle; but for needles the nearest to the origin.
Vec3 nearest_to_origin(const std::array<Vec3, 3>& t) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), ua = u.dot(t[0]), va = v.dot(t[0]);
  const double det = uu * vv - uv * uv;
  Vec3 best = t[0];
  if (det > 0) {
    const double s = (uv * va - vv * ua) / det, r = (uv * ua - uu * va) / det;
    if (s >= 0 && r >= 0 && s + r <= 1) best = t[0] + s * u + r * v;
  }
  for (int k = 0; k < 3; ++k) {
    const Vec3 &p = t[k], d = t[(k + 1) % 3] - p;
    const double length = d.squaredNorm();
    const Vec3 q = p + (length > 0 ? std::clamp(-p.dot(d) / length, 0.0, 1.0) : 0.0) * d;
    if (q.squaredNorm() < best.squaredNorm()) best = q;
  }
  return best;
}

// However near x is to the nearest point: all of the triangle is as far along x as its least corner.
double distance_of(const std::array<Vec3, 3>& t, const Vec3& x) {
  const double length = x.norm();
  if (!(length > 0)) return 0;
  return std::max(0.0, std::min({t[0].dot(x), t[1].dot(x), t[2].dot(x)}) / length);
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
  /// `deflection`: what the meshes may lack of the solids, added up: the way out keeps as far from them.
  /// `convex`: both solids are, so that their sum deflects no more than they do.
  Search(const SumOperand& a, const SumOperand& b, double error, double deflection, bool convex, const Options& options, const Clock& clock)
      : a_(a), b_(b), error_(error), deflection_(deflection), convex_(convex), options_(options), clock_(clock), meeting_(a, b),
        facets_(convolve(a, b, {.origins = true, .covers = false, .pause = [this] { report("adding faces, edges and vertices"); }})) {
    if (deflection_ > 0) tree_.emplace(facets_.points, facets_.facets);
    for (const Vec3& p : facets_.points) scale_ = std::max(scale_, p.cwiseAbs().maxCoeff());
    slack_ = rounding * scale_;
    box_ = Box3(a.box().min() + b.box().min(), a.box().max() + b.box().max());
  }

  /// A lower bound of `enough` ends the search.
  PenetrationDepth run(double enough = std::numeric_limits<double>::infinity()) {
    for (std::uint32_t f = 0; f < facets_.facets.size(); ++f) {
      const Triangle& t = facets_.facets[f];
      const std::array<Vec3, 3> corners{facets_.points[t[0]], facets_.points[t[1]], facets_.points[t[2]]};
      push(f, corners, (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized(), 0);
    }
    // Every facet is part of the sum: seen from outside, the nearest of them is as far as the sum.
    const auto overlap = origin_inside();
    if (overlap == std::optional(false)) {
      apart();
      if (queue_.top().distance > deflection_) return result_;
    } else if (deflection_ > 0) {
      result_.separation_upper = deflection_;   // meshes that overlap do not prove that the solids do
    }
    leave_the_box();
    while (!queue_.empty() && upper_ - lower_ > error_ && lower_ < enough && go_on()) step();
    lower_ = std::min(queue_.empty() ? upper_ : lower_, open_);
    const bool proved = overlap == std::optional(true) && (deflection_ == 0 || convex_);
    result_.lower = proved ? std::clamp(lower_ - deflection_, 0.0, upper_) : 0;
    if (result_.lower > 0) result_.separation_upper = 0;
    result_.upper = upper_;
    result_.direction = out_.normalized();
    result_.pieces = made_;
    find_points(touching_, out_);
    return result_;
  }

 private:
  void apart() {
    result_.separation_lower = std::max(0.0, queue_.top().distance - deflection_);
    result_.separation_upper = nearest_.norm() + 2 * slack_ + deflection_;
    find_points(nearest_facet_, nearest_);
    result_.pieces = made_;
  }

  // Nearer than all facets every point is where the origin is: of an origin in line with a face or an edge, another one is asked.
  std::optional<bool> origin_inside() const {
    auto told = meeting_.at(Vec3::Zero());
    if (!told && meeting_.share_a_point(Box3(Vec3::Constant(-slack_), Vec3::Constant(slack_)))) return true;
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
    const Vec3 x = nearest_to_origin(corners);
    if (made_ == 0 || x.squaredNorm() < nearest_.squaredNorm()) nearest_ = x, nearest_facet_ = facet;
    const double distance = std::max(least, distance_of(corners, x) - slack_);
    if (distance < upper_) queue_.push({distance, made_++, facet, corners, outward});
  }

  // Past the sum's box, whatever the sum is.
  void leave_the_box() {
    for (int axis = 0; axis < 3; ++axis)
      for (const double to : {box_.min()[axis], box_.max()[axis]}) {
        Vec3 v = Vec3::Zero();
        v[axis] = to + (to < 0 ? -1 : 1) * (2 * slack_ + deflection_);
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
    const double beyond = std::max(beyond_share * error_, 4 * slack_);
    const Vec3 past = nearest + (1.01 * deflection_ + beyond) * piece.outward;
    if (past.allFinite() && past.norm() < upper_) leads_out(past, piece.facet);
    Box3 around;
    for (const Vec3& p : piece.corners) around.extend(p);
    const Box3 padded(around.min() - Vec3::Constant(slack_), around.max() + Vec3::Constant(slack_));
    if (meeting_.throughout(padded) || meeting_.share_a_point(padded)) return;
    // Smaller than what is left to be told apart: what it hides is within the error of here.
    int longest = 0;
    double length = 0;
    for (int k = 0; k < 3; ++k)
      if (const double l = (piece.corners[(k + 1) % 3] - piece.corners[k]).norm(); l > length) length = l, longest = k;
    if (length <= std::max(64 * slack_, smallest_share * error_)) {
      if (past.allFinite()) look_aside(past, 0.5 * beyond, piece.facet);
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

  // Solids are told from touching where they are apart: that is where a face slides along, or a corner fits, only a little aside of it.
  void look_aside(const Vec3& v, double aside, std::uint32_t facet) {
    for (int k = 0; k < 27; ++k)
      if (const Vec3 to(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1); (v + aside * to).norm() < upper_) leads_out(v + aside * to, facet);
  }

  void leads_out(const Vec3& v, std::uint32_t facet) {
    if (meeting_.at(v) != std::optional(false) || !keeps_clear(v)) return;
    upper_ = v.norm() * (1 + 1e-15);
    out_ = v;
    touching_ = facet;
  }

  // No facet of the sum is nearer to v than the deflection.
  bool keeps_clear(const Vec3& v) const {
    if (deflection_ == 0) return true;
    const auto& nodes = tree_->nodes();
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
      const FacetTree::Node& node = nodes[stack.back()];
      stack.pop_back();
      if (node.box.exteriorDistance(v) > deflection_ + slack_) continue;
      if (node.child != 0) {
        stack.push_back(node.child);
        stack.push_back(node.child + 1);
        continue;
      }
      for (std::uint32_t k = node.first; k < node.last; ++k) {
        const Triangle& t = facets_.facets[tree_->order()[k]];
        const std::array<Vec3, 3> corners{facets_.points[t[0]] - v, facets_.points[t[1]] - v, facets_.points[t[2]] - v};
        if (distance_of(corners, nearest_to_origin(corners)) - slack_ < deflection_) return false;
      }
    }
    return true;
  }

  bool go_on() {
    lower_ = std::min(lower_, open_);
    // Beyond a place that rounding hides only the upper bound may still become better.
    if (open_ < std::numeric_limits<double>::infinity() && ++steps_past_open_ > most_steps_past_open) return false;
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
  const double error_, deflection_;
  const bool convex_;
  const Options& options_;
  const Clock& clock_;
  double lower_ = 0, upper_ = std::numeric_limits<double>::infinity();
  const Meeting meeting_;
  const Convolution facets_;
  std::optional<FacetTree> tree_;   // of the facets; only if they have to be kept clear of
  double scale_ = 0, slack_ = 0;
  Box3 box_;
  std::priority_queue<Piece> queue_;
  double open_ = std::numeric_limits<double>::infinity();
  Vec3 out_ = Vec3::UnitX();
  std::uint32_t touching_ = 0;   // the facet that out_ comes from
  Vec3 nearest_ = Vec3::Zero();  // of all facets' points
  std::uint32_t nearest_facet_ = 0;
  std::size_t made_ = 0, steps_ = 0, steps_past_open_ = 0;
  PenetrationDepth result_;
};

// Closed, in one piece and nowhere reflex. A tessellation says nothing of its solid.
bool is_convex(const Polyhedron& solid) {
  if (solid.provenance().deflection > 0 || solid.provenance().moved > 0) return false;
  DisjointSets pieces(solid.vertices().size());
  const std::vector<Triangle>& facets = solid.triangles();
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Triangle& t = facets[f];
    for (int k = 0; k < 3; ++k) {
      pieces.join(pieces.root(t[0]), pieces.root(t[k]));
      for (const std::uint32_t apex : facets[solid.neighbours()[f][k]])
        if (side(solid.vertices()[t[0]], solid.vertices()[t[1]], solid.vertices()[t[2]], solid.vertices()[apex]) > 0) return false;
    }
  }
  return std::all_of(facets.begin(), facets.end(), [&](const Triangle& t) { return pieces.root(t[0]) == pieces.root(facets[0][0]); });
}

bool is_convex(const Expression& solid) {
  switch (solid.kind()) {
    case Expression::Kind::half_space: return true;
    case Expression::Kind::polyhedron: return is_convex(*solid.polyhedron());
    case Expression::Kind::curved: return solid.curved()->kind() != CurvedSolid::Kind::torus && solid.curved()->kind() != CurvedSolid::Kind::quadric;
    case Expression::Kind::intersection: return std::all_of(solid.operands().begin(), solid.operands().end(), [](const Expression& e) { return is_convex(e); });
    default: return false;
  }
}

double off_by(const PolyhedronPtr& mesh) { return mesh->provenance().deflection + mesh->provenance().moved; }

// A mesh that lies wholly in the solid: of the solid eroded by as much as the mesh may be off. None if no such mesh was found.
PolyhedronPtr mesh_inside(const Expression& solid, const PolyhedronPtr& mesh, double error, const Options& options, const Clock& clock) {
  if (off_by(mesh) == 0) return mesh;
  const double given = solid.kind() == Expression::Kind::polyhedron ? off_by(mesh) : 0;   // before anything was eroded
  Options within = clock.rest(options);
  within.error = error;
  within.contact.reset();
  const Prepared eroded = prepare_offset(solid, -(given + error), within);
  PolyhedronPtr inside = operand_mesh(eroded.expression, error, eroded.options, clock, "mesh inside a solid");
  const bool proved = inside->provenance().unresolved.empty() && !inside->triangles().empty() && off_by(inside) <= given + error;
  return proved ? inside : nullptr;
}

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
  const double deflection = off_by(one) + off_by(other);
  const bool convex = is_convex(a) && is_convex(b);
  const SumOperand placed(one, {}), turned(other, {true, false});
  const double search_error = deflection == 0 || convex ? std::max(error - deflection, 0.25 * error) : upper_share * error;
  PenetrationDepth depth = Search(placed, turned, search_error, deflection, convex, options, clock).run();
  depth.deflection = deflection;
  if (depth.upper == 0 || deflection == 0 || convex) return depth;
  // What overlaps inside both solids does so with them.
  const PolyhedronPtr in_one = mesh_inside(a, one, inner_share * error, options, clock), in_other = mesh_inside(b, other, inner_share * error, options, clock);
  if (!in_one || !in_other) return depth;
  const SumOperand inner(in_one, {}), inner_turned(in_other, {true, false});
  depth.lower = std::min(depth.upper, Search(inner, inner_turned, lower_share * error, 0, true, options, clock).run(depth.upper - error).lower);
  if (depth.lower > 0) depth.separation_upper = 0;
  return depth;
}

}  // namespace starcell
