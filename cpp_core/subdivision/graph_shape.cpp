#include "subdivision/graph_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "numerics/linear_program.h"

namespace starcell {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// In how many parts a segment beside which E's loop runs is looked at; how often a piece is halved.
constexpr int parts = 4;
constexpr int most_halvings = 2;
constexpr double much_better = 0.7;
// Of the room: what deviates no more than this is not looked at more closely.
constexpr double good_share = 0.5;

Box3 inflated(const Box3& box, const Vec3& by) { return {box.min() - by, box.max() + by}; }

// A box whose middle and sizes may be rounded: a little more than the box.
Box3 padded(const Box3& box) {
  const double rounded = 1e-15 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return inflated(box, Vec3::Constant(rounded));
}

// Needs a Rounding object.
Expansion over(const Surface& surface, const Box3& box) {
  const Box3 around = padded(box);
  return surface.expand(around.center(), 0.5 * around.sizes());
}

// A value per surface of a class.
template <class T>
using PerSurface = std::array<T, max_class>;

// A segment or a triangle.
struct Piece {
  std::array<Vec3, 3> corners;
  std::size_t size;

  Piece(const Vec3& p, const Vec3& q) : corners{p, q, q}, size(2) {}
  Piece(const Vec3& p, const Vec3& q, const Vec3& r) : corners{p, q, r}, size(3) {}
  Box3 box() const {
    Box3 box(corners[0]);
    return box.extend(corners[1]).extend(corners[2]);
  }
};

class Graph {
 public:
  Graph(const std::vector<const Surface*>& surfaces, const std::vector<int>& senses, std::uint64_t value, const Vec3& u, double room, const Box3& around)
      : n_(surfaces.size()), senses_(senses), value_(value), u_(u), room_(room), good_(good_share * room),
        rounded_(1e-15 * std::max(around.min().cwiseAbs().maxCoeff(), around.max().cwiseAbs().maxCoeff())), around_(around) {
    std::copy(surfaces.begin(), surfaces.end(), surfaces_.begin());
    least_ = least_slopes(inflated(around, room * u.cwiseAbs()));
  }

  using Heights = PerSurface<Interval>;

  // F at a point, turned as E is, per surface.
  Heights heights(const Vec3& p) const {
    const Rounding rounding;
    Heights result;
    for (std::size_t k = 0; k < n_; ++k) result[k] = sense(k) * surfaces_[k]->expand(p, Vec3::Zero()).value;
    return result;
  }

  // What is no more than this need not be known better.
  double good() const { return good_; }

  // The deviation of a piece with these heights at its corners; infinite beyond the room. If nothing is known of it as a whole, its
  // halves or quarters are looked at: they have corners of their own, and F bends less over them.
  double deviation(const std::array<const Heights*, 3>& heights, const Piece& piece, int depth = 0) const {
    const double whole = deviation_at_once(heights, piece);
    if (std::isfinite(whole) || depth >= most_halvings) return whole;
    const auto& [p, q, r] = piece.corners;
    const Vec3 pq = 0.5 * (p + q);
    const Heights at_pq = this->heights(pq);
    if (piece.size == 2) {
      const double first = deviation({heights[0], &at_pq, &at_pq}, {p, pq}, depth + 1);
      return rounded_ + (std::isinf(first) ? first : std::max(first, deviation({&at_pq, heights[1], heights[1]}, {pq, q}, depth + 1)));
    }
    const Vec3 qr = 0.5 * (q + r), rp = 0.5 * (r + p);
    const Heights at_qr = this->heights(qr), at_rp = this->heights(rp);
    double worst = deviation({&at_pq, &at_qr, &at_rp}, {pq, qr, rp}, depth + 1);
    if (std::isfinite(worst)) worst = std::max(worst, deviation({heights[0], &at_pq, &at_rp}, {p, pq, rp}, depth + 1));
    if (std::isfinite(worst)) worst = std::max(worst, deviation({heights[1], &at_qr, &at_pq}, {q, qr, pq}, depth + 1));
    if (std::isfinite(worst)) worst = std::max(worst, deviation({heights[2], &at_rp, &at_qr}, {r, rp, qr}, depth + 1));
    return rounded_ + worst;
  }

