#include "contouring/trace_points.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_sort.h>

#include "contouring/surface_mesh.h"
#include "numerics/predicates.h"

namespace starcell {
namespace {

// Ids from here on stand for bends that draw() has just made.
constexpr std::uint32_t first_bend = 0x80000000u;

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
  announced_.push_back(arc.start);
  announced_.push_back(arc.end);
}

void TracePoints::place() {
  tbb::parallel_sort(announced_.begin(), announced_.end());
  std::size_t kept = 0;
  for (const Crossing& x : announced_) {
    if (kept > 0 && announced_[kept - 1] == x) {
      // Known from edges of several sizes: it lies in all of them.
      Crossing& known = announced_[kept - 1];
      known.low = std::max(known.low, x.low);
      known.high = std::min(known.high, x.high);
    } else {
      announced_[kept++] = x;
    }
  }
  announced_.resize(kept);
  std::vector<double> moved(kept, 0);
  for (std::size_t first = 0; first < kept;) {
    std::size_t last = first;
    const Crossing& line = announced_[first];
    while (last < kept && announced_[last].axis == line.axis && announced_[last].i == line.i && announced_[last].j == line.j) ++last;
    place_line(announced_.data() + first, announced_.data() + last, moved.data() + first);
    first = last;
  }
  number(moved);
}

// Keeps the crossings of one line in order, apart from each other and off the ends of their edges.
void TracePoints::place_line(Crossing* first, Crossing* last, double* moved) const {
  const Grid& grid = restriction_.grid();
  std::vector<Crossing*> order;
  for (Crossing* x = first; x != last; ++x) order.push_back(x);
  std::sort(order.begin(), order.end(), [](const Crossing* x, const Crossing* y) {
    if (x->low != y->low) return x->low < y->low;
    if (x->at != y->at) return x->at < y->at;
    return x->surface < y->surface;
  });
  const auto margin_of = [&](const Crossing& x) { return relaxed_.touch(x) ? grid.least_gap() : grid.margin(x.high - x.low); };
  const auto gap_of = [&](const Crossing& x) { return relaxed_.touch(x) ? grid.least_gap() : grid.gap(x.high - x.low); };
  const auto gap = [&](std::size_t k) { return std::min(gap_of(*order[k]), gap_of(*order[k + 1])); };
  const auto limits = [&](const Crossing& x) {
    const double margin = margin_of(x);
    return std::pair(grid.coordinate(x.axis, x.low) + margin, grid.coordinate(x.axis, x.high) - margin);
  };
  std::vector<double> at(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto [low, high] = limits(*order[k]);
    at[k] = std::clamp(order[k]->at, low, std::max(low, high));
    if (k > 0) at[k] = std::max(at[k], at[k - 1] + gap(k - 1));
  }
  for (std::size_t k = order.size(); k-- > 0;) {
    double bound = limits(*order[k]).second;
    if (k + 1 < order.size()) bound = std::min(bound, at[k + 1] - gap(k));
    at[k] = std::min(at[k], bound);
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    moved[order[k] - first] = at[k] - order[k]->at;
    order[k]->at = at[k];
  }
}

// Crossings that the last round knew keep their ids.
void TracePoints::number(const std::vector<double>& moved) {
  const Grid& grid = restriction_.grid();
  for (Move& move : moves_) move.fresh = false;
  std::vector<Placed> placed;
  placed.reserve(announced_.size());
  auto known = placed_.cbegin();
  for (std::size_t k = 0; k < announced_.size(); ++k) {
    const Crossing& x = announced_[k];
    while (known != placed_.cend() && known->crossing < x) ++known;
    const bool has_id = known != placed_.cend() && known->crossing == x;
    const auto id = has_id ? known->id : static_cast<std::uint32_t>(vertices_.size());
    if (!has_id) {
      vertices_.emplace_back();
      moves_.emplace_back();
    }
    Vec3 p;
    p[x.axis] = x.at;
    p[(x.axis + 1) % 3] = grid.coordinate((x.axis + 1) % 3, x.i);
    p[(x.axis + 2) % 3] = grid.coordinate((x.axis + 2) % 3, x.j);
    moves_[id] = {moved[k], x.axis, !has_id || p != vertices_[id]};
    vertices_[id] = p;
    placed.push_back({x, id});
  }
  placed_ = std::move(placed);
  announced_ = {};
}

std::uint32_t TracePoints::vertex_of(const Crossing& x) const {
  return std::lower_bound(placed_.begin(), placed_.end(), x, [](const Placed& p, const Crossing& y) { return p.crossing < y; })->id;
}

const Vec3& TracePoints::at(const TracedFace& drawn, std::uint32_t id) const {
  return id >= first_bend ? drawn.bends[id - first_bend] : vertices_[id];
}

double TracePoints::margin_of(const Face& face) const {
  return relaxed_.touch(face) ? restriction_.grid().least_gap() : restriction_.grid().margin(face.size);
}

bool TracePoints::moved(const TracedArc& arc) const {
  if (arc.vertices.empty()) return true;  // it could not be drawn
  return moves_[arc.vertices.front()].fresh || moves_[arc.vertices.back()].fresh;
}

Vec3 TracePoints::move_of(std::uint32_t crossing) const {
  Vec3 move = Vec3::Zero();
  move[moves_[crossing].axis] = moves_[crossing].by;
  return move;
}

void TracePoints::adopt(TracedFace& face) {
  const auto base = static_cast<std::uint32_t>(vertices_.size());
  for (TracedArc& arc : face.arcs)
    for (std::uint32_t& id : arc.vertices)
      if (id >= first_bend) id = id - first_bend + base;
  vertices_.insert(vertices_.end(), face.bends.begin(), face.bends.end());
  moves_.resize(vertices_.size());
  face.bends = {};
}

void TracePoints::draw_arc(const Face& face, const Arc& arc, const std::vector<std::size_t>& kept, TracedFace& drawn,
                           TracedArc& traced) const {
  const Grid& grid = restriction_.grid();
  const std::uint32_t start = vertex_of(arc.start), end = vertex_of(arc.end);
  traced.vertices.push_back(start);
  std::size_t previous = 0;
  const double margin = margin_of(face);
  const double exact = 1e-12 * std::max(vertices_[start].cwiseAbs().maxCoeff(), grid.unit);
  std::vector<double> moves{std::abs(moves_[start].by)};
  for (const std::size_t bend : kept) {
    Vec3 p = arc.bends[bend];
    const Vec3 low = grid.point(face.corner(0, 0)), high = grid.point(face.corner(1, 1));
    for (const int axis : {face.b_axis(), face.c_axis()})
      p[axis] = std::clamp(p[axis], low[axis] + margin, high[axis] - margin);
    moves.push_back((p - arc.bends[bend]).norm());
    traced.surfaces.push_back(bend == previous ? arc.surfaces[bend] : no_surface);
    previous = bend + 1;
    traced.vertices.push_back(first_bend + static_cast<std::uint32_t>(drawn.bends.size()));
    drawn.bends.push_back(p);
  }
  traced.surfaces.push_back(previous == arc.bends.size() ? arc.surfaces.back() : no_surface);
  traced.vertices.push_back(end);
  moves.push_back(std::abs(moves_[end].by));
  double moved = 0;
  for (std::size_t k = 0; k < traced.surfaces.size(); ++k) {
    if (moves[k] > exact || moves[k + 1] > exact || arc.contact) traced.surfaces[k] = no_surface;
    moved = std::max({moved, moves[k], moves[k + 1]});
  }
  traced.gap += moved;
}

// A closed curve keeps all its bends, unless float32 could not: then a triangle around its middle stands for it, wide enough
// that nothing that is moved less than the margin can have passed over that middle.
bool TracePoints::draw_closed(const Face& face, const Arc& arc, TracedFace& drawn, TracedArc& traced) const {
  const Grid& grid = restriction_.grid();
  const int b = face.b_axis(), c = face.c_axis();
  const double margin = margin_of(face);
  const Vec3 low = grid.point(face.corner(0, 0)), high = grid.point(face.corner(1, 1));
  Box3 box;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : arc.bends) box.extend(p), middle += p / static_cast<double>(arc.bends.size());
  const double extent = box.sizes().maxCoeff();
  const auto first = drawn.bends.size();
  if (extent >= 8 * margin) {
    for (const Vec3& bend : arc.bends) {
      Vec3 p = bend;
      for (const int axis : {b, c}) p[axis] = std::clamp(p[axis], low[axis] + margin, high[axis] - margin);
      traced.gap = std::max(traced.gap, (p - bend).norm());
      drawn.bends.push_back(p);
    }
    traced.surfaces = arc.surfaces;
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
      drawn.bends.push_back(p);
    }
    traced.gap = 2 * (extent + radius + margin);
    traced.surfaces.assign(3, no_surface);
  }
  for (std::size_t k = first; k < drawn.bends.size(); ++k) traced.vertices.push_back(first_bend + static_cast<std::uint32_t>(k));
  traced.vertices.push_back(traced.vertices.front());
  if (traced.gap > 1e-12 * std::max(box.max().cwiseAbs().maxCoeff(), grid.unit))
    std::fill(traced.surfaces.begin(), traced.surfaces.end(), no_surface);
  return true;
}

