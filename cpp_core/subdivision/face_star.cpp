#include "subdivision/face_star.h"

#include <algorithm>
#include <cmath>

#include "subdivision/face_join.h"
#include "subdivision/graph_shape.h"

namespace starcell {
namespace {

// Where three curves nearly meet in a point of the face, their corners are that much nearer to each other than the face is large.
constexpr int max_splits = 10;
// Chords may take this share of the error before they are bent, this often.
constexpr double sway_share = 0.25;
constexpr int most_bendings = 3;

// A flip as a class sees it: its place across u, enclosed.
struct End {
  const Flip* flip;
  std::size_t patch;
  double low, high;
};

class FaceStar {
 public:
  FaceStar(const Restriction& restriction, const Patches& patches, RimLines& rims, double error, Statistics& statistics)
      : grid_(restriction.grid()), patches_(patches), rims_(rims), error_(error), statistics_(statistics) {}

  std::optional<std::vector<Arc>> trace(const Face& face, int splits) {
    const Box3 box(grid_.point(face.corner(0, 0)), grid_.point(face.corner(1, 1)));
    PatchView view(patches_, box);
    if (view.constant()) return std::vector<Arc>{};
    auto classes = view.seen_classes(face.axis, statistics_);
    if (!classes && view.compare_threes()) {
      if (view.constant()) return std::vector<Arc>{};
      classes = view.seen_classes(face.axis, statistics_);
    }
    if (classes)
      if (auto arcs = pair(face, *classes)) {
        count(statistics_.face_star);
        return arcs;
      }
    if (splits >= max_splits || face.size < 2) return std::nullopt;
    return split(face, splits);
  }

 private:
  std::optional<std::vector<Arc>> pair(const Face& face, const std::vector<PatchClass>& classes) {
    const auto flips = rims_.around(face);
    if (!flips) return std::nullopt;
    std::vector<std::vector<End>> ends(classes.size());
    for (const Flip& flip : *flips) {
      const Crossing& x = flip.crossing;
      const auto vanishing = patches_.vanishing(x.surface, x.axis, flip.low, flip.high, place_of(x, grid_));
      // The one class with a patch that the flip can be on.
      std::size_t at = classes.size(), on = max_patches;
      for (std::size_t k = 0; k < classes.size(); ++k)
        for (const std::size_t patch : classes[k].patches)
          if (std::find(vanishing.begin(), vanishing.end(), patch) != vanishing.end()) {
            if (at != classes.size() && at != k) return std::nullopt;
            at = k;
            on = on == max_patches ? patch : nearer(place_of(x, grid_), on, patch);
          }
      if (at == classes.size()) return std::nullopt;
      ends[at].push_back(end_of(flip, on, face, classes[at].direction));
    }
    std::vector<Arc> arcs;
    for (std::size_t k = 0; k < classes.size(); ++k)
      if (!pair_class(face, classes[k], ends[k], arcs)) return std::nullopt;
    return arcs;
  }

  std::size_t nearer(const Vec3& p, std::size_t k, std::size_t l) const {
    return std::abs(patches_.at(l).value(p)) < std::abs(patches_.at(k).value(p)) ? l : k;
  }

  // Arcs run with the solid on their right, seen from +axis: so that u, which leaves it, is on their left.
  Vec3 forward(const Face& face, const Vec3& u) const {
    Vec3 t = Vec3::Zero();
    t[face.b_axis()] = u[face.c_axis()];
    t[face.c_axis()] = -u[face.b_axis()];
    return t;
  }

  End end_of(const Flip& flip, std::size_t patch, const Face& face, const Vec3& u) const {
    const Vec3 t = forward(face, u), p = place_of(flip.crossing, grid_);
    const int other = flip.crossing.axis == face.b_axis() ? face.c_axis() : face.b_axis();
    const Rounding rounding;
    const Interval at = Interval(t[flip.crossing.axis]) * Interval(flip.low, flip.high) + Interval(t[other]) * p[other];
    return {&flip, patch, at.lower(), at.upper()};
  }

  bool pair_class(const Face& face, const PatchClass& c, std::vector<End>& ends, std::vector<Arc>& arcs) {
    if (ends.size() % 2 != 0) return false;
    std::sort(ends.begin(), ends.end(), [](const End& x, const End& y) { return x.low + x.high < y.low + y.high; });
    // Which of an arc's two ends comes first need not be certain, their difference from the next arc's has to be.
    for (std::size_t k = 2; k < ends.size(); k += 2)
      for (const std::size_t before : {k - 2, k - 1})
        for (const std::size_t after : {k, k + 1})
          if (!(ends[before].high < ends[after].low)) return false;
    for (std::size_t k = 0; k < ends.size(); k += 2) {
      if (ends[k].flip->enters == ends[k + 1].flip->enters) return false;
      const bool swapped = !ends[k].flip->enters;
      arcs.push_back(arc_between(face, c, swapped ? ends[k + 1] : ends[k], swapped ? ends[k] : ends[k + 1]));
      if (!std::isinf(error_) && !(arcs.back().sway <= error_)) return false;
    }
    return true;
  }

