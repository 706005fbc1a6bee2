#include "subdivision/face_graph.h"

#include <algorithm>
#include <cmath>

#include "numerics/interval.h"
#include "subdivision/guard.h"

namespace starcell {
namespace {

// A flip's place across u, enclosed.
struct End {
  const Flip* flip;
  double low, high;
};

class FaceGraph {
 public:
  FaceGraph(const Restriction& restriction, const std::vector<Piece>& pieces, const Face& face, const Vec3& u, double error)
      : table_(restriction.table()), grid_(restriction.grid()), pieces_(pieces), face_(face), u_(u), error_(error), low_(grid_.point(face.corner(0, 0))) {
    // Arcs run with the solid on their right, seen from +axis: so that u, which leaves it, is on their left.
    t_ = Vec3::Zero();
    t_[face.b_axis()] = u[face.c_axis()];
    t_[face.c_axis()] = -u[face.b_axis()];
  }

  std::optional<std::vector<Arc>> pair(const std::vector<Flip>& flips) const {
    std::vector<End> ends;
    for (const Flip& flip : flips) ends.push_back(end_of(flip));
    if (ends.size() % 2 != 0) return std::nullopt;
    std::sort(ends.begin(), ends.end(), [](const End& x, const End& y) { return x.low + x.high < y.low + y.high; });
    // Which of an arc's two ends comes first need not be certain, their difference from the next arc's has to be.
    for (std::size_t k = 2; k < ends.size(); k += 2)
      for (const std::size_t before : {k - 2, k - 1})
        for (const std::size_t after : {k, k + 1})
          if (!(ends[before].high < ends[after].low)) return std::nullopt;
    std::vector<Arc> arcs;
    for (std::size_t k = 0; k < ends.size(); k += 2) {
      if (ends[k].flip->enters == ends[k + 1].flip->enters) return std::nullopt;
      const bool swapped = !ends[k].flip->enters;
      arcs.push_back(arc_between(*(swapped ? ends[k + 1] : ends[k]).flip, *(swapped ? ends[k] : ends[k + 1]).flip));
      if (!std::isinf(error_) && !(arcs.back().sway <= error_)) return std::nullopt;
    }
    return arcs;
  }

 private:
  End end_of(const Flip& flip) const {
    const Vec3 p = place_of(flip.crossing, grid_);
    const int other = flip.crossing.axis == face_.b_axis() ? face_.c_axis() : face_.b_axis();
    const Rounding rounding;
    const Interval at = Interval(t_[flip.crossing.axis]) * Interval(flip.low, flip.high) + Interval(t_[other]) * p[other];
    return {&flip, at.lower(), at.upper()};
  }

  Arc arc_between(const Flip& start, const Flip& end) const {
    Arc arc;
    arc.start = start.crossing;
    arc.end = end.crossing;
    arc.along = u_;
    arc.surfaces = {no_surface};
    const Vec3 p = place_of(start.crossing, grid_), q = place_of(end.crossing, grid_);
    std::vector<Vec3> polyline{p, q};
    if (start.side == end.side) {
      // A chord would lie on the edge: bend it into the face.
      const int across = start.side < 2 ? face_.b_axis() : face_.c_axis();
      Vec3 bend = 0.5 * (p + q);
      bend[across] += (start.side % 2 ? -1 : 1) * std::min(0.25 * (q - p).norm(), 0.25 * grid_.length(face_.size));
      arc.bends.push_back(bend);
      arc.surfaces.push_back(no_surface);
      polyline.insert(polyline.begin() + 1, bend);
    }
    if (!std::isinf(error_)) arc.sway = sway_of(polyline);
    return arc;
  }

  double across(const Vec3& x) const { return t_.dot(x - low_); }
  double height(const Vec3& x) const { return u_.dot(x - low_); }

  // The largest difference of heights between the polyline, which runs along t, and the pieces over it.
  double sway_of(const std::vector<Vec3>& polyline) const {
    double sway = 0;
    for (std::size_t k = 0; k + 1 < polyline.size(); ++k) {
      const double from = across(polyline[k]), to = across(polyline[k + 1]);
      // The bend that keeps off the edge may leave the polyline no graph: then all of the face is as far as it gets.
      if (!(from < to)) return polyline.size() == 2 ? 1e-9 * grid_.length(face_.size) : 1.5 * grid_.length(face_.size);
      const double start = height(polyline[k]), slope = (height(polyline[k + 1]) - start) / (to - from);
      for (const Piece& piece : pieces_) {
        const auto [a, b] = segment_of(piece.facet);
        double s = across(a), e = across(b);
        double hs = height(a), he = height(b);
        if (s > e) std::swap(s, e), std::swap(hs, he);
        if (e < from || s > to || !(s < e)) continue;
        for (const double at : {std::max(s, from), std::min(e, to)}) {
          const double h = hs + (he - hs) * (at - s) / (e - s);
          sway = std::max(sway, std::abs(h - (start + slope * (at - from))));
        }
      }
    }
    return sway + 1e-12 * (low_.cwiseAbs().maxCoeff() + grid_.length(face_.size));
  }

  // Where a facet cuts the face's plane.
  std::pair<Vec3, Vec3> segment_of(std::uint32_t facet) const {
    std::array<Vec3, 2> ends{low_, low_};
    int found = 0;
    const int a = face_.axis;
    for (int k = 0; k < 3 && found < 2; ++k) {
      const Vec3 &p = table_.corner(facet, k), &q = table_.corner(facet, (k + 1) % 3);
      if ((p[a] <= low_[a]) == (q[a] <= low_[a])) continue;
      ends[found++] = p + (low_[a] - p[a]) / (q[a] - p[a]) * (q - p);
    }
    return {ends[0], ends[1]};
  }

  const FacetTable& table_;
  const Grid& grid_;
  const std::vector<Piece>& pieces_;
  const Face& face_;
  const Vec3 u_;
  const double error_;
  const Vec3 low_;
  Vec3 t_;
};

}  // namespace

std::optional<std::vector<Arc>> graph_face(const Restriction& restriction, const CellProblem& problem, const std::vector<Piece>& pieces, RimLines& rims,
                                           const Face& face, double error, Statistics& statistics) {
  if (problem.slots() != 1 || problem.candidates(restriction.table()) == 0) return std::nullopt;
  const bool turned = problem.expression.value(0);
  std::vector<OrientedFacet> facets;
  for (const Piece& piece : pieces) {
    // Facets of both senses may share a surface, and it flips as a whole.
    if (restriction.table().surfaces[piece.surface].shared) return std::nullopt;
    facets.push_back({piece.facet, turned});
  }
  const auto u = find_direction(restriction.table(), facets, face.axis, statistics);
  if (!u) return std::nullopt;
  const auto flips = rims.around(face);
  if (!flips) return std::nullopt;
  auto arcs = FaceGraph(restriction, pieces, face, *u, error).pair(*flips);
  if (arcs) count(statistics.face_star);
  return arcs;
}

}  // namespace starcell
