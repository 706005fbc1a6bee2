#include "configuration_space/wrapped_components.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <set>

#include "solids/connectivity.h"
#include "solids/disjoint_sets.h"

namespace starcell {
namespace {

// Of the error: room beyond it that a witness has.
constexpr double more_room = 1.01;
// Of the room: how far off the domain's sides a place is looked for in the mesh.
constexpr double off_sides = 0.005;
// The least room that a witness has is this many halves of it.
constexpr int most_halvings = 7;
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
      : r_(r), collision_(collision), domain_(domain), neighbours_(connect(r.vertices, r.triangles).neighbours), surfaces_(r.triangles.size()), shells_(r.triangles.size()) {
    for (std::uint32_t t = 0; t < r.triangles.size(); ++t)
      for (const std::uint32_t n : neighbours_[t])
        if (n != kNoTriangle) surfaces_.join(t, n), shells_.join(t, n);
  }

  std::optional<std::size_t> count(const std::array<bool, 3>& goes_round) {
    const double room = r_.certificate.error_bound * more_room;
    if (!std::isfinite(room)) return std::nullopt;
    for (std::uint32_t t = 0; t < r_.triangles.size(); ++t) {
      const auto& [a, b, c] = r_.triangles[t];
      const Vec3 o = domain_.center();
      volumes_[surfaces_.root(t)] += (r_.vertices[a] - o).dot((r_.vertices[b] - o).cross(r_.vertices[c] - o));
    }
    std::vector<std::uint32_t> outer;   // the others bound holes of these
    for (const auto& [root, volume] : volumes_)
      if (volume > 0) outer.push_back(root);
    if (outer.size() == 1) return 1;
    for (int axis = 0; axis < 3; ++axis)
      if (goes_round[static_cast<std::size_t>(axis)]) add_parts(axis);
    for (Part& part : parts_) witness(part, room);
    join_by_place(room);
    const auto without = joints_of_chips();
    if (!without) return std::nullopt;
    std::set<std::uint32_t> roots;
    for (const std::uint32_t root : outer) roots.insert(shells_.root(root));
    return roots.size() - *without;
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

  /// A connected part of the mesh's cut at an end of an axis.
  struct Part {
    int axis;
    std::size_t end;
    std::vector<std::uint32_t> triangles;
    std::uint32_t surface;
    bool witnessed = false;
  };

  void add_parts(int axis) {
    const std::array<std::vector<std::uint32_t>, 2> caps{cap(axis, domain_.min()[axis]), cap(axis, domain_.max()[axis])};
    for (const std::size_t end : {0, 1}) {
      DisjointSets parts(r_.vertices.size());   // joined in points: beside a crease single triangles may lean
      for (const std::uint32_t t : caps[end])
        for (const std::uint32_t v : r_.triangles[t]) parts.join(r_.triangles[t][0], v);
      std::map<std::uint32_t, std::vector<std::uint32_t>> triangles;
      for (const std::uint32_t t : caps[end]) triangles[parts.root(r_.triangles[t][0])].push_back(t);
      for (auto& [root, part] : triangles)
        if (is_on_side(part, axis, end)) {
          const std::uint32_t surface = surfaces_.root(part.front());
          parts_.push_back({axis, end, std::move(part), surface});
        }
    }
  }

  // Of parts without a witness: one at either end that come near each other, and neither near one of another surface, are the same part of the cut, from which neither is
  // farther than the mesh is off.
  void join_by_place(double room) {
    const auto near = [&](const Part& p, const Part& q) {
      Box3 one, other;
      for (const auto& [part, box] : {std::pair{&p, &one}, {&q, &other}})
        for (const std::uint32_t t : part->triangles)
          for (const std::uint32_t v : r_.triangles[t]) box->extend(r_.vertices[v]);
      for (Box3* box : {&one, &other}) box->min()[p.axis] = box->max()[p.axis] = 0;
      return one.exteriorDistance(other) <= 2 * room;
    };
    std::vector<std::vector<std::size_t>> partners(parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t j = 0; j < parts_.size(); ++j)
        if (!parts_[i].witnessed && !parts_[j].witnessed && parts_[i].axis == parts_[j].axis && parts_[i].end != parts_[j].end && near(parts_[i], parts_[j])) partners[i].push_back(j);
    const auto all_on = [&](const std::vector<std::size_t>& some, std::uint32_t surface) {
      return !some.empty() && std::all_of(some.begin(), some.end(), [&](std::size_t k) { return parts_[k].surface == surface; });
    };
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (partners[i].empty()) continue;
      const std::uint32_t other = parts_[partners[i].front()].surface;
      if (!all_on(partners[i], other) || !std::all_of(partners[i].begin(), partners[i].end(), [&](std::size_t k) { return all_on(partners[k], parts_[i].surface); })) continue;
      shells_.join(parts_[i].surface, other);
      parts_[i].witnessed = true;   // and its partners in their turn
    }
  }

