#include "remeshing/remesh_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>

#include <Eigen/Geometry>

#include "isotopy/isotopic_mesh.h"
#include "remeshing/features.h"
#include "remeshing/size_field.h"
#include "remeshing/triangle_shape.h"

namespace starcell {
namespace {

using Edge = std::array<std::uint32_t, 2>;

// Of the wanted length: what is longer is cut, what is shorter collapses (Botsch & Kobbelt 2004).
constexpr double longest = 4.0 / 3, shortest = 4.0 / 5;
constexpr double at_first = 4;   // the input's triangles, which are cut no further than makes proofs short
constexpr int passes = 8, all_move = 3;   // then only vertices with angles that could be better
// Of the wanted length: walls thinner than this are not reason for smaller triangles.
constexpr double least_size = 1.0 / 20;
constexpr double least_room = 1.0 / 50;
// Angles that could be better, and those that no vertex need be moved for.
constexpr double thin = 30 * M_PI / 180, good = 38 * M_PI / 180;
// The cosine of the largest turn that is made where nothing is sharp.
constexpr double gentle = -0.5;
constexpr int mending_rounds = 6;
// How much better an angle has to get for a step to be worth it.
constexpr double worth = 0.5 * M_PI / 180;
// Of the error: what cutting the input's triangles may take. It takes a rounding.
constexpr double cutting_share = 1e-6;
// Of the error: what is no wider makes no sharp edges.
constexpr double sliver_share = 1.0 / 64;
// Pieces that a triangle is cut into before all begins anew.
constexpr int most_pieces = 8;
constexpr std::uint32_t look_up_every = 32;
// Called off.
struct Stopped {};

class Remesher {
 public:
  Remesher(std::vector<Vec3> vertices, std::vector<Triangle> triangles, const Remeshing& wanted, const std::function<bool(double)>& go_on)
      : wanted_(wanted), go_on_(go_on), features_(vertices, triangles, wanted.feature_angle, std::max(sliver_share * wanted.most, wanted.off)), mesh_(std::move(vertices), std::move(triangles), true) {}

  Remeshed run() {
    try {
      cut_input();
      for (int pass = 0; pass < passes; ++pass) {
        done_ = 0.1 + 0.7 * pass / passes;
        measure_sizes();
        cut(longest, wanted_.most - spent_);
        collapse();
        flip(wanted_.most - spent_);
        relax(pass);
      }
      mend();
    } catch (const Stopped&) {
      // What has been reached is proved, too.
    }
    return result();
  }

 private:
  void look_up() {
    if (++asked_ % look_up_every == 0 && go_on_ && !go_on_(done_)) throw Stopped();
  }

  double length(std::uint32_t a, std::uint32_t b) const { return (mesh_.place(a) - mesh_.place(b)).norm(); }
  double wanted_length(std::uint32_t a, std::uint32_t b) const { return 0.5 * (size_[a] + size_[b]); }

  // Each once, by number.
  std::vector<Edge> edges() const {
    std::vector<Edge> all;
    for (std::uint32_t t = 0; t < mesh_.slots(); ++t)
      for (int k = 0; mesh_.has(t) && k < 3; ++k)
        if (const std::uint32_t a = mesh_.triangle(t)[k], b = mesh_.triangle(t)[(k + 1) % 3]; a < b) all.push_back({a, b});
    return all;
  }

  // The two triangles at an edge, if there is such an edge: first the one in which b follows a.
  std::optional<std::array<std::uint32_t, 2>> sides(std::uint32_t a, std::uint32_t b) const {
    std::array<std::uint32_t, 2> found{IsotopicMesh::none, IsotopicMesh::none};
    for (const std::uint32_t t : mesh_.about(a))
      for (int k = 0; k < 3; ++k)
        if (mesh_.triangle(t)[k] == a) {
          if (mesh_.triangle(t)[(k + 1) % 3] == b) found[0] = t;
          if (mesh_.triangle(t)[(k + 2) % 3] == b) found[1] = t;
        }
    if (found[0] == IsotopicMesh::none || found[1] == IsotopicMesh::none) return std::nullopt;
    return found;
  }

  std::uint32_t opposite(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t v : mesh_.triangle(t))
      if (v != a && v != b) return v;
    return IsotopicMesh::none;
  }