  // How far E's points may be that lie over the gap between a segment and E's loop beside it. Along the way between the two the
  // height differs from the segment's by `apart` where it starts, over the segment, and by the sway's own height where it ends,
  // on the loop; in between by as much as E is steep, which is `steepest` within the room of the whole fan.
  double beside(const Vec3& p, const Vec3& q, double apart, const Sway& sway, double gap, double steepest) const {
    const bool any = sway.along.isZero(0.0);
    const double aside = gap + sway.by * (any ? 1.0 : sway.along.cross(u_).norm() + 1e-12);
    const double at_end = gap + sway.by * (any ? 1.0 : std::abs(sway.along.dot(u_)) + 1e-12);
    const double most = std::max({apart, at_end, 0.5 * (apart + at_end + steepest * aside)});
    const double whole = std::hypot(most, aside);
    return whole <= room_ ? whole : beside_in_parts(p, q, apart, at_end, aside);
  }

  double steepness(const Box3& box) const {
    const Rounding rounding;
    double steepest = 0;
    for (std::size_t k = 0; k < n_; ++k) {
      const Expansion e = over(*surfaces_[k], box);
      const Interval3 normal = sense(k) * e.slope;
      const Interval along = e.along(senses_[k] * u_);
      if (certain_sign(along) <= 0) return infinity;
      steepest = std::max(steepest, (norm(normal - along * enclose(u_)) / Interval(along.lower())).upper());
    }
    return steepest;
  }

 private:
  Interval sense(std::size_t k) const { return static_cast<double>(senses_[k]); }

  // Slopes are those that the lift sweeps: the less it is lifted, the less they vary.
  double deviation_at_once(const std::array<const Heights*, 3>& heights, const Piece& piece) const {
    const Box3 box = piece.box();
    PerSurface<double> above, below;   // how far F may be from where the piece has passed it
    {
      const Rounding rounding;
      for (std::size_t k = 0; k < n_; ++k) {
        const Expansion e = over(*surfaces_[k], box);
        const auto& [p, q, r] = piece.corners;
        double least = infinity, most = -infinity;
        for (std::size_t i = 0; i < piece.size; ++i) {
          least = std::min(least, (*heights[i])[k].lower());
          most = std::max(most, (*heights[i])[k].upper());
        }
        const Interval values = sense(k) * Interval(least, most);
        const Interval excess = sense(k) * (piece.size == 3 ? e.excess(p, q, r, values) : e.excess(p, q, values));
        above[k] = (Interval(excess.upper()) - least).upper();
        below[k] = (Interval(most) - excess.lower()).upper();
      }
    }
    const double lift = lift_of(above, below, least_);
    if (lift <= good_) return lift;
    for (const double share : {0.45, 1.0}) {
      if (share == 1.0 && box.contains(around_)) break;
      const double closer = lift_of(above, below, least_slopes(inflated(box, share * room_ * u_.cwiseAbs())));
      if (closer <= share * room_) return std::min(lift, closer);
    }
    return lift <= room_ ? lift : infinity;
  }

  double beside_in_parts(const Vec3& p, const Vec3& q, double apart, double at_end, double aside) const {
    double farthest = 0;
    for (int part = 0; part < parts; ++part) {
      const Vec3 from = p + (q - p) * (static_cast<double>(part) / parts), to = p + (q - p) * (static_cast<double>(part + 1) / parts);
      double height = infinity;
      for (double reach = std::max(apart, at_end); reach <= 2 * room_ && std::isinf(height); reach *= 1.4) {
        const double steep = steepness(inflated(Piece(from, to).box(), Vec3::Constant(aside) + reach * u_.cwiseAbs()));
        const double most = std::max({apart, at_end, 0.5 * (apart + at_end + steep * aside)});
        if (most <= reach) height = most;
      }
      farthest = std::max(farthest, std::hypot(height, aside));
    }
    return farthest;
  }

  // How far a piece has to be lifted, or lowered, until E's logic says on which side it is.
  double lift_of(const PerSurface<double>& above, const PerSurface<double>& below, const PerSurface<double>& slopes) const {
    PerSurface<double> up, down;
    {
      const Rounding rounding;
      for (std::size_t k = 0; k < n_; ++k) {
        if (!(slopes[k] > 0)) return infinity;
        up[k] = std::max(0.0, (Interval(above[k]) / Interval(slopes[k])).upper());
        down[k] = std::max(0.0, (Interval(below[k]) / Interval(slopes[k])).upper());
      }
    }
    return std::max(least_lift(up, true), least_lift(down, false));
  }

  PerSurface<double> least_slopes(const Box3& box) const {
    const Box3 around = padded(box);
    const Rounding rounding;
    PerSurface<double> slopes{};
    for (std::size_t k = 0; k < n_; ++k) slopes[k] = surfaces_[k]->slope_along(around.center(), 0.5 * around.sizes(), senses_[k] * u_).lower();
    return slopes;
  }