  // Both ends' parts are those of one cut: a witness from either end serves. A chip is what the cut has left of a component where there is no room: it meets the cuts in
  // one part only. At such a part it goes on as one other surface, whichever that is: one less to count. So the parts without a witness need not be told apart if there are as
  // many at either end, and all of them at one end are chips'.
  std::optional<std::size_t> joints_of_chips() {
    std::map<std::uint32_t, int> count, of_shell;
    for (const Part& part : parts_) ++count[part.surface];
    for (const auto& [surface, parts] : count) ++of_shell[shells_.root(surface)];
    std::size_t joints = 0;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<std::size_t, 2> all{}, others{};
      for (const Part& part : parts_) {
        if (part.axis != axis || part.witnessed) continue;
        const bool chip = count[part.surface] == 1;
        if (chip && of_shell[shells_.root(part.surface)] > 1) continue;   // told from the other end
        ++all[part.end];
        others[part.end] += !chip;
      }
      if (all[0] == 0 || all[1] == 0) continue;
      if (all[0] != all[1] || (others[0] > 0 && others[1] > 0)) return std::nullopt;
      joints += all[0];
    }
    return joints;
  }

  // Is any triangle on the side to rounding? Else it is a contact surface that comes that near to it.
  bool is_on_side(const std::vector<std::uint32_t>& part, int axis, std::size_t end) const {
    const double side = end == 0 ? domain_.min()[axis] : domain_.max()[axis], near = 1e-12 * domain_.sizes().maxCoeff();
    return std::any_of(part.begin(), part.end(), [&](std::uint32_t t) {
      return std::all_of(r_.triangles[t].begin(), r_.triangles[t].end(), [&](std::uint32_t v) { return std::abs(r_.vertices[v][axis] - side) <= near; });
    });
  }

  // Points of the part, its triangles' middles and those of their quarters, the largest triangles' first: one that is free at both ends, and from which there is a
  // free way, at either end, to where there is room.
  void witness(Part& part, double room) {
    const int axis = part.axis;
    if (volumes_[part.surface] < 6 * 0.5 * room * room * room) return;   // a cube of twice the room, of which an eighth may be in the domain, does not fit
    const auto area = [&](std::uint32_t t) {
      const auto& [a, b, c] = r_.triangles[t];
      return (r_.vertices[b] - r_.vertices[a]).cross(r_.vertices[c] - r_.vertices[a]).squaredNorm();
    };
    std::stable_sort(part.triangles.begin(), part.triangles.end(), [&](std::uint32_t s, std::uint32_t t) { return area(s) > area(t); });
    constexpr int most_depth = 4, most_climbs = 4;
    int climbs = 0;
    for (int depth = 0; depth <= most_depth; ++depth)
      for (const std::uint32_t t : part.triangles) {
        const int n = 1 << depth;
        const Vec3 &a = r_.vertices[r_.triangles[t][0]], &b = r_.vertices[r_.triangles[t][1]], &c = r_.vertices[r_.triangles[t][2]];
        for (int i = 0; i < n; ++i)
          for (int j = 0; i + j < n; ++j) {
            Vec3 low = a + ((3 * i + 1) * (b - a) + (3 * j + 1) * (c - a)) / (3.0 * n), high = low;
            low[axis] = domain_.min()[axis];
            high[axis] = domain_.max()[axis];
            if (free_about(low, room, 0) == 0 || free_about(high, room, 0) == 0) continue;
            if (++climbs > most_climbs) return;
            const auto one = shell_from(low, room), other = shell_from(high, room);
            if (one && other) {
              shells_.join(*one, *other);
              part.witnessed = true;
              return;
            }
          }
      }
  }