  Arc arc_between(const Face& face, const PatchClass& c, const End& start, const End& end) const {
    const Vec3& u = c.direction;
    Arc arc;
    arc.start = start.flip->crossing;
    arc.end = end.flip->crossing;
    arc.start.patch = static_cast<std::uint8_t>(start.patch);
    arc.end.patch = static_cast<std::uint8_t>(end.patch);
    const Vec3 p = place_of(start.flip->crossing, grid_), q = place_of(end.flip->crossing, grid_);
    arc.surfaces = {plane_or_none(start.patch)};
    arc.along = u;
    const Vec3 t = forward(face, u);
    if (start.patch != end.patch) {
      const Vec3 corner = common_place({&patches_.at(start.patch), &patches_.at(end.patch)}, 0.5 * (p + q), face.axis);
      const bool between = t.dot(corner - p) > 1e-9 * (q - p).norm() && t.dot(q - corner) > 1e-9 * (q - p).norm();
      if (between && inside(face, corner)) {
        arc.bends.push_back(corner);
        arc.surfaces.push_back(plane_or_none(end.patch));
      } else {
        arc.surfaces[0] = no_surface;
      }
    }
    if (arc.bends.empty() && start.flip->side == end.flip->side) {
      // A chord would lie on the edge: bend it to where the curve is farthest from it, or about there.
      Vec3 bend = common_place({&patches_.at(start.patch)}, 0.5 * (p + q), face.axis);
      if (!inside(face, bend)) {
        const int across = start.flip->side < 2 ? face.b_axis() : face.c_axis();
        bend = 0.5 * (p + q);
        bend[across] += (start.flip->side % 2 ? -1 : 1) * std::min(0.25 * (q - p).norm(), 0.25 * grid_.length(face.size));
      }
      arc.bends.push_back(bend);
      arc.surfaces = {no_surface, no_surface};
    }
    if (std::isinf(error_)) return arc;
    sway_little(face, c, u, p, q, arc);
    // Whatever it is, E's arc and the polyline are both on the face.
    if (const double diagonal = grid_.length(face.size) * 1.4142136; !(arc.sway <= diagonal)) arc.sway = diagonal, arc.along = Vec3::Zero();
    return arc;
  }

  std::uint32_t plane_or_none(std::size_t patch) const {
    return patches_.plane(patch);   // no_surface, if it is none
  }

  bool inside(const Face& face, const Vec3& p) const {
    const double margin = grid_.margin(face.size);
    const Vec3 low = grid_.point(face.corner(0, 0)), high = grid_.point(face.corner(1, 1));
    for (const int axis : {face.b_axis(), face.c_axis()})
      if (!(p[axis] >= low[axis] + margin && p[axis] <= high[axis] - margin)) return false;
    return true;
  }

  // Bends on the curve, as long as the chords between them sway much.
  void sway_little(const Face& face, const PatchClass& c, const Vec3& u, const Vec3& p, const Vec3& q, Arc& arc) const {
    arc.sway = sway_of(face, c, u, p, arc.bends, q);
    for (int round = 0; round < most_bendings && arc.sway > sway_share * error_; ++round) {
      Arc finer = arc;
      finer.bends.clear();
      finer.surfaces.clear();
      Vec3 from = p;
      for (std::size_t k = 0; k <= arc.bends.size(); ++k) {
        const Vec3& to = k < arc.bends.size() ? arc.bends[k] : q;
        if (const auto bend = between(face, c, u, from, to)) finer.bends.push_back(*bend), finer.surfaces.push_back(arc.surfaces[k]);
        if (k < arc.bends.size()) finer.bends.push_back(to);
        finer.surfaces.push_back(arc.surfaces[k]);
        from = to;
      }
      finer.sway = sway_of(face, c, u, p, finer.bends, q);
      if (!(finer.sway < arc.sway)) return;
      arc = std::move(finer);
    }
  }

  // A point of one of the class's curves over the middle of a chord, the one nearest to the chord.
  std::optional<Vec3> between(const Face& face, const PatchClass& c, const Vec3& u, const Vec3& p, const Vec3& q) const {
    const Vec3 t = forward(face, u);
    std::optional<Vec3> best;
    for (const std::size_t k : c.patches) {
      const Vec3 bend = common_place({&patches_.at(k)}, 0.5 * (p + q), face.axis);
      if (!inside(face, bend) || !(t.dot(bend - p) > 0.1 * t.dot(q - p)) || !(t.dot(q - bend) > 0.1 * t.dot(q - p))) continue;
      if (!best || (bend - 0.5 * (p + q)).norm() < (*best - 0.5 * (p + q)).norm()) best = bend;
    }
    return best;
  }

  double sway_of(const Face& face, const PatchClass& c, const Vec3& u, const Vec3& p, const std::vector<Vec3>& bends, const Vec3& q) const {
    const double room = room_around(grid_.length(face.size), error_);
    double sway = 0;
    Vec3 from = p;
    for (std::size_t k = 0; k <= bends.size(); ++k) {
      const Vec3& to = k < bends.size() ? bends[k] : q;
      sway = std::max(sway, segment_deviation(patches_, c, u, room, from, to));
      from = to;
    }
    return sway;
  }

  std::optional<std::vector<Arc>> split(const Face& face, int splits) {
    std::vector<Arc> parts;
    for (int quarter = 0; quarter < 4; ++quarter) {
      auto arcs = trace(face.quarter(quarter), splits + 1);
      if (!arcs) return std::nullopt;
      parts.insert(parts.end(), std::make_move_iterator(arcs->begin()), std::make_move_iterator(arcs->end()));
    }
    count(statistics_.face_split);
    return join_arcs(std::move(parts), &grid_);
  }

  const Grid& grid_;
  const Patches& patches_;
  RimLines& rims_;
  const double error_;
  Statistics& statistics_;
};

}  // namespace

std::optional<std::vector<Arc>> star_face(const Restriction& restriction, const Patches& patches, RimLines& rims, const Face& face,
                                          double error, Statistics& statistics) {
  return FaceStar(restriction, patches, rims, error, statistics).trace(face, 0);
}

}  // namespace starcell