  // The smallest lift at which E's logic says what is wanted, given the lifts from which each patch is certainly passed.
  double least_lift(const PerSurface<double>& passed, bool outside) const {
    PerSurface<double> steps;
    steps.fill(infinity);
    std::copy_n(passed.begin(), n_, steps.begin());
    std::sort(steps.begin(), steps.end());
    double lift = 0;
    for (std::size_t step = 0; step <= n_; ++step) {
      if (std::isinf(lift)) break;
      bool holds = true;
      for (std::size_t a = 0; a < std::size_t{1} << n_ && holds; ++a) {
        bool possible = true;   // may the lifted piece be on these sides?
        for (std::size_t k = 0; k < n_ && possible; ++k)
          if (passed[k] <= lift) possible = ((a >> k & 1) != 0) == ((senses_[k] > 0) != outside);
        holds = !possible || ((value_ >> a & 1) != 0) != outside;
      }
      if (holds) return lift;
      if (step < n_) lift = steps[step];
    }
    return infinity;
  }

  const std::size_t n_;
  PerSurface<const Surface*> surfaces_;
  const std::vector<int>& senses_;
  const std::uint64_t value_;
  const Vec3 u_;
  const double room_, good_;
  const double rounded_;         // no middle of a piece is farther from the piece
  const Box3 around_;            // all pieces are in it
  PerSurface<double> least_{};   // slope wherever a piece is lifted to
};

// Do all triangles of the fan face u?
bool unfolded(const std::vector<Vec3>& loop, const Vec3& apex, const Vec3& u) {
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (!((loop[k] - apex).cross(loop[(k + 1) % loop.size()] - apex).dot(u) > 0)) return false;
  return true;
}

// Points on the sheet's surfaces over the deepest point of the kernel of the loop's shadow, found by the small linear program.
std::vector<Vec3> seeing_places(const Sheet& sheet, const std::vector<Vec3>& loop, const Box3& inside) {
  std::vector<Vec3> normals, places;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 outward = (loop[(k + 1) % loop.size()] - loop[k]).cross(sheet.direction);
    if (!(outward.norm() > 0)) return {};
    normals.push_back(outward.normalized());
  }
  const auto seen = deepest_point(normals, loop, inside);
  if (!seen) return {};
  for (const auto& surface : sheet.graph->surfaces) {
    Vec3 x = *seen;
    for (int step = 0; step < 6; ++step) {   // Newton's method along the direction
      Vec3 gradient;
      const double value = surface->value(x, &gradient), slope = gradient.dot(sheet.direction);
      if (slope == 0) break;
      x -= value / slope * sheet.direction;
    }
    if (x.allFinite() && inside.contains(x)) places.push_back(x);
  }
  return places;
}

// Newton's method: every time the shortest step on which the linearised surfaces all vanish.
template <class Rows>
Vec3 place_on(const std::vector<const Surface*>& surfaces, const Vec3& start, int flat_axis) {
  const auto n = static_cast<Eigen::Index>(surfaces.size());
  Rows gradients(n, 3);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Rows::MaxRowsAtCompileTime, 1> values(n);
  Vec3 x = start;
  for (int step = 0; step < 6; ++step) {
    for (Eigen::Index k = 0; k < n; ++k) {
      Vec3 g;
      values[k] = surfaces[static_cast<std::size_t>(k)]->value(x, &g);
      if (flat_axis >= 0) g[flat_axis] = 0;
      gradients.row(k) = g;
    }
    const Vec3 by = n == 1 ? Vec3(values[0] / gradients.row(0).squaredNorm() * gradients.row(0).transpose())
                           : Vec3(gradients.completeOrthogonalDecomposition().solve(values));
    if (!by.allFinite()) break;
    x -= by;
    if (by.norm() <= 1e-15 * x.norm()) break;
  }
  return x;
}

}  // namespace

double room_around(double size, double error) { return std::min(0.75 * error, 0.5 * size); }

Vec3 common_place(const std::vector<const Surface*>& surfaces, const Vec3& start, int flat_axis) {
  // Three rows and no heap where that is enough.
  using Few = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor, 3, 3>;
  if (surfaces.size() <= 3) return place_on<Few>(surfaces, start, flat_axis);
  return place_on<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(surfaces, start, flat_axis);
}

double segment_deviation(const Patches& patches, const PatchClass& c, const Vec3& u, double room, const Vec3& p, const Vec3& q) {
  std::vector<const Surface*> surfaces;
  for (const std::size_t k : c.patches) surfaces.push_back(&patches.at(k));
  const Graph graph(surfaces, c.sense, c.value, u, room, Piece(p, q).box());
  const Graph::Heights at_p = graph.heights(p), at_q = graph.heights(q);
  return graph.deviation({&at_p, &at_q, &at_q}, {p, q});
}