  // Half of the side of a cube about the point in which all is free, as far as it is in the domain: the largest of `room` times 2^-k, k from `first` on; 0: none.
  double free_about(const Vec3& x, double room, int first) const {
    for (int k = first; k <= most_halvings; ++k)
      if (const double r = std::ldexp(room, -k); is_free(x, r) || (k == 0 && in_eighths(x, r))) return r;
    return 0;
  }

  bool is_free(const Vec3& x, double half) const { return !collision_ || side(*collision_, x, Vec3::Constant(half)) < 0; }

  // Where the error is large, angles vary so much in a cube that little is told of it as a whole.
  bool in_eighths(const Vec3& x, double half) const {
    for (int part = 0; part < 8; ++part)
      if (!is_free(x + 0.5 * half * Vec3(part & 1 ? 1 : -1, part & 2 ? 1 : -1, part & 4 ? 1 : -1), 0.5 * half * (1 + 1e-12))) return false;
    return true;
  }

  // The shell about what is free from here on, told where there is room. Climbs to the freest of the places that are known: each lies in a free cube about another.
  std::optional<std::uint32_t> shell_from(const Vec3& from, double room) {
    constexpr std::size_t most_places = 300;
    struct Place {
      double free;
      Vec3 at;
      bool operator<(const Place& o) const { return free < o.free; }
    };
    std::priority_queue<Place> open;
    std::set<std::array<long long, 3>> seen;
    const double grain = std::ldexp(room, -most_halvings);
    const auto add = [&](const Vec3& x, double about) {
      const int first = about > 0 ? std::max(0, static_cast<int>(std::lround(std::log2(room / about))) - 1) : 0;
      std::array<long long, 3> cell;
      for (std::size_t k = 0; k < 3; ++k) cell[k] = std::llround((x[static_cast<int>(k)] - domain_.min()[static_cast<int>(k)]) / std::max(0.5 * about, grain));
      if (!seen.insert(cell).second) return;
      if (const double free = free_about(x, room, first); free > 0) open.push({free, x});
    };
    add(from, 0);
    for (std::size_t n = 0; n < most_places && !open.empty(); ++n) {
      const Place place = open.top();
      open.pop();
      if (place.free >= room) {
        const Vec3 off = Vec3::Constant(off_sides * room);
        return shell_about(place.at.cwiseMax(domain_.min() + off).cwiseMin(domain_.max() - off));
      }
      for (int way = 0; way < 27; ++way) {
        const Vec3 step(way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1);
        if (way != 13) add((place.at + place.free * step).cwiseMax(domain_.min()).cwiseMin(domain_.max()), place.free);
      }
    }
    return std::nullopt;
  }

  // Of the outer shells about a point the smallest: by solid angles, as it is on none.
  std::optional<std::uint32_t> shell_about(const Vec3& x) {
    std::map<std::uint32_t, double> turns;
    for (std::uint32_t t = 0; t < r_.triangles.size(); ++t) {
      const Vec3 a = r_.vertices[r_.triangles[t][0]] - x, b = r_.vertices[r_.triangles[t][1]] - x, c = r_.vertices[r_.triangles[t][2]] - x;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      turns[surfaces_.root(t)] += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb) / (2 * M_PI);
    }
    std::optional<std::uint32_t> best;
    for (const auto& [root, turn] : turns)
      if (turn > 0.5 && volumes_.at(root) > 0 && (!best || volumes_.at(root) < volumes_.at(*best))) best = root;
    return best;
  }

  const Result& r_;
  const std::optional<Expression>& collision_;
  const Box3& domain_;
  const std::vector<Triangle> neighbours_;
  DisjointSets surfaces_, shells_;             // connected in the mesh; and, of these, outer ones of one component
  std::map<std::uint32_t, double> volumes_;    // six times, by surface
  std::vector<Part> parts_;
};

}  // namespace

std::optional<std::size_t> wrapped_components(const Result& result, const std::optional<Expression>& collision, const Box3& domain,
                                              const std::array<bool, 3>& goes_round) {
  if (result.certificate.verdict == Verdict::unresolved) return std::nullopt;
  if (result.triangles.empty()) return 0;
  return Wrapping(result, collision, domain).count(goes_round);
}

}  // namespace starcell
