#include "configuration_space/wrapped_components.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "numerics/predicates.h"
#include "solids/connectivity.h"
#include "solids/disjoint_sets.h"

namespace starcell {
namespace {

// Of the error: room beyond it that a witness has.
constexpr double more_room = 1.01;
// Cosine of the angle by which a side's triangles may lean.
constexpr double facing = 0.9;
// Of the domain's size: how far a side's points may be off it.
constexpr double moved_share = 1e-5;

// Is the whole box certainly inside (1), certainly outside (-1)? Else 0.
int side(const Expression& e, const Vec3& center, const Vec3& reach) {
  using Kind = Expression::Kind;
  if (e.kind() == Kind::region) {
    const Rounding rounding;
    const auto sign_of = [&](const SmoothSurface& f) { return certain_sign(f.expand(center, reach).range()); };
    if (const int sign = sign_of(*e.region()); sign != 0) return -sign;
    const SmoothSurfacePtr here = e.region()->restricted(Box3(center - reach, center + reach));
    return here ? -sign_of(*here) : 0;
  }
  if (e.kind() == Kind::complement) return -side(e.operands().front(), center, reach);
  if (e.kind() != Kind::set_union && e.kind() != Kind::intersection) return 0;
  const int decides = e.kind() == Kind::set_union ? 1 : -1;
  int rest = -decides;
  for (const Expression& operand : e.operands()) {
    const int one = side(operand, center, reach);
    if (one == decides) return decides;
    if (one == 0) rest = 0;
  }
  return rest;
}

class Wrapping {
 public:
  Wrapping(const Result& r, const std::optional<Expression>& collision, const Box3& domain)
      : r_(r), collision_(collision), domain_(domain), neighbours_(connect(r.vertices, r.triangles).neighbours), shells_(r.triangles.size()) {
    for (std::uint32_t t = 0; t < r.triangles.size(); ++t)
      for (const std::uint32_t n : neighbours_[t])
        if (n != kNoTriangle) shells_.join(t, n);
  }

  std::optional<std::size_t> count(const std::array<bool, 3>& goes_round) {
    const double room = r_.certificate.error_bound * more_room;
    if (!std::isfinite(room)) return std::nullopt;
    std::map<std::uint32_t, double> volumes;
    for (std::uint32_t t = 0; t < r_.triangles.size(); ++t) {
      const auto& [a, b, c] = r_.triangles[t];
      const Vec3 o = domain_.center();
      volumes[shells_.root(t)] += (r_.vertices[a] - o).dot((r_.vertices[b] - o).cross(r_.vertices[c] - o));
    }
    std::vector<std::uint32_t> outer;   // the others bound holes of these
    for (const auto& [root, volume] : volumes)
      if (volume > 0) outer.push_back(root);
    if (outer.size() == 1) return 1;
    for (int axis = 0; axis < 3; ++axis)
      if (goes_round[static_cast<std::size_t>(axis)] && !join(axis, room)) return std::nullopt;
    std::vector<std::uint32_t> roots;
    for (const std::uint32_t root : outer) roots.push_back(shells_.root(root));
    std::sort(roots.begin(), roots.end());
    return static_cast<std::size_t>(std::unique(roots.begin(), roots.end()) - roots.begin());
  }

 private:
  // What is on the side, and faces its way: gaps for float32 move points by some of its steps (contouring/float_gaps.h).
  std::vector<std::uint32_t> cap(int axis, double side) const {
    const double near = moved_share * domain_.sizes().maxCoeff();
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < r_.triangles.size(); ++t) {
      const auto& [a, b, c] = r_.triangles[t];
      if (!std::all_of(r_.triangles[t].begin(), r_.triangles[t].end(), [&](std::uint32_t v) { return std::abs(r_.vertices[v][axis] - side) <= near; })) continue;
      const Vec3 normal = (r_.vertices[b] - r_.vertices[a]).cross(r_.vertices[c] - r_.vertices[a]);
      if (std::abs(normal[axis]) >= facing * normal.norm()) found.push_back(t);
    }
    return found;
  }

