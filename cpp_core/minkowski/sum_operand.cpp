#include "minkowski/sum_operand.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/predicates.h"

namespace starcell {
namespace {

constexpr double pi = 3.141592653589793;
// Normals are known to rounding; caps are wider by this, and a slope up to this counts as level.
constexpr double cap_slack = 1e-7;
constexpr double level_slack = 1e-11;
// Sine of the angle between two edges below which the normal of both is not known to cap_slack.
constexpr double nearly_parallel = 1e-8;
// All pairs of more edges than this are too many to look for a vertex's extreme normals.
constexpr std::size_t most_links = 32;

NormalCap cap_around(const std::vector<Vec3>& normals) {
  NormalCap cap;
  Vec3 sum = Vec3::Zero();
  for (const Vec3& n : normals) sum += n;
  if (!(sum.norm() > 1e-9)) {
    cap.angle = pi;
    return cap;
  }
  cap.axis = sum.normalized();
  for (const Vec3& n : normals) cap.angle = std::max(cap.angle, angle_between(cap.axis, n));
  // A spherically convex set reaches no farther from the axis than its extreme points only within a hemisphere.
  cap.angle = cap.angle + cap_slack < 0.5 * pi ? cap.angle + cap_slack : pi;
  return cap;
}

}  // namespace

double angle_between(const Vec3& u, const Vec3& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

SumOperand::SumOperand(PolyhedronPtr solid, const Placement& placement) : inside_out_(placement.inside_out), points_(solid->vertices()), facets_(solid->triangles()), neighbours_(solid->neighbours()) {
  if (placement.reflected)
    for (Vec3& p : points_) p = -p;
  // A reflection in a point turns a mesh inside out, as a complement does.
  if (placement.reflected != placement.inside_out)
    for (std::size_t t = 0; t < facets_.size(); ++t) {
      std::swap(facets_[t][1], facets_[t][2]);
      std::swap(neighbours_[t][0], neighbours_[t][2]);
    }
  for (const Vec3& p : points_) box_.extend(p);
  for (std::uint32_t t = 0; t < facets_.size(); ++t) {
    const Vec3 u = points_[facets_[t][1]] - points_[facets_[t][0]], v = points_[facets_[t][2]] - points_[facets_[t][0]], n = u.cross(v);
    const double sine = n.norm() / (u.norm() * v.norm());
    if (sine > nearly_parallel) faces_.push_back({t, {n.normalized(), cap_slack}, 4e-16 / sine});
    else faces_.push_back({t, {Vec3::UnitZ(), pi}, 2});   // a needle's normal is not known
  }
  find_edges();
  find_vertices();
}

bool SumOperand::may_face(std::uint32_t facet, const Vec3& n) const {
  const NormalCap& normals = faces_[facet].normals;
  return normals.angle > 1 || n.dot(normals.axis) > -cap_slack;
}

void SumOperand::find_edges() {
  for (std::uint32_t t = 0; t < facets_.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t g = neighbours_[t][k];
      if (g < t) continue;
      const std::uint32_t u = facets_[t][k], v = facets_[t][(k + 1) % 3];
      std::uint32_t apex = facets_[g][0];
      for (const std::uint32_t c : facets_[g])
        if (c != u && c != v) apex = c;
      // Convex if the other face falls away below this one's plane.
      if (side(points_[facets_[t][0]], points_[facets_[t][1]], points_[facets_[t][2]], points_[apex]) >= 0) continue;
      const NormalCap &m = faces_[t].normals, &n = faces_[g].normals;
      const bool known = m.angle < 1 && n.angle < 1;
      edges_.push_back({u, v, facets_[t][(k + 2) % 3], apex, {t, g}, known ? cap_around({m.axis, n.axis}) : NormalCap{Vec3::UnitZ(), pi}});
    }
}

void SumOperand::find_vertices() {
  struct Side {
    Link link;
    int bend;   // below 0: a convex edge
  };
  std::vector<std::vector<Side>> around(points_.size());
  for (std::uint32_t t = 0; t < facets_.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t u = facets_[t][k], v = facets_[t][(k + 1) % 3], g = neighbours_[t][k];
      std::uint32_t apex = facets_[g][0];
      for (const std::uint32_t c : facets_[g])
        if (c != u && c != v) apex = c;
      around[u].push_back({{v, t}, side(points_[facets_[t][0]], points_[facets_[t][1]], points_[facets_[t][2]], points_[apex])});
    }
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    // Where every edge lies below a plane, the operand is either the narrow side of its surface or the wide one. The outermost edges
    // are convex in the first case, reflex in the second, and then the vertex has no normals.
    if (std::none_of(around[v].begin(), around[v].end(), [](const Side& s) { return s.bend < 0; })) continue;
    std::vector<Vec3> out;
    for (const Side& s : around[v]) out.push_back((points_[s.link.vertex] - points_[v]).normalized());
    NormalCap cap;
    if (out.size() > most_links) {
      // n . d <= 0 for all edges d: no farther than a right angle from their mean, turned round.
      Vec3 mean = Vec3::Zero();
      for (const Vec3& d : out) mean -= d;
      cap = mean.norm() > 1e-9 ? NormalCap{mean.normalized(), 0.5 * pi + cap_slack} : NormalCap{Vec3::UnitZ(), pi};
    } else {
      std::vector<Vec3> extreme;
      bool narrow = false, needle = false;
      for (std::size_t i = 0; i < out.size(); ++i)
        for (std::size_t j = i + 1; j < out.size(); ++j) {
          const Vec3 cross = out[i].cross(out[j]);
          const double length = cross.norm();
          if (length <= nearly_parallel && out[i].dot(out[j]) > 0) {   // their normals are noise: any is possible
            needle = true;
            continue;
          }
          if (!(length > 1e-12)) continue;   // one goes on straight where the other ends
          const double slack = level_slack + 1e-15 / length;
          for (const double sense : {1.0, -1.0}) {
            const Vec3 n = sense / length * cross;
            if (!std::all_of(out.begin(), out.end(), [&](const Vec3& d) { return n.dot(d) <= slack; })) continue;
            if (std::none_of(around[v].begin(), around[v].end(), [&](const Side& s) { return may_face(s.link.facet, n); })) continue;
            extreme.push_back(n);
            narrow = narrow || around[v][i].bend < 0 || around[v][j].bend < 0;
          }
        }
      if (!narrow && !needle) continue;
      cap = needle ? NormalCap{Vec3::UnitZ(), pi} : cap_around(extreme);
    }
    const auto first = static_cast<std::uint32_t>(links_.size());
    for (const Side& s : around[v]) links_.push_back(s.link);
    vertices_.push_back({v, first, static_cast<std::uint32_t>(links_.size()), cap});
  }
}

bool SumOperand::supports(const Vertex& v, const Vec3& n, double slack) const {
  for (std::uint32_t k = v.first; k < v.last; ++k) {
    const Vec3 d = points_[links_[k].vertex] - points_[v.vertex];
    if (n.dot(d) > (level_slack + slack) * d.norm()) return false;
  }
  return std::any_of(links_.begin() + v.first, links_.begin() + v.last, [&](const Link& link) { return may_face(link.facet, n); });
}

bool SumOperand::supports(const Edge& e, const Vec3& n, double slack) const {
  for (const std::uint32_t apex : {e.left, e.right}) {
    const Vec3 d = points_[apex] - points_[e.from];
    if (n.dot(d) > (level_slack + slack) * d.norm()) return false;
  }
  return may_face(e.facets[0], n) || may_face(e.facets[1], n);
}

}  // namespace starcell
