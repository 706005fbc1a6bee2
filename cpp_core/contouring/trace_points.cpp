#include "contouring/trace_points.h"

#include <algorithm>
#include <cmath>

#include "contouring/surface_mesh.h"
#include "numerics/predicates.h"

namespace starcell {
namespace {

double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length = d.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(d) / length, 0.0, 1.0) : 0.0;
  return (a + t * d - p).norm();
}

// Keeps the bends that matter (Douglas & Peucker 1973). A run is only replaced by its chord if it advances along it, so
// that the distance found is a Fréchet distance.
void thin(const std::vector<Vec3>& points, std::size_t first, std::size_t last, double tolerance,
          std::vector<bool>& keep, double& gap) {
  if (last <= first + 1) return;
  const Vec3 along = points[last] - points[first];
  double worst = 0;
  std::size_t at = first + 1;
  bool monotone = true;
  for (std::size_t k = first; k < last; ++k) monotone = monotone && (points[k + 1] - points[k]).dot(along) >= 0;
  for (std::size_t k = first + 1; k < last; ++k) {
    const double d = segment_distance(points[k], points[first], points[last]);
    if (d > worst) worst = d, at = k;
  }
  if (monotone && worst <= tolerance) {
    gap = std::max(gap, worst);
    return;
  }
  keep[at] = true;
  thin(points, first, at, tolerance, keep, gap);
  thin(points, at, last, tolerance, keep, gap);
}

bool on_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

// Do two segments meet? Exact; the caller passes no segments that share an end.
bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
    return false;
  const int abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && on_segment(c, a, b)) || (abd == 0 && on_segment(d, a, b)) || (cda == 0 && on_segment(a, c, d)) ||
         (cdb == 0 && on_segment(b, c, d));
}

// Two segments with a common end: do they meet anywhere else?
bool segments_fold(const Vec2& common, const Vec2& a, const Vec2& b) {
  if (turn(common, a, b) != 0) return false;
  return (a.x - common.x) * (b.x - common.x) > 0 || (a.y - common.y) * (b.y - common.y) > 0;
}

}  // namespace

void TracePoints::announce(const Arc& arc) {
  if (arc.closed) return;
  crossings_.push_back(arc.start);
  crossings_.push_back(arc.end);
}

void TracePoints::place() {
  std::sort(crossings_.begin(), crossings_.end());
  std::size_t kept = 0;
  for (const Crossing& x : crossings_) {
    if (kept > 0 && crossings_[kept - 1] == x) {
      // Known from edges of several sizes: it lies in all of them.
      Crossing& known = crossings_[kept - 1];
      known.low = std::max(known.low, x.low);
      known.high = std::min(known.high, x.high);
    } else {
      crossings_[kept++] = x;
    }
  }
  crossings_.resize(kept);
  moved_.assign(kept, 0);
  const Grid& grid = restriction_.grid();
  std::vector<std::size_t> order;
  for (std::size_t first = 0; first < kept;) {
    std::size_t last = first;
    order.clear();
    const Crossing& line = crossings_[first];
    while (last < kept && crossings_[last].axis == line.axis && crossings_[last].i == line.i && crossings_[last].j == line.j)
      order.push_back(last++);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const Crossing &x = crossings_[a], &y = crossings_[b];
      if (x.low != y.low) return x.low < y.low;
      if (x.at != y.at) return x.at < y.at;
      return x.surface < y.surface;
    });
    const auto margin_of = [&](const Crossing& x) { return relaxed_.touch(x) ? grid.least_gap() : grid.margin(x.high - x.low); };
    const auto gap_of = [&](const Crossing& x) { return relaxed_.touch(x) ? grid.least_gap() : grid.gap(x.high - x.low); };
    const auto gap = [&](std::size_t k) { return std::min(gap_of(crossings_[order[k]]), gap_of(crossings_[order[k + 1]])); };
    const auto limits = [&](const Crossing& x) {
      const double margin = margin_of(x);
      return std::pair(grid.coordinate(x.axis, x.low) + margin, grid.coordinate(x.axis, x.high) - margin);
    };
    std::vector<double> at(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Crossing& x = crossings_[order[k]];
      const auto [low, high] = limits(x);
      at[k] = std::clamp(x.at, low, std::max(low, high));
      if (k > 0) at[k] = std::max(at[k], at[k - 1] + gap(k - 1));
    }
    for (std::size_t k = order.size(); k-- > 0;) {
      double bound = limits(crossings_[order[k]]).second;
      if (k + 1 < order.size()) bound = std::min(bound, at[k + 1] - gap(k));
      at[k] = std::min(at[k], bound);
    }
    for (std::size_t k = 0; k < order.size(); ++k) {
      moved_[order[k]] = at[k] - crossings_[order[k]].at;
      crossings_[order[k]].at = at[k];
    }
    first = last;
  }
  for (const Crossing& x : crossings_) {
    Vec3 p;
    p[x.axis] = x.at;
    p[(x.axis + 1) % 3] = grid.coordinate((x.axis + 1) % 3, x.i);
    p[(x.axis + 2) % 3] = grid.coordinate((x.axis + 2) % 3, x.j);
    vertices_.push_back(p);
  }
}