TracedFace TracePoints::draw(const Face& face, const std::vector<Arc>& arcs, double tolerance) const {
  // Beside a closed curve nothing may be moved far: it could come to lie on the other side of an arc.
  const bool any_closed = std::any_of(arcs.begin(), arcs.end(), [](const Arc& a) { return a.closed; });
  if (any_closed) tolerance = 0;
  const bool floats = restriction_.grid().holds_floats(face.size) && !relaxed_.touch(face);
  // With all bends that matter; if those do not keep apart after rounding, with as few as possible.
  TracedFace drawn;
  for (const bool coarse : {false, true}) {
    if (coarse && any_closed) break;
    drawn.arcs.assign(arcs.size(), TracedArc{});
    drawn.bends.clear();
    if (!draw_arcs(face, arcs, tolerance, coarse, drawn)) break;
    drawn.drawn = disjoint(face, drawn, false) && (!floats || disjoint(face, drawn, true));
    if (drawn.drawn) break;
  }
  return drawn;
}

bool TracePoints::draw_arcs(const Face& face, const std::vector<Arc>& arcs, double tolerance, bool coarse, TracedFace& drawn) const {
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    const Arc& arc = arcs[a];
    TracedArc& traced = drawn.arcs[a];
    if (arc.closed) {
      if (!draw_closed(face, arc, drawn, traced)) return false;
      continue;
    }
    std::vector<Vec3> points{vertices_[vertex_of(arc.start)]};
    points.insert(points.end(), arc.bends.begin(), arc.bends.end());
    points.push_back(vertices_[vertex_of(arc.end)]);
    std::vector<bool> keep(points.size(), !coarse && tolerance == 0);
    if (coarse || tolerance > 0) thin(points, 0, points.size() - 1, coarse ? 1e300 : tolerance, keep, traced.gap);
    // Both ends on one edge: the chord would lie on the edge.
    const bool same_edge = arc.start.axis == arc.end.axis && arc.start.i == arc.end.i && arc.start.j == arc.end.j;
    if (same_edge && std::none_of(keep.begin() + 1, keep.end() - 1, [](bool k) { return k; }) && !arc.bends.empty()) {
      std::size_t far = 1;
      for (std::size_t k = 2; k + 1 < points.size(); ++k)
        if (segment_distance(points[k], points.front(), points.back()) > segment_distance(points[far], points.front(), points.back()))
          far = k;
      keep[far] = true;
    }
    std::vector<std::size_t> kept;
    for (std::size_t k = 1; k + 1 < points.size(); ++k)
      if (keep[k]) kept.push_back(k - 1);
    draw_arc(face, arc, kept, drawn, traced);
  }
  return true;
}

bool TracePoints::disjoint(const Face& face, const TracedFace& drawn, bool rounded) const {
  const std::vector<TracedArc>& arcs = drawn.arcs;
  struct Segment {
    Vec2 p, q;
    std::size_t arc, index;
  };
  std::vector<Segment> segments;
  for (std::size_t a = 0; a < arcs.size(); ++a)
    for (std::size_t k = 0; k + 1 < arcs[a].vertices.size(); ++k) {
      const Vec3 p = at(drawn, arcs[a].vertices[k]), q = at(drawn, arcs[a].vertices[k + 1]);
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
