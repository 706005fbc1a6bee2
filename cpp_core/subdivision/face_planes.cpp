#include "subdivision/face_planes.h"

#include <algorithm>
#include <cmath>

#include "numerics/interval.h"

namespace starcell {
namespace {

// Corner and side numbering, counter-clockwise seen from +axis: corner k is where side k begins.
// Sides as walked: 0 bottom (c low), 1 right (b high), 2 top (c high), 3 left (b low).
constexpr std::array<int, 4> side_name{2, 1, 3, 0};  // to PieceEnd's numbering

struct Line {
  std::uint32_t surface;
  Interval nb, nc, d;                    // nb b + nc c = d, relative to the face's lower corner
  int start_side = -1, end_side = -1;    // walked sides; travelling start -> end, the line's negative side is on the left
  Interval start_at, end_at;             // coordinate on that side, increasing along the walk
  int start_rank = 0, end_rank = 0;      // position around the perimeter
  std::vector<int> others;               // lines it crosses inside the face, in order from start to end
  std::vector<Membership> covered;       // others.size() + 1 sub-segments: solids that flip there
  std::vector<Membership> negative;      // membership on the negative side of each sub-segment
  std::vector<int> next;                 // +1: E runs start -> end on the sub-segment, -1: back, 0: not E
};

class Arrangement {
 public:
  explicit Arrangement(const FacePlanesInput& input) : in_(input) {}

  std::optional<std::vector<Arc>> arcs() {
    {
      const Rounding rounding;
      if (!make_lines() || !order_perimeter() || !order_crossings()) return std::nullopt;
    }
    if (!cover()) return std::nullopt;
    Membership corner = in_.restriction.mask_at(in_.problem, in_.face.corner(0, 0));
    if (!propagate(corner)) return std::nullopt;
    return chain();
  }

 private:
  bool make_lines() {
    const FacetTable& table = in_.restriction.table();
    const Grid& grid = in_.restriction.grid();
    std::vector<std::uint32_t> surfaces;
    for (const Piece& p : in_.pieces) surfaces.push_back(p.surface);
    std::sort(surfaces.begin(), surfaces.end());
    surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
    const Vec3 low = grid.point(in_.face.corner(0, 0));
    size_ = grid.unit * in_.face.size;
    low_ = low;
    for (const std::uint32_t id : surfaces) {
      const Surface& s = table.surfaces[id];
      Line line;
      line.surface = id;
      line.nb = Interval(s.normal[in_.face.b_axis()]);
      line.nc = Interval(s.normal[in_.face.c_axis()]);
      Interval dot = Interval(0.0);
      for (int k = 0; k < 3; ++k) dot += Interval(s.normal[k]) * Interval(low[k]);
      line.d = Interval(s.offset) - dot + Interval(-s.thickness, s.thickness);
      if (!find_ends(line)) return false;
      lines_.push_back(std::move(line));
    }
    return true;
  }

  // The line's sign at the four corners says which two sides it meets.
  bool find_ends(Line& line) const {
    const Interval s(size_);
    const std::array<Interval, 4> value{-line.d, line.nb * s - line.d, line.nb * s + line.nc * s - line.d,
                                        line.nc * s - line.d};
    std::array<int, 4> sign;
    for (int k = 0; k < 4; ++k) {
      sign[k] = certain_sign(value[k]);
      if (sign[k] == 0) return false;
    }
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      if (sign[k] == sign[next]) continue;
      // Along side k the line's function goes linearly from value[k] to value[next].
      const Interval at = s * value[k] / (value[k] - value[next]);
      if (sign[k] < 0)
        line.start_side = k, line.start_at = at;
      else
        line.end_side = k, line.end_at = at;
    }
    return line.start_side >= 0 && line.end_side >= 0;
  }

  bool order_perimeter() {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      ends_.push_back({lines_[i].start_side, lines_[i].start_at, static_cast<int>(i), true});
      ends_.push_back({lines_[i].end_side, lines_[i].end_at, static_cast<int>(i), false});
    }
    std::sort(ends_.begin(), ends_.end(), [](const End& x, const End& y) {
      if (x.side != y.side) return x.side < y.side;
      if (x.at.lower() != y.at.lower()) return x.at.lower() < y.at.lower();
      return x.line != y.line ? x.line < y.line : x.start < y.start;
    });
    for (std::size_t k = 0; k + 1 < ends_.size(); ++k)
      if (ends_[k].side == ends_[k + 1].side && !(ends_[k].at.upper() < ends_[k + 1].at.lower())) return false;
    for (std::size_t k = 0; k < ends_.size(); ++k)
      (ends_[k].start ? lines_[ends_[k].line].start_rank : lines_[ends_[k].line].end_rank) = static_cast<int>(k);
    return true;
  }

  bool cross(const Line& x, const Line& y) const {
    const auto between = [&](int rank) {
      return x.start_rank < x.end_rank ? x.start_rank < rank && rank < x.end_rank
                                       : rank > x.start_rank || rank < x.end_rank;
    };
    return between(y.start_rank) != between(y.end_rank);
  }