std::uint32_t TracePoints::vertex_of(const Crossing& x) const {
  return static_cast<std::uint32_t>(std::lower_bound(crossings_.begin(), crossings_.end(), x) - crossings_.begin());
}

double TracePoints::margin_of(const Face& face) const {
  return relaxed_.touch(face) ? restriction_.grid().least_gap() : restriction_.grid().margin(face.size);
}

Vec3 TracePoints::move_of(const Crossing& x) const {
  Vec3 move = Vec3::Zero();
  move[x.axis] = moved_[vertex_of(x)];
  return move;
}

void TracePoints::draw_arc(const Face& face, const Arc& arc, const std::vector<std::size_t>& kept, TracedArc& drawn) {
  const Grid& grid = restriction_.grid();
  const std::uint32_t start = vertex_of(arc.start), end = vertex_of(arc.end);
  drawn.vertices.push_back(start);
  std::size_t previous = 0;
  const double margin = margin_of(face);
  const double exact = 1e-12 * std::max(vertices_[start].cwiseAbs().maxCoeff(), grid.unit);
  std::vector<double> moves{std::abs(moved_[start])};
  for (const std::size_t bend : kept) {
    Vec3 p = arc.bends[bend];
    const Vec3 low = grid.point(face.corner(0, 0)), high = grid.point(face.corner(1, 1));
    for (const int axis : {face.b_axis(), face.c_axis()})
      p[axis] = std::clamp(p[axis], low[axis] + margin, high[axis] - margin);
    moves.push_back((p - arc.bends[bend]).norm());
    drawn.surfaces.push_back(bend == previous ? arc.surfaces[bend] : no_surface);
    previous = bend + 1;
    drawn.vertices.push_back(static_cast<std::uint32_t>(vertices_.size()));
    vertices_.push_back(p);
  }
  drawn.surfaces.push_back(previous == arc.bends.size() ? arc.surfaces.back() : no_surface);
  drawn.vertices.push_back(end);
  moves.push_back(std::abs(moved_[end]));
  double moved = 0;
  for (std::size_t k = 0; k < drawn.surfaces.size(); ++k) {
    if (moves[k] > exact || moves[k + 1] > exact || arc.contact) drawn.surfaces[k] = no_surface;
    moved = std::max({moved, moves[k], moves[k + 1]});
  }
  drawn.gap += moved;
}

// A closed curve keeps all its bends, unless float32 could not: then a triangle around its middle stands for it, wide enough
// that nothing that is moved less than the margin can have passed over that middle.
bool TracePoints::draw_closed(const Face& face, const Arc& arc, TracedArc& drawn) {
  const Grid& grid = restriction_.grid();
  const int b = face.b_axis(), c = face.c_axis();
  const double margin = margin_of(face);
  const Vec3 low = grid.point(face.corner(0, 0)), high = grid.point(face.corner(1, 1));
  Box3 box;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : arc.bends) box.extend(p), middle += p / static_cast<double>(arc.bends.size());
  const double extent = box.sizes().maxCoeff();
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  if (extent >= 8 * margin) {
    for (const Vec3& bend : arc.bends) {
      Vec3 p = bend;
      for (const int axis : {b, c}) p[axis] = std::clamp(p[axis], low[axis] + margin, high[axis] - margin);
      drawn.gap = std::max(drawn.gap, (p - bend).norm());
      vertices_.push_back(p);
    }
    drawn.surfaces = arc.surfaces;
  } else {
    double area = 0;
    for (std::size_t k = 0; k < arc.bends.size(); ++k) {
      const Vec3 p = arc.bends[k] - middle, q = arc.bends[(k + 1) % arc.bends.size()] - middle;
      area += p[b] * q[c] - p[c] * q[b];
    }
    // So small that rounding of its bends could have turned it around: its cells are split.
    if (extent < 1e-11 * box.max().cwiseAbs().maxCoeff() || std::abs(area) < 1e-6 * extent * extent) return false;
    const double radius = 4 * margin;
    for (const int axis : {b, c})
      middle[axis] = std::clamp(middle[axis], low[axis] + radius + margin, high[axis] - radius - margin);
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * 3.141592653589793 / 3 * (area > 0 ? k : -k) + 0.4;
      Vec3 p = middle;
      p[b] += radius * std::cos(angle);
      p[c] += radius * std::sin(angle);
      vertices_.push_back(p);
    }
    drawn.gap = 2 * (extent + radius + margin);
    drawn.surfaces.assign(3, no_surface);
  }
  for (auto v = first; v < vertices_.size(); ++v) drawn.vertices.push_back(v);
  drawn.vertices.push_back(first);
  if (drawn.gap > 1e-12 * std::max(box.max().cwiseAbs().maxCoeff(), grid.unit))
    std::fill(drawn.surfaces.begin(), drawn.surfaces.end(), no_surface);
  return true;
}

