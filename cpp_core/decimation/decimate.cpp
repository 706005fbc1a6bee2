#include "decimation/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>

#include <Eigen/Geometry>

#include "decimation/quadric_error.h"
#include "decimation/star_map.h"
#include "decimation/triangle_cover.h"
#include "decimation/triangle_grid.h"
#include "numerics/predicates.h"
#include "solids/connectivity.h"
#include "solids/triangle_pair.h"
#include "solids/upward_ray.h"

namespace starcell {
namespace {

constexpr std::uint32_t none = UINT32_MAX;
// Where planes leave it open, short edges go first: an edge counts as if its square were off by this part of the error.
constexpr double length_weight = 1e-5;
// Area by longest side squared: below this a triangle may only take the place of one no better.
constexpr double thin = 0.03, thin_on_the_way = 5e-4;   // flat sides lose their thin ones again
// More triangles about a vertex are only made of as many.
constexpr std::size_t most_about = 16;
// A pass that takes less than this part of the triangles away is the last.
constexpr double worth_another = 0.02;
constexpr int most_passes = 4;
// How often a direction is turned towards what it faces least.
constexpr int turns = 8;
// What takes less than this part of the error comes first: flat sides are emptied before corners are cut.
constexpr double free_share = 1e-3;
constexpr std::size_t look_up_every = 32;
// Of the coordinates: what is lost in measuring.
constexpr double rounding = 1e-14;
// Of the error: how far from a triangle's sides one need not look.
constexpr double seam_share = 0.05;
// The cosine of a fold, and what puts its edges before all others.
constexpr double fold = -0.7;
constexpr double before_all = 1e100;

double shape_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0;
}

// A direction that no triangle is turned away from, if there is one: large triangles have no more say in it than small ones.
Vec3 facing_all(const std::vector<Corners>& triangles) {
  std::vector<Vec3> normals;
  Vec3 sum = Vec3::Zero();
  for (const Corners& t : triangles) {
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    if (n.norm() > 0) normals.push_back(n.normalized()), sum += normals.back();
  }
  for (int step = 0; step < turns && !normals.empty(); ++step) {   // towards the one it faces least
    const auto least = std::min_element(normals.begin(), normals.end(), [&](const Vec3& m, const Vec3& n) { return m.dot(sum) < n.dot(sum); });
    sum = sum.normalized() + 0.25 * *least;
  }
  return sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(Vec3::UnitZ());
}

class Decimation {
 public:
  Decimation(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool(double)>& go_on)
      : points_(std::move(vertices)), triangles_(std::move(triangles)), most_(most), go_on_(go_on), input_points_(points_),
        input_(triangles_), across_input_(connect(points_, triangles_).neighbours), relies_on_(input_.size()), dependents_(input_.size()),
        far_(input_.size(), 0.0), input_far_(input_.size(), 0.0), seen_(input_.size(), 0), input_seen_(input_.size(), 0), about_(points_.size()),
        quadrics_(points_.size()), version_(points_.size(), 0), grid_(cell_size()), left_(triangles_.size()) {
    Box3 box;
    for (const Vec3& p : points_) box.extend(p);
    if (!points_.empty()) {
      origin_ = box.center();
      slack_ = rounding * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
      unit_ = std::min(most, box.sizes().maxCoeff());
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const auto& [a, b, c] = triangles_[t];
      const QuadricError quadric(points_[a] - origin_, points_[b] - origin_, points_[c] - origin_);
      for (const std::uint32_t v : triangles_[t]) {
        about_[v].push_back(t);
        quadrics_[v] += quadric;
      }
      grid_.add(t, box_of(corners(t)));
      relies_on_[t] = {t};
      dependents_[t] = {t};
    }
  }

  Decimated run() {
    const double all = most_;
    for (const double share : {free_share, 1.0}) {
      most_ = share * all;
      thin_ = share < 1 ? thin_on_the_way : thin;
      for (int pass = 0; pass < most_passes; ++pass) {
        const std::size_t before = left_;
        if (!this->pass()) return result();
        if (static_cast<double>(before - left_) < worth_another * static_cast<double>(before)) break;
      }
    }
    return result();
  }

 private:
  struct Candidate {
    double cost;
    std::uint32_t a, b, version_a, version_b;
    bool operator<(const Candidate& other) const { return std::tie(cost, a, b) > std::tie(other.cost, other.a, other.b); }   // the least on top
  };

  double cell_size() const {
    double sum = 0;
    for (const Triangle& t : triangles_) sum += (points_[t[1]] - points_[t[0]]).norm();
    return triangles_.empty() || !(sum > 0) ? 1.0 : 2 * sum / static_cast<double>(triangles_.size());
  }

