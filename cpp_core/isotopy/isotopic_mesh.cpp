#include "isotopy/isotopic_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "contouring/embedding.h"
#include "isotopy/star_map.h"
#include "numerics/predicates.h"
#include "solids/connectivity.h"
#include "solids/triangle_pair.h"
#include "solids/upward_ray.h"

namespace starcell {
namespace {

// Of the coordinates: what is lost in measuring.
constexpr double rounding = 1e-14;
// Twice what a coordinate's last digit in float32 is, at most.
constexpr double float_step = 2.4e-7;
// Of the error: how far from a triangle's sides one need not look.
constexpr double seam_share = 0.05;

Box3 box_of(const Corners& t) { return Box3(t[0]).extend(t[1]).extend(t[2]); }

bool has(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

// Changes may cut triangles in many pieces: the grid has levels for those, too.
double finest_cell(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  constexpr double to_a_mean_edge = 1.0 / 128;
  double sum = 0;
  for (const Triangle& t : triangles) sum += (points[t[1]] - points[t[0]]).norm();
  return triangles.empty() || !(sum > 0) ? 1.0 : to_a_mean_edge * sum / static_cast<double>(triangles.size());
}

// Disc and fan close to a sphere: a point in it has been passed over. (Seen from above: is it so many triangles of one below as of the other?)
bool is_between(const Vec3& x, const std::vector<Corners>& old, const std::vector<Corners>& fresh) {
  int above = 0;
  for (const auto* disc : {&old, &fresh})
    for (const Corners& t : *disc)
      if (is_above(t[0], t[1], t[2], x)) above += (disc == &old ? 1 : -1) * turn(project(t[0], 2), project(t[1], 2), project(t[2], 2));
  return above != 0;
}

void sort_once(std::vector<std::uint32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

IsotopicMesh::IsotopicMesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles, bool in_float32)
    : points_(std::move(vertices)), triangles_(std::move(triangles)), about_(points_.size()), left_(triangles_.size()), grid_(finest_cell(points_, triangles_)), in_float32_(in_float32) {
  double largest = 0;
  for (const Vec3& p : points_) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  slack_ = rounding * largest;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (const std::uint32_t v : triangles_[t]) about_[v].push_back(t);
    grid_.add(t, box_of(corners(t)));
  }
  begin_anew();
}

void IsotopicMesh::begin_anew() {
  first_points_ = points_;
  first_.clear();
  relies_on_.clear();
  dependents_.assign(slots(), {});
  for (std::uint32_t t = 0; t < slots(); ++t) {
    if (!has(t)) continue;
    dependents_[t] = {static_cast<std::uint32_t>(first_.size())};
    first_.push_back(triangles_[t]);
    relies_on_.push_back({t});
  }
  across_first_ = connect(first_points_, first_).neighbours;
  far_.assign(slots(), 0.0);
  first_far_.assign(first_.size(), 0.0);
  seen_.assign(slots(), 0);
  first_seen_.assign(first_.size(), 0);
  stamp_ = 0;
}

std::vector<std::uint32_t> IsotopicMesh::neighbours(std::uint32_t v) const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : about_[v])
    for (const std::uint32_t w : triangles_[t])
      if (w != v) found.push_back(w);
  sort_once(found);
  return found;
}

std::uint32_t IsotopicMesh::across(std::uint32_t t, int k) const {
  const std::uint32_t u = triangles_[t][k], v = triangles_[t][(k + 1) % 3];
  for (const std::uint32_t other : about_[u])
    if (other != t && starcell::has(triangles_[other], v)) return other;
  return t;
}

// What both ends are joined to are the two corners opposite the edge, and no edge between these.
bool IsotopicMesh::may_collapse(std::uint32_t a, std::uint32_t b) const {
  const std::vector<std::uint32_t> of_a = neighbours(a), of_b = neighbours(b);
  std::vector<std::uint32_t> common;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
  if (common.size() != 2) return false;
  return about_[common[0]].size() > 3 && about_[common[1]].size() > 3;
}