bool TracePoints::draw(const Face& face, const std::vector<const Arc*>& arcs, double tolerance,
                       std::vector<TracedArc>& drawn) {
  const std::size_t vertices_before = vertices_.size();
  // Beside a closed curve nothing may be moved far: it could come to lie on the other side of an arc.
  const bool any_closed = std::any_of(arcs.begin(), arcs.end(), [](const Arc* a) { return a->closed; });
  if (any_closed) tolerance = 0;
  // With all bends that matter; if those do not keep apart after rounding, with as few as possible.
  for (const bool coarse : {false, true}) {
    if (coarse && any_closed) return false;
    drawn.assign(arcs.size(), TracedArc{});
    vertices_.resize(vertices_before);
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      const Arc& arc = *arcs[a];
      if (arc.closed) {
        if (!draw_closed(face, arc, drawn[a])) return false;
        continue;
      }
      std::vector<Vec3> points{vertices_[vertex_of(arc.start)]};
      points.insert(points.end(), arc.bends.begin(), arc.bends.end());
      points.push_back(vertices_[vertex_of(arc.end)]);
      std::vector<bool> keep(points.size(), !coarse && tolerance == 0);
      if (coarse || tolerance > 0)
        thin(points, 0, points.size() - 1, coarse ? 1e300 : tolerance, keep, drawn[a].gap);
      // Both ends on one edge: the chord would lie on the edge.
      const bool same_edge = arc.start.axis == arc.end.axis && arc.start.i == arc.end.i && arc.start.j == arc.end.j;
      if (same_edge && std::none_of(keep.begin() + 1, keep.end() - 1, [](bool k) { return k; }) && !arc.bends.empty()) {
        std::size_t far = 1;
        for (std::size_t k = 2; k + 1 < points.size(); ++k)
          if (segment_distance(points[k], points.front(), points.back()) >
              segment_distance(points[far], points.front(), points.back()))
            far = k;
        keep[far] = true;
      }
      std::vector<std::size_t> kept;
      for (std::size_t k = 1; k + 1 < points.size(); ++k)
        if (keep[k]) kept.push_back(k - 1);
      draw_arc(face, arc, kept, drawn[a]);
    }
    if (disjoint(face, drawn, false) && (!restriction_.grid().holds_floats(face.size) || relaxed_.touch(face) || disjoint(face, drawn, true))) return true;
  }
  return false;
}

bool TracePoints::disjoint(const Face& face, const std::vector<TracedArc>& arcs, bool rounded) const {
  struct Segment {
    Vec2 p, q;
    std::size_t arc, index;
  };
  std::vector<Segment> segments;
  for (std::size_t a = 0; a < arcs.size(); ++a)
    for (std::size_t k = 0; k + 1 < arcs[a].vertices.size(); ++k) {
      const Vec3 p = vertices_[arcs[a].vertices[k]], q = vertices_[arcs[a].vertices[k + 1]];
      segments.push_back({project(rounded ? to_float(p) : p, face.axis), project(rounded ? to_float(q) : q, face.axis), a, k});
    }
  if (segments.size() == 1) return true;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (segments[s].p.x == segments[s].q.x && segments[s].p.y == segments[s].q.y) return false;
    for (std::size_t t = s + 1; t < segments.size(); ++t) {
      const Segment &x = segments[s], &y = segments[t];
      if (x.arc == y.arc && y.index == x.index + 1) {
        if (segments_fold(x.q, x.p, y.q)) return false;
      } else if (x.arc == y.arc && x.index == 0 && y.index + 2 == arcs[x.arc].vertices.size() && arcs[x.arc].closed()) {
        if (segments_fold(x.p, x.q, y.p)) return false;
      } else if (segments_meet(x.p, x.q, y.p, y.q)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace starcell