  bool join(int axis, double room) {
    const std::array<std::vector<std::uint32_t>, 2> caps{cap(axis, domain_.min()[axis]), cap(axis, domain_.max()[axis])};
    for (const std::size_t end : {0, 1}) {
      DisjointSets parts(r_.vertices.size());   // joined in points: beside a crease single triangles may lean
      for (const std::uint32_t t : caps[end])
        for (const std::uint32_t v : r_.triangles[t]) parts.join(r_.triangles[t][0], v);
      std::map<std::uint32_t, std::vector<std::uint32_t>> triangles;
      for (const std::uint32_t t : caps[end]) triangles[parts.root(r_.triangles[t][0])].push_back(t);
      for (const auto& [root, part] : triangles)
        if (is_on_side(part, axis, end) && !witness(part, caps[1 - end], axis, end, room)) return false;
    }
    return true;
  }

  // Is any triangle on the side to rounding? Else it is a contact surface that comes that near to it.
  bool is_on_side(const std::vector<std::uint32_t>& part, int axis, std::size_t end) const {
    const double side = end == 0 ? domain_.min()[axis] : domain_.max()[axis], near = 1e-12 * domain_.sizes().maxCoeff();
    return std::any_of(part.begin(), part.end(), [&](std::uint32_t t) {
      return std::all_of(r_.triangles[t].begin(), r_.triangles[t].end(), [&](std::uint32_t v) { return std::abs(r_.vertices[v][axis] - side) <= near; });
    });
  }

  // Points of the part, its triangles' middles and those of their quarters, the largest triangles' first.
  bool witness(std::vector<std::uint32_t> part, const std::vector<std::uint32_t>& other, int axis, std::size_t end, double room) {
    const auto area = [&](std::uint32_t t) {
      const auto& [a, b, c] = r_.triangles[t];
      return (r_.vertices[b] - r_.vertices[a]).cross(r_.vertices[c] - r_.vertices[a]).squaredNorm();
    };
    std::stable_sort(part.begin(), part.end(), [&](std::uint32_t s, std::uint32_t t) { return area(s) > area(t); });
    constexpr int most_depth = 4;
    for (int depth = 0; depth <= most_depth; ++depth)
      for (const std::uint32_t t : part) {
        const int n = 1 << depth;
        const Vec3 &a = r_.vertices[r_.triangles[t][0]], &b = r_.vertices[r_.triangles[t][1]], &c = r_.vertices[r_.triangles[t][2]];
        for (int i = 0; i < n; ++i)
          for (int j = 0; i + j < n; ++j) {
            const Vec3 x = a + ((3 * i + 1) * (b - a) + (3 * j + 1) * (c - a)) / (3.0 * n);
            if (!has_room(x, axis, end, room)) continue;
            for (const std::uint32_t s : other)
              if (is_over(s, x, axis)) {
                shells_.join(t, s);
                return true;
              }
          }
      }
    return false;
  }

  // Free in a ball about it, as far as that is in the domain, and so at the other end.
  bool has_room(Vec3 x, int axis, std::size_t end, double room) const {
    x[axis] = end == 0 ? domain_.min()[axis] : domain_.max()[axis];
    return !collision_ || side(*collision_, x, Vec3::Constant(room)) < 0;
  }

  bool is_over(std::uint32_t t, const Vec3& x, int axis) const {
    const auto& [a, b, c] = r_.triangles[t];
    const Vec2 p = project(x, axis), pa = project(r_.vertices[a], axis), pb = project(r_.vertices[b], axis), pc = project(r_.vertices[c], axis);
    const int s = turn(pa, pb, p);
    return s != 0 && turn(pb, pc, p) == s && turn(pc, pa, p) == s;
  }

  const Result& r_;
  const std::optional<Expression>& collision_;
  const Box3& domain_;
  const std::vector<Triangle> neighbours_;
  DisjointSets shells_;
};

}  // namespace

std::optional<std::size_t> wrapped_components(const Result& result, const std::optional<Expression>& collision, const Box3& domain,
                                              const std::array<bool, 3>& goes_round) {
  if (result.triangles.empty()) return result.certificate.unresolved.empty() ? std::optional<std::size_t>(0) : std::nullopt;
  return Wrapping(result, collision, domain).count(goes_round);
}

}  // namespace starcell