bool IsotopicMesh::replace(const std::vector<std::uint32_t>& disc, const Fan& fan, double most) {
  const bool born = fan.apex == points_.size();
  const auto at = [&](std::uint32_t v) -> const Vec3& { return v == fan.apex ? fan.place : points_[v]; };
  std::vector<Corners> old, fresh;
  for (const std::uint32_t t : disc) old.push_back(corners(t));
  for (const auto& [u, v] : fan.rim) fresh.push_back({fan.place, at(u), at(v)});
  if (!is_graph_over(old, fresh)) return false;

  Undo undo;
  if (born) points_.push_back(fan.place), about_.emplace_back();
  undo.place = points_[fan.apex];
  std::vector<std::uint32_t> touched{fan.apex};
  for (const std::uint32_t t : disc) {
    undo.triangles.push_back(triangles_[t]);
    touched.insert(touched.end(), triangles_[t].begin(), triangles_[t].end());
  }
  sort_once(touched);
  for (const std::uint32_t v : touched) undo.about.emplace_back(v, about_[v]);
  const std::size_t slots_before = triangles_.size();
  for (const std::uint32_t t : disc)
    for (const std::uint32_t v : triangles_[t]) std::erase(about_[v], t);
  std::vector<std::uint32_t> fan_triangles;
  for (std::size_t i = 0; i < fan.rim.size(); ++i) {
    if (i >= disc.size()) {
      triangles_.emplace_back();
      seen_.push_back(0);
      dependents_.emplace_back();
      far_.push_back(0);
    }
    fan_triangles.push_back(i < disc.size() ? disc[i] : static_cast<std::uint32_t>(triangles_.size() - 1));
    triangles_[fan_triangles.back()] = {fan.apex, fan.rim[i][0], fan.rim[i][1]};
    for (const std::uint32_t v : triangles_[fan_triangles.back()]) about_[v].push_back(fan_triangles.back());
  }
  points_[fan.apex] = fan.place;

  Proof proof;
  proof.dependents = dependents_of(disc);
  if (stays_near(disc, fan_triangles, most, proof) && !meets_others(disc, fan_triangles, old, fresh)) {
    keep(disc, fan_triangles, old, proof);
    return true;
  }
  for (std::size_t i = 0; i < disc.size(); ++i) triangles_[disc[i]] = undo.triangles[i];
  triangles_.resize(slots_before);
  seen_.resize(slots_before);
  dependents_.resize(slots_before);
  far_.resize(slots_before);
  points_[fan.apex] = undo.place;
  for (auto& [v, about] : undo.about) about_[v] = std::move(about);
  if (born) points_.pop_back(), about_.pop_back();
  return false;
}

std::vector<std::uint32_t> IsotopicMesh::dependents_of(const std::vector<std::uint32_t>& disc) const {
  std::vector<std::uint32_t> dependents;
  for (const std::uint32_t t : disc) dependents.insert(dependents.end(), dependents_[t].begin(), dependents_[t].end());
  sort_once(dependents);
  return dependents;
}

// Both ways: every triangle of the fan has the first mesh near it; every triangle of the first mesh that had the disc near it has this one.
bool IsotopicMesh::stays_near(const std::vector<std::uint32_t>& disc, const std::vector<std::uint32_t>& fan, double most, Proof& proof) {
  const auto corners_of_first = [&](std::uint32_t t) { return ++work_, first_corners(t); };
  const auto across_first = [&](std::uint32_t t, int k) { return across_first_[t][k]; };
  const double give = seam_share * most;
  // What is far off shows in the middle of an edge already: most changes that fail do.
  for (const std::uint32_t t : fan) {
    const Corners c = corners(t);
    const Vec3 middle = 0.5 * (c[0] + c[1]);
    if (std::none_of(proof.dependents.begin(), proof.dependents.end(), [&](std::uint32_t s) { return distance_to_triangle(middle, first_corners(s)) <= most; })) return false;
  }
  std::vector<std::uint32_t> used;
  for (const std::uint32_t t : fan) {
    proof.far.push_back(cover_by_parts(corners(t), proof.dependents, corners_of_first, across_first, most, slack_, give, used, first_seen_, stamp_));
    if (!(proof.far.back() <= most && std::isfinite(proof.far.back()))) return false;
  }
  const auto corners_of_this = [&](std::uint32_t t) { return ++work_, corners(t); };
  const auto across_this = [&](std::uint32_t t, int k) { return work_ += about_[triangles_[t][k]].size() / 8, across(t, k); };   // looks at all about the corner
  for (const std::uint32_t t : proof.dependents) {
    proof.relies_on.emplace_back();
    std::vector<std::uint32_t> near = fan;   // and what else the triangle is near to
    for (const std::uint32_t s : relies_on_[t])
      if (!std::count(disc.begin(), disc.end(), s)) near.push_back(s);
    proof.first_far.push_back(cover_by_parts(first_corners(t), near, corners_of_this, across_this, most, slack_, give, proof.relies_on.back(), seen_, stamp_));
    if (!(proof.first_far.back() <= most && std::isfinite(proof.first_far.back()))) return false;
  }
  return true;
}