  double angle_of(std::uint32_t t) const { return least_angle(mesh_.corners(t)); }
  double angle_of(const std::vector<std::uint32_t>& triangles) const {
    double least = M_PI;
    for (const std::uint32_t t : triangles) least = std::min(least, angle_of(t));
    return least;
  }
  double angle_of(const Fan& fan) const {
    double least = M_PI;
    for (const auto& [u, v] : fan.rim) least = std::min(least, least_angle({fan.place, mesh_.place(u), mesh_.place(v)}));
    return least;
  }

  // A vertex's triangles as a fan, the vertex elsewhere.
  Fan fan_about(std::uint32_t v, const Vec3& place) const {
    Fan fan{v, place, {}};
    for (const std::uint32_t t : mesh_.about(v)) {
      const Triangle& c = mesh_.triangle(t);
      const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
      fan.rim.push_back({c[(k + 1) % 3], c[(k + 2) % 3]});
    }
    return fan;
  }

  Vec3 normal_of(std::uint32_t t) const { return normal_of(mesh_.corners(t)); }
  static Vec3 normal_of(const Corners& p) { return (p[1] - p[0]).cross(p[2] - p[0]).normalized(); }

  // The cosine of the largest turn at an edge that is not sharp: of the disc as it is.
  double bend_of(const std::vector<std::uint32_t>& disc) const {
    double least = 1;
    for (const std::uint32_t t : disc)
      for (int k = 0; k < 3; ++k)
        if (!features_.has(mesh_.triangle(t)[k], mesh_.triangle(t)[(k + 1) % 3])) least = std::min(least, normal_of(t).dot(normal_of(mesh_.across(t, k))));
    return least;
  }
  // And with the fan in its place. `goes`: a vertex that will have gone to the apex.
  double bend_of(const std::vector<std::uint32_t>& disc, const Fan& fan, std::uint32_t goes) const {
    std::vector<Vec3> normals;
    for (const auto& [u, v] : fan.rim) normals.push_back(normal_of({fan.place, mesh_.place(u), mesh_.place(v)}));
    double least = 1;
    for (std::size_t i = 0; i < fan.rim.size(); ++i) {
      const auto [u, v] = fan.rim[i];
      if (!features_.has(u, v))
        if (const auto at = sides(v, u); at && !std::count(disc.begin(), disc.end(), (*at)[0])) least = std::min(least, normals[i].dot(normal_of((*at)[0])));
      if (features_.has(fan.apex, v) || features_.has(goes, v)) continue;
      for (std::size_t j = 0; j < fan.rim.size(); ++j)
        if (fan.rim[j][0] == v) least = std::min(least, normals[i].dot(normals[j]));
    }
    return least;
  }

  // Folds are not made: where nothing is sharp the surface turns by no more than it did, or than it may.
  bool replace(const std::vector<std::uint32_t>& disc, const Fan& fan, double most, std::uint32_t goes = IsotopicMesh::none) {
    const double bend = bend_of(disc, fan, goes);
    return (bend >= gentle || bend >= bend_of(disc)) && mesh_.replace(disc, fan, most);
  }

  void measure_sizes() {
    std::vector<double> most(mesh_.vertices(), wanted_.edge_length);
    for (std::uint32_t v = 0; v < std::min<std::size_t>(room_.size(), most.size()); ++v) most[v] = std::clamp(room_[v], least_room * most[v], most[v]);
    size_ = sizes(mesh_.places(), edges(), features_, std::move(most), least_size * wanted_.edge_length);
  }

  // The input in pieces of the wanted size, so that what is proved of a piece later asks for no more than pieces.
  void cut_input() {
    for (bool again = true; again;) {
      measure_sizes();
      pieces_.assign(mesh_.slots(), 1);
      flip(cutting_share * wanted_.most);
      again = cut(at_first, cutting_share * wanted_.most);
      pieces_.clear();
      spent_ += mesh_.bound();
      mesh_.begin_anew();
    }
  }