  Corners corners(std::uint32_t t) const { return {points_[triangles_[t][0]], points_[triangles_[t][1]], points_[triangles_[t][2]]}; }
  static Box3 box_of(const Corners& t) { return Box3(t[0]).extend(t[1]).extend(t[2]); }

  std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : about_[v])
      for (const std::uint32_t w : triangles_[t])
        if (w != v) found.push_back(w);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  Vec3 normal(std::uint32_t t) const {
    const auto& [a, b, c] = triangles_[t];
    return (points_[b] - points_[a]).cross(points_[c] - points_[a]).normalized();
  }

  // All but lying on a neighbour. Such folds should go while there is error left to spend on them.
  bool folded(std::uint32_t t) const {
    const Vec3 n = normal(t);
    for (const std::uint32_t v : triangles_[t])
      for (const std::uint32_t other : about_[v])
        if (n.dot(normal(other)) < fold) return true;
    return false;
  }

  void propose(std::uint32_t a, std::uint32_t b, bool first = false) {
    if (a > b) std::swap(a, b);
    QuadricError sum = quadrics_[a];
    sum += quadrics_[b];
    const Vec3 middle = 0.5 * (points_[a] + points_[b]);
    const Vec3 best = sum.least(middle - origin_);
    const double cost = std::min({sum.at(best), sum.at(points_[a] - origin_), sum.at(points_[b] - origin_)});
    if (!(cost <= most_ * most_ * sum.weight()) && !first) return;   // on average it is farther than allowed
    const double length = length_weight * length_weight * unit_ * unit_ * (points_[a] - points_[b]).squaredNorm();
    queue_.push({cost + length - (first ? before_all : 0), a, b, version_[a], version_[b]});
  }