  bool intersect(const Line& x, const Line& y, Interval& b, Interval& c) const {
    const Interval det = x.nb * y.nc - x.nc * y.nb;
    if (certain_sign(det) == 0) return false;
    b = (x.d * y.nc - y.d * x.nc) / det;
    c = (x.nb * y.d - y.nb * x.d) / det;
    return true;
  }

  bool order_crossings() {
    const std::size_t n = lines_.size();
    points_.assign(n * n, Vec2i{});
    for (std::size_t i = 0; i < n; ++i) {
      Line& line = lines_[i];
      // Position along the travelling direction (-nc, nb), measured on its larger component.
      const bool along_b = std::abs(line.nc.lower()) >= std::abs(line.nb.lower());
      const double sense = along_b ? -line.nc.lower() : line.nb.lower();
      std::vector<std::pair<Interval, int>> order;
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i || !cross(line, lines_[j])) continue;
        Interval b, c;
        const std::size_t lo = std::min(i, j), hi = std::max(i, j);
        if (!intersect(lines_[lo], lines_[hi], b, c)) return false;
        points_[lo * n + hi] = {b, c};
        const Interval at = along_b ? b : c;
        order.emplace_back(sense > 0 ? at : Interval(-at), static_cast<int>(j));
      }
      std::sort(order.begin(), order.end(), [](const auto& x, const auto& y) {
        return x.first.lower() != y.first.lower() ? x.first.lower() < y.first.lower() : x.second < y.second;
      });
      for (std::size_t k = 0; k + 1 < order.size(); ++k)
        if (!(order[k].first.upper() < order[k + 1].first.lower())) return false;
      for (const auto& [at, j] : order) line.others.push_back(j);
    }
    return true;
  }

  int line_of(std::uint32_t surface) const {
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].surface == surface) return static_cast<int>(i);
    return -1;
  }

  int position(const Line& line, int other) const {
    const auto it = std::find(line.others.begin(), line.others.end(), other);
    return it == line.others.end() ? -1 : static_cast<int>(it - line.others.begin());
  }

  // Which boundary between sub-segments an end of a piece is: 0 the line's start, others.size() + 1 its end.
  int boundary(const Line& line, const PieceEnd& end) const {
    if (end.side >= 0) {
      if (end.side == side_name[line.start_side]) return 0;
      if (end.side == side_name[line.end_side]) return static_cast<int>(line.others.size()) + 1;
      return -1;
    }
    const int other = line_of(in_.restriction.table().surface[end.neighbour]);
    const int at = other < 0 ? -1 : position(line, other);
    return at < 0 ? -1 : at + 1;
  }

  bool same_surface_beyond(const Piece& p, const PieceEnd& end) const {
    return end.side < 0 && in_.restriction.table().surface[end.neighbour] == p.surface;
  }

  // Marks the sub-segments that facets cover. Coplanar neighbours are first run together.
  bool cover() {
    for (Line& line : lines_) line.covered.assign(line.others.size() + 1, 0);
    std::size_t used = 0;
    for (const Piece& first : in_.pieces) {
      if (same_surface_beyond(first, first.from)) continue;
      const Piece* last = &first;
      ++used;
      while (same_surface_beyond(*last, last->to)) {
        const auto it = std::lower_bound(in_.pieces.begin(), in_.pieces.end(), last->to.neighbour,
                                         [](const Piece& p, std::uint32_t f) { return p.facet < f; });
        if (it == in_.pieces.end() || it->facet != last->to.neighbour || ++used > in_.pieces.size()) return false;
        last = &*it;
      }
      Line& line = lines_[line_of(first.surface)];
      int from = boundary(line, first.from), to = boundary(line, last->to);
      if (from < 0 || to < 0 || from == to) return false;
      if (from > to) std::swap(from, to);
      for (int s = from; s < to; ++s) line.covered[s] ^= Membership{1} << first.slot;
    }
    return used == in_.pieces.size();
  }

  // Walks the perimeter, then every line, and learns the membership beside each sub-segment.
  bool propagate(const Membership corner) {
    Membership mask = corner;
    for (Line& line : lines_) line.negative.assign(line.others.size() + 1, 0);
    std::vector<Membership> at_end(lines_.size());
    for (const End& end : ends_) {
      Line& line = lines_[end.line];
      if (end.start) {
        line.negative.front() = mask;
        mask ^= line.covered.front();
      } else {
        mask ^= line.covered.back();
        at_end[end.line] = mask;
      }
    }
    if (mask != corner) return false;
    const LocalExpression& expression = in_.problem.expression;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      Line& line = lines_[i];
      for (std::size_t s = 0; s < line.others.size(); ++s) {
        const Line& other = lines_[line.others[s]];
        const int at = position(other, static_cast<int>(i));
        // The other line passes from this line's negative side to its positive one if it runs along this normal.
        const bool rising = -other.nc.lower() * line.nb.lower() + other.nb.lower() * line.nc.lower() > 0;
        line.negative[s + 1] = line.negative[s] ^ other.covered[rising ? at : at + 1];
      }
      if (line.negative.back() != at_end[i]) return false;
      for (std::size_t s = 0; s <= line.others.size(); ++s) {
        const bool under = expression.value(line.negative[s]);
        const bool over = expression.value(line.negative[s] ^ line.covered[s]);
        // Solid on the right: the negative side is on the left of start -> end.
        line.next.push_back(under == over ? 0 : over ? 1 : -1);
      }
    }
    return true;
  }

  struct Step {
    int line, segment;
  };

  bool leaves_through_side(const Step& s) const {
    const Line& line = lines_[s.line];
    return line.next[s.segment] > 0 ? s.segment == static_cast<int>(line.others.size()) : s.segment == 0;
  }

  // The vertex at the far end of a step: index into line.others.
  int far_vertex(const Step& s) const { return lines_[s.line].next[s.segment] > 0 ? s.segment : s.segment - 1; }

  std::optional<std::vector<Arc>> chain() {
    const FacetTable& table = in_.restriction.table();
    std::size_t total = 0, used = 0;
    for (const Line& line : lines_)
      total += static_cast<std::size_t>(std::count_if(line.next.begin(), line.next.end(), [](int d) { return d != 0; }));
    std::vector<Arc> arcs;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      for (const int end : {0, 1}) {
        const Line& line = lines_[i];
        const int segment = end ? static_cast<int>(line.others.size()) : 0;
        if (line.next[segment] != (end ? -1 : 1)) continue;
        Arc arc;
        const Grid& grid = in_.restriction.grid();
        arc.start = side_crossing(table, grid, in_.face, side_name[end ? line.end_side : line.start_side], line.surface);
        arc.surfaces.push_back(line.surface);
        Step step{static_cast<int>(i), segment};
        ++used;
        while (!leaves_through_side(step)) {
          if (!advance(step, arc) || ++used > total) return std::nullopt;
        }
        const Line& last = lines_[step.line];
        arc.end = side_crossing(table, grid, in_.face,
                                side_name[last.next[step.segment] > 0 ? last.end_side : last.start_side], last.surface);
        arc.facet = facet_on(line.surface);
        arcs.push_back(std::move(arc));
      }
    }
    if (used != total) return std::nullopt;  // a closed curve inside the face
    return arcs;
  }

  std::uint32_t facet_on(std::uint32_t surface) const {
    for (const Piece& p : in_.pieces)
      if (p.surface == surface) return p.facet;
    return 0;
  }

  // One vertex on: straight ahead, around a corner, or, where two sheets cross, around the inside on the right.
  bool advance(Step& step, Arc& arc) const {
    const Line& line = lines_[step.line];
    const int v = far_vertex(step);
    const int j = line.others[v];
    const Line& other = lines_[j];
    const int w = position(other, step.line);
    const int ahead = line.next[step.segment] > 0 ? v + 1 : v;
    const bool straight = line.next[ahead] == line.next[step.segment];
    const bool forth = other.next[w + 1] > 0, back = other.next[w] < 0;
    if (straight) {
      if (forth || back) return false;  // cannot happen where memberships are consistent
      step.segment = ahead;
      return true;
    }
    if (!forth && !back) return false;
    const double ux = -line.nc.lower() * line.next[step.segment], uy = line.nb.lower() * line.next[step.segment];
    const double vx = -other.nc.lower(), vy = other.nb.lower();
    const bool two = forth && back;
    const bool take_forth = two ? ux * vy - uy * vx < 0 : forth;
    const std::size_t lo = std::min(step.line, j), hi = std::max(step.line, j);
    const Vec2i& p = points_[lo * lines_.size() + hi];
    double b = std::clamp(middle(p.b), 0.0, size_);
    double c = std::clamp(middle(p.c), 0.0, size_);
    if (two) {
      // Into the inside quadrant: between where the arc came from and where it goes.
      const double sign = take_forth ? 1 : -1;
      double db = sign * vx / std::hypot(vx, vy) - ux / std::hypot(ux, uy);
      double dc = sign * vy / std::hypot(vx, vy) - uy / std::hypot(ux, uy);
      const double length = std::hypot(db, dc);
      if (length > 0) b += in_.pull * db / length, c += in_.pull * dc / length;
      arc.contact = true;
    }
    Vec3 bend = low_;
    bend[in_.face.b_axis()] += b;
    bend[in_.face.c_axis()] += c;
    arc.bends.push_back(bend);
    arc.surfaces.push_back(other.surface);
    step = {j, take_forth ? w + 1 : w};
    return true;
  }

  struct End {
    int side;
    Interval at;
    int line;
    bool start;
  };
  struct Vec2i {
    Interval b, c;
  };

  const FacePlanesInput& in_;
  Vec3 low_;
  double size_ = 0;
  std::vector<Line> lines_;
  std::vector<End> ends_;
  std::vector<Vec2i> points_;
};

}  // namespace

std::optional<std::vector<Arc>> arrange_pieces(const FacePlanesInput& input) { return Arrangement(input).arcs(); }

}  // namespace starcell