  // Cuts long edges in halves, the longest first. True if there were any.
  bool cut(double over, double most) {
    using Long = std::tuple<double, std::uint32_t, std::uint32_t>;
    std::priority_queue<Long> queue;
    const auto propose = [&](std::uint32_t a, std::uint32_t b) {
      const double by = length(a, b) / (over * wanted_length(a, b));
      if (by > 1) queue.emplace(by, std::min(a, b), std::max(a, b));
    };
    for (const auto& [a, b] : edges()) propose(a, b);
    bool any = false;
    while (!queue.empty()) {
      look_up();
      const auto [by, a, b] = queue.top();
      queue.pop();
      const std::uint32_t middle = halve(a, b, most);
      if (middle == IsotopicMesh::none) continue;
      any = true;
      for (const std::uint32_t v : mesh_.neighbours(middle)) propose(v, middle);
    }
    return any;
  }

  std::uint32_t halve(std::uint32_t a, std::uint32_t b, double most) {
    const auto at = sides(a, b);
    if (!at) return IsotopicMesh::none;
    const auto [left, right] = *at;
    if (!pieces_.empty() && std::max(pieces_[left], pieces_[right]) >= most_pieces) return IsotopicMesh::none;
    const std::uint32_t c = opposite(left, a, b), d = opposite(right, a, b), middle = mesh_.vertices();
    const std::uint32_t before = mesh_.slots();
    if (!mesh_.replace({left, right}, {middle, 0.5 * (mesh_.place(a) + mesh_.place(b)), {{b, c}, {c, a}, {a, d}, {d, b}}}, most)) return IsotopicMesh::none;
    features_.split(a, b, middle);
    size_.push_back(wanted_length(a, b));
    if (!pieces_.empty()) {
      const int most_of_both = std::max(pieces_[left], pieces_[right]) + 1;
      pieces_.resize(mesh_.slots());
      pieces_[left] = pieces_[right] = pieces_[before] = pieces_[before + 1] = most_of_both;
    }
    return middle;
  }

  // Short edges, the shortest first.
  void collapse() {
    using Short = std::tuple<double, std::uint32_t, std::uint32_t>;
    std::priority_queue<Short, std::vector<Short>, std::greater<>> queue;
    const auto propose = [&](std::uint32_t a, std::uint32_t b) {
      const double part = length(a, b) / (shortest * wanted_length(a, b));
      if (part < 1) queue.emplace(part, std::min(a, b), std::max(a, b));
    };
    for (const auto& [a, b] : edges()) propose(a, b);
    room_.assign(mesh_.vertices(), std::numeric_limits<double>::infinity());
    while (!queue.empty()) {
      look_up();
      const auto [part, a, b] = queue.top();
      queue.pop();
      if (!sides(a, b) || part != length(a, b) / (shortest * wanted_length(a, b))) continue;   // it has changed since
      const std::uint32_t left = collapse(a, b, longest);
      if (left != IsotopicMesh::none)
        for (const std::uint32_t v : mesh_.neighbours(left)) propose(v, left);
    }
  }

  // What is left of the edge: the vertex at which it ends up, or none if it stays. Edges of more than `over` times their size are not made.
  std::uint32_t collapse(std::uint32_t a, std::uint32_t b, double over, double least = 0) {
    if (!mesh_.may_collapse(a, b)) return IsotopicMesh::none;
    const bool free_a = features_.is_free(a), free_b = features_.is_free(b);
    const Vec3 middle = 0.5 * (mesh_.place(a) + mesh_.place(b));
    std::vector<std::pair<std::uint32_t, Vec3>> ends;   // which vertex stays, and where
    if (free_a && free_b) {
      ends = {{a, middle}, {a, mesh_.place(a)}, {b, mesh_.place(b)}};
    } else if (free_a) {
      ends = {{b, mesh_.place(b)}};
    } else if (free_b) {
      ends = {{a, mesh_.place(a)}};
    } else if (features_.has(a, b)) {
      if (features_.is_straight(b, mesh_.places())) ends.emplace_back(a, mesh_.place(a));
      if (features_.is_straight(a, mesh_.places())) ends.emplace_back(b, mesh_.place(b));
    }
    bool kept_by_error = false;
    for (const auto& [stays, place] : ends) {
      const std::uint32_t goes = stays == a ? b : a;
      std::vector<std::uint32_t> star, gone;
      Fan fan{stays, place, {}};
      bool too_long = false;
      for (const std::uint32_t end : {stays, goes})
        for (const std::uint32_t t : mesh_.about(end)) {
          const Triangle& c = mesh_.triangle(t);
          const std::size_t k = c[0] == end ? 0 : c[1] == end ? 1 : 2;
          const std::uint32_t u = c[(k + 1) % 3], v = c[(k + 2) % 3], other = end == a ? b : a;
          if (u == other || v == other) {
            if (end == stays) gone.push_back(t);
            continue;
          }
          star.push_back(t);
          fan.rim.push_back({u, v});
          too_long = too_long || (place - mesh_.place(u)).norm() > over * wanted_length(stays, u);
        }
      if (too_long) continue;
      star.insert(star.end(), gone.begin(), gone.end());
      const double before = angle_of(star), after = angle_of(fan);
      if (after < least || (after < 0.1 && after < before)) continue;
      const bool straight = !features_.is_free(goes);
      if (straight && features_.along(goes)[0] != stays && features_.has(stays, features_.along(goes)[0])) continue;
      if (straight && features_.along(goes)[1] != stays && features_.has(stays, features_.along(goes)[1])) continue;
      if (replace(star, fan, wanted_.most - spent_, goes)) {
        if (straight) features_.straighten(goes);
        size_[stays] = std::min(size_[stays], size_[goes]);
        return stays;
      }
      kept_by_error = true;
    }
    if (kept_by_error)
      for (const std::uint32_t v : {a, b}) room_[v] = std::min(room_[v], length(a, b) / shortest);
    return IsotopicMesh::none;
  }

