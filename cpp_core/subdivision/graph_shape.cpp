#include "subdivision/graph_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "numerics/linear_program.h"

namespace starcell {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Slopes are looked at in parts where they vary much: of a segment beside which E's loop runs, of a piece (halved this often).
constexpr int pieces = 4;
constexpr int most_parts = 2;
constexpr double much_better = 0.7;

Box3 inflated(const Box3& box, const Vec3& by) { return {box.min() - by, box.max() + by}; }

// An expansion over a box whose middle is rounded: a little more than the box. Needs a Rounding object.
Expansion over(const Surface& surface, const Box3& box) {
  const double rounded = 1e-15 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return surface.expand(box.center(), 0.5 * box.sizes() + Vec3::Constant(rounded));
}

// The smallest lift at which E's logic says what is wanted, given the lifts from which each patch is certainly passed.
double least_lift(const std::vector<double>& passed, const std::vector<double>& senses, std::uint64_t value, bool outside) {
  const std::size_t n = passed.size();
  std::vector<double> steps = passed;
  steps.push_back(0);
  std::sort(steps.begin(), steps.end());
  for (const double lift : steps) {
    if (std::isinf(lift)) break;
    bool holds = true;
    for (std::size_t a = 0; a < std::size_t{1} << n && holds; ++a) {
      bool possible = true;   // may the lifted piece be on these sides?
      for (std::size_t k = 0; k < n && possible; ++k)
        if (passed[k] <= lift) possible = ((a >> k & 1) != 0) == ((senses[k] > 0) != outside);
      holds = !possible || ((value >> a & 1) != 0) != outside;
    }
    if (holds) return lift;
  }
  return infinity;
}

class Graph {
 public:
  Graph(const FacetTable& table, const std::vector<std::uint32_t>& surfaces, const std::vector<double>& senses, std::uint64_t value, const Vec3& u,
        double room)
      : senses_(senses), value_(value), u_(u), room_(room) {
    for (const std::uint32_t id : surfaces) surfaces_.push_back(&table.surfaces[id]);
  }

  // F at a point, turned as E is, per surface.
  std::vector<Interval> heights(const Vec3& p) const {
    const Rounding rounding;
    std::vector<Interval> result;
    for (std::size_t k = 0; k < surfaces_.size(); ++k) result.push_back(senses_[k] * surfaces_[k]->expand(p, Vec3::Zero()).value);
    return result;
  }

  // The deviation of a piece with these corners; infinite beyond the room. Slopes are those that the lift sweeps: the less it is
  // lifted, the less they vary.
  double deviation(const std::vector<const std::vector<Interval>*>& heights, const std::vector<Vec3>& corners) const {
    const Box3 box = box_around(corners);
    std::vector<Interval> above, below;   // how far F may be from where the piece has passed it
    {
      const Rounding rounding;
      for (std::size_t k = 0; k < surfaces_.size(); ++k) {
        const Expansion e = over(*surfaces_[k], box);
        const Interval excess = senses_[k] * (corners.size() == 3 ? e.excess(corners[0], corners[1], corners[2]) : e.excess(corners[0], corners[1]));
        double least = infinity, most = -infinity;
        for (const auto* height : heights) {
          least = std::min(least, (*height)[k].lower());
          most = std::max(most, (*height)[k].upper());
        }
        above.push_back(Interval(excess.upper()) - least);
        below.push_back(Interval(most) - excess.lower());
      }
    }
    for (const double share : {0.2, 0.45, 1.0}) {
      const double lift = lift_within(share * room_, corners, above, below);
      if (lift <= share * room_) return lift;
    }
    return infinity;
  }

  // How far E's points may be that lie over the gap between a segment and E's loop beside it. Along the way between the two the
  // height differs from the segment's by `apart` where it starts, over the segment, and by the sway's own height where it ends,
  // on the loop; in between by as much as E is steep.
  double beside(const Vec3& p, const Vec3& q, double apart, const Sway& sway, double gap) const {
    const bool any = sway.along.isZero(0.0);
    const double aside = gap + sway.by * (any ? 1.0 : sway.along.cross(u_).norm() + 1e-12);
    const double at_end = gap + sway.by * (any ? 1.0 : std::abs(sway.along.dot(u_)) + 1e-12);
    double farthest = 0;
    for (int piece = 0; piece < pieces; ++piece) {
      const Vec3 from = p + (q - p) * (static_cast<double>(piece) / pieces), to = p + (q - p) * (static_cast<double>(piece + 1) / pieces);
      double height = infinity;
      for (double reach = std::max(apart, at_end); reach <= 2 * room_ && std::isinf(height); reach *= 1.4) {
        const double steep = steepness(inflated(box_around({from, to}), Vec3::Constant(aside) + reach * u_.cwiseAbs()));
        const double most = std::max({apart, at_end, 0.5 * (apart + at_end + steep * aside)});
        if (most <= reach) height = most;
      }
      farthest = std::max(farthest, std::hypot(height, aside));
    }
    return farthest;
  }