  // False if it was called off.
  bool pass() {
    queue_ = {};
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (triangles_[t][0] == none) continue;
      const bool first = folded(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
        if (a < b || first) propose(a, b, first);
      }
    }
    for (std::size_t step = 1; !queue_.empty(); ++step) {
      if (step % look_up_every == 0 && go_on_ && !go_on_(1 - static_cast<double>(left_) / static_cast<double>(triangles_.size()))) return false;
      const Candidate c = queue_.top();
      queue_.pop();
      if (version_[c.a] != c.version_a || version_[c.b] != c.version_b || about_[c.a].empty() || about_[c.b].empty()) continue;
      if (!collapse(c.a, c.b)) continue;
      for (const std::uint32_t v : neighbours(c.a)) propose(c.a, v);
    }
    return true;
  }

  // The link condition: what both ends are joined to are the two corners opposite the edge, and no edge between these.
  bool keeps_topology(std::uint32_t a, std::uint32_t b) const {
    const std::vector<std::uint32_t> of_a = neighbours(a), of_b = neighbours(b);
    std::vector<std::uint32_t> common;
    std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
    if (common.size() != 2) return false;
    return about_[common[0]].size() > 3 && about_[common[1]].size() > 3;
  }

  bool collapse(std::uint32_t a, std::uint32_t b) {
    if (!keeps_topology(a, b)) return false;
    QuadricError sum = quadrics_[a];
    sum += quadrics_[b];
    const Vec3 middle = 0.5 * (points_[a] + points_[b]);
    const Vec3 best = sum.least(middle - origin_) + origin_;
    std::array<Vec3, 3> places{best, points_[a], points_[b]};
    if (sum.at(points_[b] - origin_) < sum.at(points_[a] - origin_)) std::swap(places[1], places[2]);
    for (const Vec3& place : places)
      if (collapse_to(a, b, place)) {
        quadrics_[a] = sum;
        ++version_[a];
        return true;
      }
    return false;
  }

  bool collapse_to(std::uint32_t a, std::uint32_t b, const Vec3& place) {
    // The star of the edge, and the fan that takes its place: the same triangles but those at the edge itself.
    Change change{a, b, points_[a], about_[a], {}, {}, {}, {}, {}};
    for (const std::uint32_t t : about_[b]) (std::count(change.star.begin(), change.star.end(), t) ? change.gone : change.star).push_back(t);
    std::vector<Corners> before, fan;
    Vec3 along = Vec3::Zero();
    double worst_before = 1, worst = 1;
    for (const std::uint32_t t : change.star) {
      before.push_back(corners(t));
      const Corners& p = before.back();
      along += (p[1] - p[0]).cross(p[2] - p[0]);
      worst_before = std::min(worst_before, shape_of(p[0], p[1], p[2]));
      if (std::count(change.gone.begin(), change.gone.end(), t)) continue;
      const auto k = static_cast<std::size_t>(std::find_if(triangles_[t].begin(), triangles_[t].end(), [&](std::uint32_t v) { return v == a || v == b; }) -
                                              triangles_[t].begin());
      fan.push_back({place, p[(k + 1) % 3], p[(k + 2) % 3]});
      worst = std::min(worst, shape_of(place, p[(k + 1) % 3], p[(k + 2) % 3]));
      change.kept.push_back(t);
      change.before.push_back(triangles_[t]);
    }
    if (change.kept.size() > std::max({most_about, about_[a].size(), about_[b].size()})) return false;
    if (!(along.norm() > 0) || (worst < thin_ && worst < 0.9 * worst_before)) return false;
    if (!is_graph_over(before, fan, along.normalized()) && !is_graph_over(before, fan, facing_all(fan))) return false;
    for (const std::uint32_t t : change.star) change.dependents.insert(change.dependents.end(), dependents_[t].begin(), dependents_[t].end());
    std::sort(change.dependents.begin(), change.dependents.end());
    change.dependents.erase(std::unique(change.dependents.begin(), change.dependents.end()), change.dependents.end());
    apply(change, place);
    Proof proof;
    if (!stays_near(change, proof) || meets_others(change.star, change.kept, before, fan)) {
      undo(change);
      return false;
    }
    keep(change, proof, before);
    return true;
  }

  // An edge's collapse, and what it takes to undo it.
  struct Change {
    std::uint32_t a, b;
    Vec3 old_place;
    std::vector<std::uint32_t> star, kept, gone, dependents;   // dependents: the input's triangles that the star is near to
    std::vector<Triangle> before;                              // of the kept ones
    std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> about;
  };

  // How near the fan's triangles are to the input, and the dependents to the mesh: to which of its triangles.
  struct Proof {
    std::vector<double> far, input_far;
    std::vector<std::vector<std::uint32_t>> relies_on;
  };

  void apply(Change& change, const Vec3& place) {
    const auto remember = [&](std::uint32_t v) { change.about.emplace_back(v, about_[v]); };
    remember(change.a);
    remember(change.b);
    for (const std::uint32_t t : change.gone)
      for (const std::uint32_t v : triangles_[t])
        if (v != change.a && v != change.b) {
          remember(v);
          std::erase(about_[v], t);
        }
    for (const std::uint32_t t : change.kept) std::replace(triangles_[t].begin(), triangles_[t].end(), change.b, change.a);
    points_[change.a] = place;
    about_[change.a] = change.kept;
    about_[change.b].clear();
  }

  void undo(Change& change) {
    points_[change.a] = change.old_place;
    for (std::size_t i = 0; i < change.kept.size(); ++i) triangles_[change.kept[i]] = change.before[i];
    for (std::size_t i = change.about.size(); i-- > 0;) about_[change.about[i].first] = std::move(change.about[i].second);
  }

  // Both ways: every triangle of the fan has the input near it; every triangle of the input that had the star near it has the mesh.
  bool stays_near(const Change& change, Proof& proof) {
    const auto input_corners = [&](std::uint32_t t) { return Corners{input_points_[input_[t][0]], input_points_[input_[t][1]], input_points_[input_[t][2]]}; };
    const auto across_input = [&](std::uint32_t t, int k) { return across_input_[t][k]; };
    const double give = seam_share * most_;
    std::vector<std::uint32_t> used;
    for (const std::uint32_t t : change.kept) {
      proof.far.push_back(cover_by_parts(corners(t), change.dependents, input_corners, across_input, most_, slack_, give, used, input_seen_, stamp_));
      if (!(proof.far.back() <= most_ && std::isfinite(proof.far.back()))) return false;
    }
    const auto corners_of = [&](std::uint32_t t) { return corners(t); };
    const auto across = [&](std::uint32_t t, int k) {
      const std::uint32_t u = triangles_[t][k], v = triangles_[t][(k + 1) % 3];
      for (const std::uint32_t other : about_[u])
        if (other != t && std::count(triangles_[other].begin(), triangles_[other].end(), v)) return other;
      return t;
    };
    for (const std::uint32_t t : change.dependents) {
      proof.relies_on.emplace_back();
      std::vector<std::uint32_t> about = change.kept;   // the fan, and what else the triangle is near to
      for (const std::uint32_t s : relies_on_[t])
        if (!std::count(change.star.begin(), change.star.end(), s)) about.push_back(s);
      proof.input_far.push_back(cover_by_parts(input_corners(t), about, corners_of, across, most_, slack_, give, proof.relies_on.back(), seen_, stamp_));
      if (!(proof.input_far.back() <= most_ && std::isfinite(proof.input_far.back()))) return false;
    }
    return true;
  }

  void keep(const Change& change, const Proof& proof, const std::vector<Corners>& before) {
    for (std::size_t i = 0; i < change.star.size(); ++i) grid_.remove(change.star[i], box_of(before[i]));
    for (std::size_t i = 0; i < change.dependents.size(); ++i) {
      const std::uint32_t t = change.dependents[i];
      for (const std::uint32_t s : relies_on_[t]) std::erase(dependents_[s], t);
      relies_on_[t] = proof.relies_on[i];
      for (const std::uint32_t s : relies_on_[t]) dependents_[s].push_back(t);
      input_far_[t] = proof.input_far[i];
    }
    for (std::size_t i = 0; i < change.kept.size(); ++i) {
      grid_.add(change.kept[i], box_of(corners(change.kept[i])));
      far_[change.kept[i]] = proof.far[i];
    }
    for (const std::uint32_t t : change.gone) triangles_[t] = {none, none, none};
    left_ -= change.gone.size();
  }

  // Does the fan meet another triangle, or has it passed over one?
  bool meets_others(const std::vector<std::uint32_t>& star, const std::vector<std::uint32_t>& fan, const std::vector<Corners>& old, const std::vector<Corners>& fresh) {
    Box3 all;
    for (const Corners& t : old) all.extend(box_of(t));
    for (const Corners& t : fresh) all.extend(box_of(t));
    std::vector<std::uint32_t> others = grid_.near(all);
    std::erase_if(others, [&](std::uint32_t t) { return std::count(star.begin(), star.end(), t) > 0; });
    for (const std::uint32_t t : fan) {
      const Box3 box = box_of(corners(t));
      for (const std::uint32_t other : others)
        if (box.intersects(box_of(corners(other))) && meet_outside_shared(points_, triangles_[t], triangles_[other])) return true;
    }
    // What lies between the discs and meets neither lies there as a whole, but for corners on the rim.
    const auto on_rim = [&](std::uint32_t v) { return std::any_of(fan.begin(), fan.end(), [&](std::uint32_t t) { return std::count(triangles_[t].begin(), triangles_[t].end(), v) > 0; }); };
    for (const std::uint32_t other : others) {
      const Corners t = corners(other);
      const auto inner = std::find_if_not(triangles_[other].begin(), triangles_[other].end(), on_rim);
      const Vec3 x = inner == triangles_[other].end() ? Vec3((t[0] + t[1] + t[2]) / 3) : points_[*inner];
      if (all.contains(x) && is_between(x, old, fresh)) return true;
    }
    return false;
  }

  // Star and fan close to a sphere: a point in it has been passed over. (Seen from above: is it so many triangles of one below as of the other?)
  static bool is_between(const Vec3& x, const std::vector<Corners>& old, const std::vector<Corners>& fresh) {
    int above = 0;
    for (const auto* disc : {&old, &fresh})
      for (const Corners& t : *disc)
        if (is_above(t[0], t[1], t[2], x)) above += (disc == &old ? 1 : -1) * turn(project(t[0], 2), project(t[1], 2), project(t[2], 2));
    return above != 0;
  }

  Decimated result() const {
    Decimated d;
    for (const double far : input_far_) d.bound = std::max(d.bound, far);
    std::vector<std::uint32_t> number(points_.size(), none);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (triangles_[t][0] == none) continue;
      d.bound = std::max(d.bound, far_[t]);
      Triangle corners;
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& n = number[triangles_[t][k]];
        if (n == none) {
          n = static_cast<std::uint32_t>(d.vertices.size());
          d.vertices.push_back(points_[triangles_[t][k]]);
        }
        corners[k] = n;
      }
      d.triangles.push_back(corners);
    }
    return d;
  }

  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  double most_;
  const std::function<bool(double)>& go_on_;
  const std::vector<Vec3> input_points_;
  const std::vector<Triangle> input_, across_input_;
  std::vector<std::vector<std::uint32_t>> relies_on_;   // per triangle of the input: those of the mesh that prove it near
  std::vector<std::vector<std::uint32_t>> dependents_;  // the other way round
  std::vector<double> far_, input_far_;                // bounds of the mesh's triangles' distance from the input, and the other way round
  std::vector<std::uint64_t> seen_, input_seen_;        // when a triangle was last looked at, in questions asked
  std::uint64_t stamp_ = 0;
  double slack_ = 0, unit_ = 1, thin_ = thin;
  std::vector<std::vector<std::uint32_t>> about_;      // per vertex: its triangles
  std::vector<QuadricError> quadrics_;
  std::vector<std::uint32_t> version_;
  TriangleGrid grid_;
  std::size_t left_;
  Vec3 origin_ = Vec3::Zero();
  std::priority_queue<Candidate> queue_;
};

}  // namespace

Decimated decimate(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool(double)>& go_on) {
  return Decimation(std::move(vertices), std::move(triangles), most, go_on).run();
}

}  // namespace starcell
