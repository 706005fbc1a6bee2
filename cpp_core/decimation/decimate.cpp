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
#include "decimation/triangle_grid.h"
#include "solids/triangle_pair.h"

namespace starcell {
namespace {

constexpr std::uint32_t none = UINT32_MAX;
// Where planes leave it open, short edges go first.
constexpr double length_weight = 1e-7;
// Area by longest side squared: below this a triangle may only take the place of one no better.
constexpr double thin = 0.03;
// More triangles about a vertex are only made of as many.
constexpr std::size_t most_about = 16;
// A pass that takes less than this part of the triangles away is the last.
constexpr double worth_another = 0.02;
constexpr int most_passes = 4;
constexpr std::size_t look_up_every = 256;
// The cosine of a fold, and what puts its edges before all others.
constexpr double fold = -0.7;
constexpr double before_all = 1e100;

double shape_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0;
}

class Decimation {
 public:
  Decimation(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool()>& go_on)
      : points_(std::move(vertices)), triangles_(std::move(triangles)), most_(most), go_on_(go_on), moved_(triangles_.size(), 0.0),
        about_(points_.size()), quadrics_(points_.size()), version_(points_.size(), 0), grid_(cell_size()), left_(triangles_.size()) {
    Box3 box;
    for (const Vec3& p : points_) box.extend(p);
    if (!points_.empty()) origin_ = box.center();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const auto& [a, b, c] = triangles_[t];
      const QuadricError quadric(points_[a] - origin_, points_[b] - origin_, points_[c] - origin_);
      for (const std::uint32_t v : triangles_[t]) {
        about_[v].push_back(t);
        quadrics_[v] += quadric;
      }
      grid_.add(t, box_of(triangles_[t]));
    }
  }

  Decimated run() {
    for (int pass = 0; pass < most_passes; ++pass) {
      const std::size_t before = left_;
      if (!this->pass() || static_cast<double>(before - left_) < worth_another * static_cast<double>(before)) break;
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

  Box3 box_of(const Triangle& t) const { return Box3(points_[t[0]]).extend(points_[t[1]]).extend(points_[t[2]]); }

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
    const double length = (points_[a] - points_[b]).squaredNorm();
    queue_.push({sum.at(best) + length_weight * length * length - (first ? before_all : 0), a, b, version_[a], version_[b]});
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
      if (step % look_up_every == 0 && go_on_ && !go_on_()) return false;
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
    std::vector<std::uint32_t> star = about_[a], kept, gone;
    for (const std::uint32_t t : about_[b]) (std::count(star.begin(), star.end(), t) ? gone : star).push_back(t);
    std::vector<MovedTriangle> before;
    std::vector<std::array<Vec3, 3>> fan;
    Vec3 along = Vec3::Zero();
    double worst_before = 1, worst = 1;
    for (const std::uint32_t t : star) {
      const auto& [p, q, r] = triangles_[t];
      before.push_back({{points_[p], points_[q], points_[r]}, moved_[t]});
      const auto& corners = before.back().corners;
      along += (corners[1] - corners[0]).cross(corners[2] - corners[0]);
      worst_before = std::min(worst_before, shape_of(corners[0], corners[1], corners[2]));
      if (std::count(gone.begin(), gone.end(), t)) continue;
      const auto k = static_cast<std::size_t>(std::find_if(triangles_[t].begin(), triangles_[t].end(), [&](std::uint32_t v) { return v == a || v == b; }) -
                                              triangles_[t].begin());
      fan.push_back({place, corners[(k + 1) % 3], corners[(k + 2) % 3]});
      worst = std::min(worst, shape_of(fan.back()[0], fan.back()[1], fan.back()[2]));
      kept.push_back(t);
    }
    if (kept.size() > std::max({most_about, about_[a].size(), about_[b].size()})) return false;
    if (!(along.norm() > 0) || (worst < thin && worst < 0.9 * worst_before)) return false;
    const auto moved = match(before, fan, along.normalized());
    if (!moved || *std::max_element(moved->begin(), moved->end()) > most_) return false;
    return replace(a, b, place, star, kept, gone, *moved);
  }

  // Undone if the fan meets another triangle.
  bool replace(std::uint32_t a, std::uint32_t b, const Vec3& place, const std::vector<std::uint32_t>& star, const std::vector<std::uint32_t>& kept,
               const std::vector<std::uint32_t>& gone, const std::vector<double>& moved) {
    const Vec3 old_place = points_[a];
    std::vector<Triangle> old;
    std::vector<Box3> old_boxes;
    for (const std::uint32_t t : star) old_boxes.push_back(box_of(triangles_[t]));
    for (const std::uint32_t t : kept) {
      old.push_back(triangles_[t]);
      std::replace(triangles_[t].begin(), triangles_[t].end(), b, a);
    }
    points_[a] = place;
    if (meets_others(star, kept)) {
      points_[a] = old_place;
      for (std::size_t i = 0; i < kept.size(); ++i) triangles_[kept[i]] = old[i];
      return false;
    }
    for (std::size_t i = 0; i < star.size(); ++i) grid_.remove(star[i], old_boxes[i]);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      grid_.add(kept[i], box_of(triangles_[kept[i]]));
      moved_[kept[i]] = moved[i];
    }
    for (const std::uint32_t t : gone) {
      for (const std::uint32_t v : triangles_[t]) std::erase(about_[v], t);
      triangles_[t] = {none, none, none};
    }
    about_[a] = kept;
    about_[b].clear();
    left_ -= gone.size();
    return true;
  }

  bool meets_others(const std::vector<std::uint32_t>& star, const std::vector<std::uint32_t>& fan) const {
    for (const std::uint32_t t : fan) {
      const Box3 box = box_of(triangles_[t]);
      for (const std::uint32_t other : grid_.near(box)) {
        if (std::count(star.begin(), star.end(), other) || !box.intersects(box_of(triangles_[other]))) continue;
        if (meet_outside_shared(points_, triangles_[t], triangles_[other])) return true;
      }
    }
    return false;
  }

  Decimated result() const {
    Decimated d;
    std::vector<std::uint32_t> number(points_.size(), none);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (triangles_[t][0] == none) continue;
      d.bound = std::max(d.bound, moved_[t]);
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
  const std::function<bool()>& go_on_;
  std::vector<double> moved_;                          // per triangle: how far its points are from where they came from
  std::vector<std::vector<std::uint32_t>> about_;      // per vertex: its triangles
  std::vector<QuadricError> quadrics_;
  std::vector<std::uint32_t> version_;
  TriangleGrid grid_;
  std::size_t left_;
  Vec3 origin_ = Vec3::Zero();
  std::priority_queue<Candidate> queue_;
};

}  // namespace

Decimated decimate(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool()>& go_on) {
  return Decimation(std::move(vertices), std::move(triangles), most, go_on).run();
}

}  // namespace starcell