// Does the fan meet another triangle, or has it passed over one?
bool IsotopicMesh::meets_others(const std::vector<std::uint32_t>& disc, const std::vector<std::uint32_t>& fan, const std::vector<Corners>& old,
                                const std::vector<Corners>& fresh) const {
  Box3 all;
  for (const Corners& t : old) all.extend(box_of(t));
  for (const Corners& t : fresh) all.extend(box_of(t));
  const double step = in_float32_ ? float_step * std::max(all.min().cwiseAbs().maxCoeff(), all.max().cwiseAbs().maxCoeff()) : 0;   // rounding brings together what is this near
  std::vector<std::uint32_t> others = grid_.near(Box3(all.min() - Vec3::Constant(step), all.max() + Vec3::Constant(step)));
  std::erase_if(others, [&](std::uint32_t t) { return std::count(disc.begin(), disc.end(), t) > 0; });
  for (const std::uint32_t t : fan) {
    const Box3 tight = box_of(corners(t)), box(tight.min() - Vec3::Constant(step), tight.max() + Vec3::Constant(step));
    for (const std::uint32_t other : others)
      if (box.intersects(box_of(corners(other))) &&
          (meet_outside_shared(points_, triangles_[t], triangles_[other]) || (in_float32_ && meets_once_rounded(points_, triangles_[t], triangles_[other]))))
        return true;
    for (const std::uint32_t other : fan)
      if (in_float32_ && other < t && meets_once_rounded(points_, triangles_[t], triangles_[other])) return true;
  }
  // What lies between the two and meets neither lies there as a whole, but for corners on the rim.
  const auto on_rim = [&](std::uint32_t v) { return std::any_of(fan.begin(), fan.end(), [&](std::uint32_t t) { return starcell::has(triangles_[t], v); }); };
  for (const std::uint32_t other : others) {
    const Corners t = corners(other);
    const auto inner = std::find_if_not(triangles_[other].begin(), triangles_[other].end(), on_rim);
    const Vec3 x = inner == triangles_[other].end() ? Vec3((t[0] + t[1] + t[2]) / 3) : points_[*inner];
    if (all.contains(x) && is_between(x, old, fresh)) return true;
  }
  return false;
}

void IsotopicMesh::keep(const std::vector<std::uint32_t>& disc, const std::vector<std::uint32_t>& fan, const std::vector<Corners>& old, Proof& proof) {
  for (std::size_t i = 0; i < disc.size(); ++i) grid_.remove(disc[i], box_of(old[i]));
  for (std::size_t i = 0; i < proof.dependents.size(); ++i) {
    const std::uint32_t t = proof.dependents[i];
    for (const std::uint32_t s : relies_on_[t]) std::erase(dependents_[s], t);
    relies_on_[t] = std::move(proof.relies_on[i]);
    for (const std::uint32_t s : relies_on_[t]) dependents_[s].push_back(t);
    first_far_[t] = proof.first_far[i];
  }
  for (std::size_t i = 0; i < fan.size(); ++i) {
    grid_.add(fan[i], box_of(corners(fan[i])));
    far_[fan[i]] = proof.far[i];
  }
  for (std::size_t i = fan.size(); i < disc.size(); ++i) triangles_[disc[i]] = {none, none, none};
  left_ = left_ + fan.size() - disc.size();
}

Vec3 IsotopicMesh::on_first(const Vec3& x, const std::vector<std::uint32_t>& triangles) const {
  Vec3 nearest = x;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : dependents_of(triangles)) {
    const Vec3 p = nearest_on_triangle(x, first_corners(t));
    if ((p - x).squaredNorm() < least) least = (p - x).squaredNorm(), nearest = p;
  }
  return nearest;
}

double IsotopicMesh::bound() const {
  double bound = 0;
  for (const double far : first_far_) bound = std::max(bound, far);
  for (std::uint32_t t = 0; t < slots(); ++t)
    if (has(t)) bound = std::max(bound, far_[t]);
  return bound;
}

void IsotopicMesh::compact(std::vector<Vec3>& vertices, std::vector<Triangle>& triangles, std::vector<std::uint32_t>& numbers) const {
  vertices.clear();
  triangles.clear();
  numbers.assign(points_.size(), none);
  for (std::uint32_t t = 0; t < slots(); ++t) {
    if (!has(t)) continue;
    Triangle corners;
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& n = numbers[triangles_[t][k]];
      if (n == none) {
        n = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(points_[triangles_[t][k]]);
      }
      corners[k] = n;
    }
    triangles.push_back(corners);
  }
}

}  // namespace starcell