Sheet graph_sheet(const Patches& patches, const PatchClass& c, const Vec3& u, double room) {
  Sheet sheet;
  sheet.shape = Sheet::Shape::graph;
  sheet.direction = u;
  sheet.high = room;
  GraphLogic logic;
  for (std::size_t i = 0; i < c.patches.size(); ++i) {
    sheet.surfaces.push_back(patches.surface(c.patches[i]));
    logic.surfaces.push_back(patches.here(c.patches[i]));
    logic.senses.push_back(c.sense[i]);
  }
  logic.value = c.value;
  sheet.graph = std::make_shared<const GraphLogic>(std::move(logic));
  return sheet;
}

GraphFan graph_fan(const Box3& cell, const Sheet& sheet, const std::vector<Vec3>& loop, const std::vector<Sway>& sways, double gap, double margin) {
  const Vec3& u = sheet.direction;
  std::vector<const Surface*> on;
  for (const auto& surface : sheet.graph->surfaces) on.push_back(surface.get());
  Box3 around = cell;
  for (const Vec3& p : loop) around.extend(p);
  const Graph graph(on, sheet.graph->senses, sheet.graph->value, u, sheet.high, around);
  Vec3 centroid = Vec3::Zero();
  for (const Vec3& p : loop) centroid += p / static_cast<double>(loop.size());
  std::vector<Graph::Heights> rim;
  rim.reserve(loop.size());
  for (const Vec3& p : loop) rim.push_back(graph.heights(p));

  const auto deviation_below = [&](const Vec3& apex, double enough) {
    const Graph::Heights at_apex = graph.heights(apex);
    double deviation = 0;
    for (std::size_t k = 0; k < loop.size() && deviation < enough; ++k) {
      const std::size_t next = (k + 1) % loop.size();
      deviation = std::max(deviation, graph.deviation({&at_apex, &rim[k], &rim[next]}, {apex, loop[k], loop[next]}));
    }
    return deviation;
  };
  const Box3 inside(cell.min() + Vec3::Constant(margin), cell.max() - Vec3::Constant(margin));
  GraphFan best{centroid, infinity};
  const auto propose = [&](const std::vector<const Surface*>& surfaces) {
    if (best.bound <= graph.good()) return;
    Vec3 apex = common_place(surfaces, centroid);
    apex = apex.allFinite() ? Vec3(apex.cwiseMax(inside.min()).cwiseMin(inside.max())) : centroid;
    // The first is on all surfaces, so creases stay sharp and triangles stay on planes: others have to be much better.
    const double enough = std::isinf(best.bound) ? infinity : much_better * best.bound;
    const double deviation = deviation_below(apex, enough);
    if (deviation < enough) best = {apex, deviation};
  };
  // The apex that the leaf was accepted with still serves, unless neighbours changed the loop much.
  if (sheet.low > 0 && unfolded(loop, sheet.apex, u)) {
    const double known = 1.1 * sheet.low + gap, deviation = deviation_below(sheet.apex, known);
    if (deviation < known) best = {sheet.apex, deviation};
  }
  if (std::isinf(best.bound)) {
    if (on.size() <= 3) propose(on);
    if (on.size() > 1)
      for (const Surface* surface : on) propose({surface});
    if (on.size() > 2)
      for (std::size_t i = 0; i < on.size(); ++i)
        for (std::size_t j = i + 1; j < on.size(); ++j) propose({on[i], on[j]});
  }
  // A fan that folds is as near, but it looks wrong: an apex that sees its whole loop may be a little farther off.
  if (std::isfinite(best.bound) && !unfolded(loop, best.apex, u))
    for (const Vec3& apex : seeing_places(sheet, loop, inside)) {
      const double enough = best.bound / much_better + 1e-15;
      const double deviation = unfolded(loop, apex, u) ? deviation_below(apex, enough) : infinity;
      if (!(deviation < enough)) continue;
      best = {apex, deviation};
      break;
    }
  best.flat_bound = best.bound;
  double farthest = best.bound;
  const double steepest = std::isfinite(farthest) ? graph.steepness(inflated(around, Vec3::Constant(sheet.high) + sheet.high * u.cwiseAbs())) : 0;
  for (std::size_t k = 0; k < loop.size() && std::isfinite(farthest); ++k)
    if (sways[k].by + gap > 0) farthest = std::max(farthest, graph.beside(loop[k], loop[(k + 1) % loop.size()], best.bound, sways[k], gap, steepest));
  best.bound = farthest;
  return best;
}

}  // namespace starcell