  // Towards larger least angles (Delaunay's, in a plane).
  void flip(double most) {
    for (bool again = true; again;) {
      again = false;
      for (const auto& [a, b] : edges()) {
        look_up();
        again = flip(a, b, most) || again;
      }
    }
  }

  bool flip(std::uint32_t a, std::uint32_t b, double most) {
    if (features_.has(a, b)) return false;
    const auto at = sides(a, b);
    if (!at) return false;
    const auto [left, right] = *at;
    const std::uint32_t c = opposite(left, a, b), d = opposite(right, a, b);
    if (c == d || sides(c, d)) return false;
    const Fan fan{c, mesh_.place(c), {{a, d}, {d, b}}};
    return angle_of(fan) > std::min(angle_of(left), angle_of(right)) + worth && replace({left, right}, fan, most);
  }

  // Vertices go to the middle of what is about them, in the surface.
  void relax(int pass) {
    for (int round = 0; round < 2; ++round)
      for (std::uint32_t v = 0; v < mesh_.vertices(); ++v) {
        look_up();
        if (!mesh_.about(v).empty() && (pass < all_move || angle_of(mesh_.about(v)) < good)) relax(v);
      }
  }

  // The middle of the triangles about the vertex, those of small edges weighing more.
  Vec3 middle_about(std::uint32_t v) const {
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (const std::uint32_t t : mesh_.about(v)) {
      const Corners p = mesh_.corners(t);
      const Triangle& c = mesh_.triangle(t);
      const double size = (size_[c[0]] + size_[c[1]] + size_[c[2]]) / 3, weight = (p[1] - p[0]).cross(p[2] - p[0]).norm() / (size * size);
      sum += weight * (p[0] + p[1] + p[2]) / 3;
      weights += weight;
    }
    return weights > 0 ? Vec3(sum / weights) : mesh_.place(v);
  }

  // x seen from the vertex along its normal, and from there to the input.
  Vec3 in_surface(std::uint32_t v, const Vec3& x) const {
    Vec3 normal = Vec3::Zero();
    for (const std::uint32_t t : mesh_.about(v)) {
      const Corners p = mesh_.corners(t);
      normal += (p[1] - p[0]).cross(p[2] - p[0]);
    }
    if (!(normal.norm() > 0)) return mesh_.place(v);
    normal.normalize();
    const Vec3 by = x - mesh_.place(v);
    return mesh_.on_first(mesh_.place(v) + by - normal.dot(by) * normal, mesh_.about(v));
  }

  bool relax(std::uint32_t v) {
    if (features_.is_free(v)) return move(v, in_surface(v, middle_about(v)), good);
    if (!features_.is_straight(v, mesh_.places())) return false;
    const std::uint32_t p = features_.along(v)[0], q = features_.along(v)[1];
    const double share = size_[p] / (size_[p] + size_[q]);
    return move(v, mesh_.place(p) + share * (mesh_.place(q) - mesh_.place(p)), good);
  }