 private:
  static Box3 box_around(const std::vector<Vec3>& points) {
    Box3 box;
    for (const Vec3& p : points) box.extend(p);
    return box;
  }

  double lift_within(double room, const std::vector<Vec3>& corners, const std::vector<Interval>& above, const std::vector<Interval>& below) const {
    std::vector<double> up, down;
    {
      const Rounding rounding;
      for (std::size_t k = 0; k < surfaces_.size(); ++k) {
        const Interval slope(least_slope(k, room, corners, 0));
        if (certain_sign(slope) <= 0) return infinity;
        up.push_back(std::max(0.0, (above[k] / slope).upper()));
        down.push_back(std::max(0.0, (below[k] / slope).upper()));
      }
    }
    return std::max(least_lift(up, senses_, value_, true), least_lift(down, senses_, value_, false));
  }

  // Along u, where a piece is lifted to; large pieces in parts. Needs a Rounding object.
  double least_slope(std::size_t k, double room, const std::vector<Vec3>& corners, int depth) const {
    const Box3 box = inflated(box_around(corners), room * u_.cwiseAbs());
    const Expansion e = over(*surfaces_[k], box);
    const Interval slope = e.along(senses_[k] * u_);
    if (depth >= most_parts || slope.upper() <= 0 || slope.lower() > 0.7 * slope.upper()) return slope.lower();
    double least = infinity;
    const std::size_t n = corners.size();
    std::vector<Vec3> middles;
    for (std::size_t i = 0; i < (n == 3 ? 3 : 1); ++i) middles.push_back(0.5 * (corners[i] + corners[(i + 1) % n]));
    if (n == 2) return std::min(least_slope(k, room, {corners[0], middles[0]}, depth + 1), least_slope(k, room, {middles[0], corners[1]}, depth + 1));
    for (std::size_t i = 0; i < 3; ++i) least = std::min(least, least_slope(k, room, {corners[i], middles[i], middles[(i + 2) % 3]}, depth + 1));
    return std::min(least, least_slope(k, room, middles, depth + 1));
  }

  double steepness(const Box3& box) const {
    const Rounding rounding;
    double steepest = 0;
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
      const Expansion e = over(*surfaces_[k], box);
      const Interval3 normal = Interval(senses_[k]) * e.slope;
      const Interval along = e.along(senses_[k] * u_);
      if (certain_sign(along) <= 0) return infinity;
      steepest = std::max(steepest, (norm(normal - along * enclose(u_)) / Interval(along.lower())).upper());
    }
    return steepest;
  }

  std::vector<const Surface*> surfaces_;
  const std::vector<double> senses_;
  const std::uint64_t value_;
  const Vec3 u_;
  const double room_;
};

// Do all triangles of the fan face u?
bool unfolded(const std::vector<Vec3>& loop, const Vec3& apex, const Vec3& u) {
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (!((loop[k] - apex).cross(loop[(k + 1) % loop.size()] - apex).dot(u) > 0)) return false;
  return true;
}

// Points on the sheet's surfaces over the deepest point of the kernel of the loop's shadow, found by the small linear program.
std::vector<Vec3> seeing_places(const FacetTable& table, const Sheet& sheet, const std::vector<Vec3>& loop, const Box3& inside) {
  std::vector<Vec3> normals, places;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 outward = (loop[(k + 1) % loop.size()] - loop[k]).cross(sheet.direction);
    if (!(outward.norm() > 0)) return {};
    normals.push_back(outward.normalized());
  }
  const auto seen = deepest_point(normals, loop, inside);
  if (!seen) return {};
  for (const std::uint32_t surface : sheet.surfaces) {
    Vec3 x = *seen;
    for (int step = 0; step < 6; ++step) {   // Newton's method along the direction
      Vec3 gradient;
      const double value = table.surfaces[surface].value(x, &gradient), slope = gradient.dot(sheet.direction);
      if (slope == 0) break;
      x -= value / slope * sheet.direction;
    }
    if (x.allFinite() && inside.contains(x)) places.push_back(x);
  }
  return places;
}

std::vector<double> as_doubles(const std::vector<int>& senses) { return {senses.begin(), senses.end()}; }

}  // namespace

double room_around(double size, double error) { return std::min(0.75 * error, 0.5 * size); }

Vec3 common_place(const FacetTable& table, const std::vector<std::uint32_t>& surfaces, const Vec3& start, int flat_axis) {
  Vec3 x = start;
  for (int step = 0; step < 6; ++step) {
    Eigen::MatrixXd gradients(surfaces.size(), 3);
    Eigen::VectorXd values(surfaces.size());
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      Vec3 g;
      values[static_cast<Eigen::Index>(k)] = table.surfaces[surfaces[k]].value(x, &g);
      if (flat_axis >= 0) g[flat_axis] = 0;
      gradients.row(static_cast<Eigen::Index>(k)) = g;
    }
    // The shortest step on which the linearised surfaces all vanish.
    const Vec3 by = gradients.completeOrthogonalDecomposition().solve(values);
    if (!by.allFinite()) break;
    x -= by;
    if (by.norm() <= 1e-15 * x.norm()) break;
  }
  return x;
}

