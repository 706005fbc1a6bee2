#include "decimation/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>

#include <Eigen/Geometry>

#include "decimation/quadric_error.h"
#include "isotopy/isotopic_mesh.h"

namespace starcell {
namespace {

// Where planes leave it open, short edges go first: an edge counts as if its square were off by this part of the error.
constexpr double length_weight = 1e-5;
// Area by longest side squared: below this a triangle may only take the place of one no better.
constexpr double thin = 0.03, thin_on_the_way = 5e-4;   // flat sides lose their thin ones again
// More triangles about a vertex are only made of as many.
constexpr std::size_t most_about = 16;
// A pass that takes less than this part of the triangles away is the last.
constexpr double worth_another = 0.02;
constexpr int most_passes = 4;
// What takes less than this part of the error comes first: flat sides are emptied before corners are cut.
constexpr double free_share = 1e-3;
constexpr std::size_t look_up_every = 32;
// The cosine of a fold, and what puts its edges before all others.
constexpr double fold = -0.7, flat_fold = -0.999;
constexpr double before_all = 1e100;

double shape_of(const Corners& t) {
  const double longest = std::max({(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()});
  return longest > 0 ? (t[1] - t[0]).cross(t[2] - t[0]).norm() / longest : 0;
}

class Decimation {
 public:
  Decimation(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool(double)>& go_on, std::size_t most_work = SIZE_MAX)
      : mesh_(std::move(vertices), std::move(triangles)), most_(most), go_on_(go_on), most_work_(most_work), quadrics_(mesh_.vertices()), version_(mesh_.vertices(), 0) {
    Box3 box;
    for (std::uint32_t v = 0; v < mesh_.vertices(); ++v) box.extend(mesh_.place(v));
    if (!box.isEmpty()) {
      origin_ = box.center();
      unit_ = std::min(most, box.sizes().maxCoeff());
    }
    for (std::uint32_t t = 0; t < mesh_.slots(); ++t) {
      const Corners p = mesh_.corners(t);
      const QuadricError quadric(p[0] - origin_, p[1] - origin_, p[2] - origin_);
      for (const std::uint32_t v : mesh_.triangle(t)) quadrics_[v] += quadric;
    }
  }

  Decimated unfold() {
    fold_ = flat_fold;
    folds_only_ = true;
    pass();
    return result();
  }

  Decimated run() {
    const double all = most_;
    for (const double share : {free_share, 1.0}) {
      most_ = share * all;
      thin_ = share < 1 ? thin_on_the_way : thin;
      for (int pass = 0; pass < most_passes; ++pass) {
        const std::size_t before = mesh_.size();
        if (!this->pass()) return result();
        if (static_cast<double>(before - mesh_.size()) < worth_another * static_cast<double>(before)) break;
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

  Vec3 normal(std::uint32_t t) const {
    const Corners p = mesh_.corners(t);
    return (p[1] - p[0]).cross(p[2] - p[0]).normalized();
  }

  // All but lying on a neighbour. Such folds should go while there is error left to spend on them.
  bool folded(std::uint32_t t) const {
    const Vec3 n = normal(t);
    for (const std::uint32_t v : mesh_.triangle(t))
      for (const std::uint32_t other : mesh_.about(v))
        if (n.dot(normal(other)) < fold_) return true;
    return false;
  }

  QuadricError together(std::uint32_t a, std::uint32_t b) const {
    QuadricError sum = quadrics_[a];
    sum += quadrics_[b];
    return sum;
  }

  Vec3 best_place(std::uint32_t a, std::uint32_t b, const QuadricError& sum) const { return sum.least(0.5 * (mesh_.place(a) + mesh_.place(b)) - origin_) + origin_; }

  void propose(std::uint32_t a, std::uint32_t b, bool first = false) {
    if (a > b) std::swap(a, b);
    const QuadricError sum = together(a, b);
    const double cost = std::min({sum.at(best_place(a, b, sum) - origin_), sum.at(mesh_.place(a) - origin_), sum.at(mesh_.place(b) - origin_)});
    if (!(cost <= most_ * most_ * sum.weight()) && !first) return;   // on average it is farther than allowed
    const double length = length_weight * length_weight * unit_ * unit_ * (mesh_.place(a) - mesh_.place(b)).squaredNorm();
    queue_.push({cost + length - (first ? before_all : 0), a, b, version_[a], version_[b]});
  }

  // False if it was called off.
  bool pass() {
    queue_ = {};
    for (std::uint32_t t = 0; t < mesh_.slots(); ++t) {
      if (!mesh_.has(t)) continue;
      const bool first = folded(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.triangle(t)[k], b = mesh_.triangle(t)[(k + 1) % 3];
        if ((a < b && !folds_only_) || first) propose(a, b, first);
      }
    }
    for (std::size_t step = 1; !queue_.empty(); ++step) {
      if (mesh_.work() > most_work_) return false;
      if (step % look_up_every == 0 && go_on_ && !go_on_(1 - static_cast<double>(mesh_.size()) / static_cast<double>(mesh_.slots()))) return false;
      const Candidate c = queue_.top();
      queue_.pop();
      if (version_[c.a] != c.version_a || version_[c.b] != c.version_b || mesh_.about(c.a).empty() || mesh_.about(c.b).empty()) continue;
      if (!collapse(c.a, c.b)) continue;
      if (folds_only_) continue;
      for (const std::uint32_t v : mesh_.neighbours(c.a)) propose(c.a, v);
    }
    return true;
  }

  bool collapse(std::uint32_t a, std::uint32_t b) {
    if (!mesh_.may_collapse(a, b)) return false;
    const QuadricError sum = together(a, b);
    std::array<Vec3, 3> places{best_place(a, b, sum), mesh_.place(a), mesh_.place(b)};
    if (sum.at(places[2] - origin_) < sum.at(places[1] - origin_)) std::swap(places[1], places[2]);
    for (const Vec3& place : places)
      if (collapse_to(a, b, place)) {
        quadrics_[a] = sum;
        ++version_[a];
        return true;
      }
    return false;
  }

  // The star of the edge gives way to a fan: the same triangles but those at the edge itself.
  bool collapse_to(std::uint32_t a, std::uint32_t b, const Vec3& place) {
    std::vector<std::uint32_t> star, gone;
    Fan fan{a, place, {}};
    double worst_before = 1, worst = 1;
    for (const std::uint32_t end : {a, b})
      for (const std::uint32_t t : mesh_.about(end)) {
        const Triangle& corners = mesh_.triangle(t);
        worst_before = std::min(worst_before, shape_of(mesh_.corners(t)));
        const auto k = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), end) - corners.begin());
        const std::uint32_t u = corners[(k + 1) % 3], v = corners[(k + 2) % 3], other = end == a ? b : a;
        if (u == other || v == other) {
          if (end == a) gone.push_back(t);
          continue;
        }
        star.push_back(t);
        fan.rim.push_back({u, v});
        worst = std::min(worst, shape_of({place, mesh_.place(u), mesh_.place(v)}));
      }
    if (star.size() > std::max({most_about, mesh_.about(a).size(), mesh_.about(b).size()})) return false;
    if (worst < thin_ && worst < 0.9 * worst_before) return false;
    star.insert(star.end(), gone.begin(), gone.end());
    return mesh_.replace(star, fan, most_);
  }

  Decimated result() const {
    Decimated d;
    d.bound = mesh_.bound();
    std::vector<std::uint32_t> numbers;
    mesh_.compact(d.vertices, d.triangles, numbers);
    return d;
  }

  IsotopicMesh mesh_;
  double most_, unit_ = 1, thin_ = thin, fold_ = fold;
  bool folds_only_ = false;
  const std::function<bool(double)>& go_on_;
  std::size_t most_work_;
  std::vector<QuadricError> quadrics_;
  std::vector<std::uint32_t> version_;
  Vec3 origin_ = Vec3::Zero();
  std::priority_queue<Candidate> queue_;
};

}  // namespace

Decimated decimate(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool(double)>& go_on, std::size_t most_work) {
  return Decimation(std::move(vertices), std::move(triangles), most, go_on, most_work).run();
}

Decimated unfold(std::vector<Vec3> vertices, std::vector<Triangle> triangles, double most, const std::function<bool(double)>& go_on) {
  return Decimation(std::move(vertices), std::move(triangles), most, go_on).unfold();
}

}  // namespace starcell