  // If angles get no worse by it than they are, or than `enough`.
  bool move(std::uint32_t v, const Vec3& place, double enough) {
    if ((place - mesh_.place(v)).norm() < 1e-3 * size_[v]) return false;
    const Fan fan = fan_about(v, place);
    const std::vector<std::uint32_t> star = mesh_.about(v);
    return angle_of(fan) >= std::min(enough, angle_of(star)) && replace(star, fan, wanted_.most - spent_);
  }

  // What is thin still, one triangle at a time.
  void mend() {
    for (int round = 0; round < mending_rounds; ++round) {
      done_ = 0.8 + 0.2 * round / mending_rounds;
      bool any = false;
      for (std::uint32_t t = 0; t < mesh_.slots(); ++t) {
        look_up();
        if (mesh_.has(t) && angle_of(t) < thin) any = mend(t) || any;
      }
      if (!any) break;
    }
  }

  bool mend(std::uint32_t t) {
    const Triangle c = mesh_.triangle(t);
    for (int k = 0; k < 3; ++k)
      if (flip(c[k], c[(k + 1) % 3], wanted_.most - spent_)) return true;
    int k = 0;   // the shortest edge from corner k
    for (int j = 1; j < 3; ++j)
      if (length(c[j], c[(j + 1) % 3]) < length(c[k], c[(k + 1) % 3])) k = j;
    if (collapse(c[k], c[(k + 1) % 3], 1.6, std::max(angle_of(t) + worth, std::min(thin, angle_of(mesh_.about(c[k])) + worth))) != IsotopicMesh::none) return true;
    for (const std::uint32_t v : c)
      if (features_.is_free(v) && improve(v)) return true;
    return false;
  }

  // A free vertex to a place where the least angle about it is larger.
  bool improve(std::uint32_t v) {
    const std::vector<std::uint32_t> star = mesh_.about(v);
    const double before = angle_of(star);
    std::vector<std::pair<double, Vec3>> places;
    const auto propose = [&](const Vec3& x) {
      const Vec3 place = in_surface(v, x);
      if (const double angle = angle_of(fan_about(v, place)); angle > before + worth) places.emplace_back(angle, place);
    };
    const Vec3 middle = middle_about(v);
    for (const double part : {1.0, 0.5, 0.25}) propose(mesh_.place(v) + part * (middle - mesh_.place(v)));
    for (const std::uint32_t t : star) {   // where its triangles would have equal sides
      const Triangle& c = mesh_.triangle(t);
      const std::size_t k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
      const Vec3 &p = mesh_.place(c[(k + 1) % 3]), &q = mesh_.place(c[(k + 2) % 3]), m = 0.5 * (p + q), side = q - p;
      Vec3 up = mesh_.place(v) - m;
      up -= up.dot(side) / std::max(side.squaredNorm(), std::numeric_limits<double>::min()) * side;
      if (!(up.norm() > 0)) continue;
      const Vec3 ideal = m + std::sqrt(0.75) * side.norm() * up.normalized();
      for (const double part : {1.0, 0.5, 0.25}) propose(mesh_.place(v) + part * (ideal - mesh_.place(v)));
    }
    std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [angle, place] : places)
      if (replace(star, fan_about(v, place), wanted_.most - spent_)) return true;
    return false;
  }

  Remeshed result() const {
    Remeshed r;
    r.bound = spent_ + mesh_.bound();
    r.feature_edges = features_.size();
    for (std::uint32_t v = 0; v < mesh_.vertices(); ++v)
      r.corners += !mesh_.about(v).empty() && !features_.is_free(v) && !features_.is_straight(v, mesh_.places());
    std::vector<std::uint32_t> numbers;
    mesh_.compact(r.vertices, r.triangles, numbers);
    return r;
  }

  const Remeshing wanted_;
  const std::function<bool(double)>& go_on_;
  Features features_;
  IsotopicMesh mesh_;
  std::vector<double> size_, room_;   // per vertex: the length wanted there; what the error let no edge be longer than
  std::vector<int> pieces_;           // per triangle: how many the one it is of was cut into
  double spent_ = 0, done_ = 0;
  std::uint32_t asked_ = 0;
};

}  // namespace

Remeshed remesh_surface(std::vector<Vec3> vertices, std::vector<Triangle> triangles, const Remeshing& wanted, const std::function<bool(double)>& go_on) {
  return Remesher(std::move(vertices), std::move(triangles), wanted, go_on).run();
}

}  // namespace starcell