double segment_deviation(const FacetTable& table, const Patches& patches, const PatchClass& c, const Vec3& u, double room, const Vec3& p,
                         const Vec3& q) {
  std::vector<std::uint32_t> surfaces;
  for (const std::size_t k : c.patches) surfaces.push_back(patches.surface(k));
  const Graph graph(table, surfaces, as_doubles(c.sense), c.value, u, room);
  const std::vector<Interval> at_p = graph.heights(p), at_q = graph.heights(q);
  return graph.deviation({&at_p, &at_q}, {p, q});
}

Sheet graph_sheet(const Patches& patches, const PatchClass& c, const Vec3& u, double room) {
  Sheet sheet;
  sheet.shape = Sheet::Shape::graph;
  sheet.direction = u;
  sheet.high = room;
  GraphLogic logic;
  for (std::size_t i = 0; i < c.patches.size(); ++i) {
    sheet.surfaces.push_back(patches.surface(c.patches[i]));
    logic.senses.push_back(c.sense[i]);
  }
  logic.value = c.value;
  sheet.graph = std::make_shared<const GraphLogic>(std::move(logic));
  return sheet;
}

GraphFan graph_fan(const FacetTable& table, const Box3& cell, const Sheet& sheet, const std::vector<Vec3>& loop, const std::vector<Sway>& sways,
                   double gap, double margin) {
  const Vec3& u = sheet.direction;
  const double room = sheet.high;
  const Graph graph(table, sheet.surfaces, as_doubles(sheet.graph->senses), sheet.graph->value, u, room);
  Vec3 centroid = Vec3::Zero();
  for (const Vec3& p : loop) centroid += p / static_cast<double>(loop.size());
  std::vector<std::vector<Interval>> rim;
  for (const Vec3& p : loop) rim.push_back(graph.heights(p));

  std::vector<Vec3> proposals;
  if (sheet.surfaces.size() <= 3) proposals.push_back(common_place(table, sheet.surfaces, centroid));
  if (sheet.surfaces.size() > 1)
    for (const std::uint32_t surface : sheet.surfaces) proposals.push_back(common_place(table, {surface}, centroid));
  if (sheet.surfaces.size() > 2)
    for (std::size_t i = 0; i < sheet.surfaces.size(); ++i)
      for (std::size_t j = i + 1; j < sheet.surfaces.size(); ++j)
        proposals.push_back(common_place(table, {sheet.surfaces[i], sheet.surfaces[j]}, centroid));
  const Box3 inside(cell.min() + Vec3::Constant(margin), cell.max() - Vec3::Constant(margin));
  const auto deviation_below = [&](const Vec3& apex, double enough) {
    const std::vector<Interval> at_apex = graph.heights(apex);
    double deviation = 0;
    for (std::size_t k = 0; k < loop.size() && deviation < enough; ++k) {
      const std::size_t next = (k + 1) % loop.size();
      deviation = std::max(deviation, graph.deviation({&at_apex, &rim[k], &rim[next]}, {apex, loop[k], loop[next]}));
    }
    return deviation;
  };
  GraphFan best{centroid, infinity};
  for (Vec3 apex : proposals) {
    apex = apex.allFinite() ? Vec3(apex.cwiseMax(inside.min()).cwiseMin(inside.max())) : centroid;
    // The first is on all surfaces, so creases stay sharp and triangles stay on planes: others have to be much better.
    const double enough = std::isinf(best.bound) ? infinity : much_better * best.bound;
    const double deviation = deviation_below(apex, enough);
    if (deviation < enough) best = {apex, deviation};
  }
  // A fan that folds is as near, but it looks wrong: an apex that sees its whole loop may be a little farther off.
  if (std::isfinite(best.bound) && !unfolded(loop, best.apex, u))
    for (const Vec3& apex : seeing_places(table, sheet, loop, inside)) {
      const double enough = best.bound / much_better + 1e-15;
      const double deviation = unfolded(loop, apex, u) ? deviation_below(apex, enough) : infinity;
      if (!(deviation < enough)) continue;
      best = {apex, deviation};
      break;
    }
  double farthest = best.bound;
  for (std::size_t k = 0; k < loop.size() && std::isfinite(farthest); ++k)
    if (sways[k].by + gap > 0) farthest = std::max(farthest, graph.beside(loop[k], loop[(k + 1) % loop.size()], best.bound, sways[k], gap));
  best.bound = farthest;
  return best;
}

}  // namespace starcell
