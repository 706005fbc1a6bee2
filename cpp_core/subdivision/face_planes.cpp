#include "subdivision/face_planes.h"

#include <algorithm>
#include <cmath>

#include "numerics/predicates.h"

namespace starcell {
namespace {

class Arrangement {
 public:
  explicit Arrangement(const FaceProblem& input) : in_(input) {}

  std::optional<std::vector<Arc>> arcs() {
    auto found = face_lines(in_);
    if (!found) return std::nullopt;
    face_ = std::move(*found);
    {
      const Rounding rounding;
      if (!order_crossings()) return std::nullopt;
    }
    if (!face_.cover(in_, [&](const FaceLine& line, const PieceEnd& end) { return boundary(line, end); }))
      return std::nullopt;
    if (!cover_by_candidates()) return std::nullopt;
    Membership corner = in_.restriction.mask_at(in_.problem, in_.face.corner(0, 0));
    if (!propagate(corner)) return std::nullopt;
    return chain();
  }

 private:
  bool cross(const FaceLine& x, const FaceLine& y) const {
    const auto between = [&](int rank) {
      return x.start_rank < x.end_rank ? x.start_rank < rank && rank < x.end_rank
                                       : rank > x.start_rank || rank < x.end_rank;
    };
    return between(y.start_rank) != between(y.end_rank);
  }

  bool intersect(const FaceLine& x, const FaceLine& y, Interval& b, Interval& c) const {
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
      FaceLine& line = lines_[i];
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

  int position(const FaceLine& line, int other) const {
    const auto it = std::find(line.others.begin(), line.others.end(), other);
    return it == line.others.end() ? -1 : static_cast<int>(it - line.others.begin());
  }

  // Which boundary between sub-segments an end of a piece is: 0 the line's start, others.size() + 1 its end.
  int boundary(const FaceLine& line, const PieceEnd& end) const {
    if (end.side >= 0) {
      if (end.side == side_name[line.start_side]) return 0;
      if (end.side == side_name[line.end_side]) return static_cast<int>(line.others.size()) + 1;
      return -1;
    }
    const int other = face_.line_of(in_.surface_of(end.neighbour));
    const int at = other < 0 ? -1 : position(line, other);
    return at < 0 ? -1 : at + 1;
  }

  // Where a candidate's pieces may flip it, membership on both sides says whether they do.
  bool cover_by_candidates() {
    const Membership candidates = in_.problem.candidates(in_.restriction.table());
    if (candidates == 0) return true;
    for (int i = 0; i < static_cast<int>(lines_.size()); ++i)
      for (std::size_t s = 0; s < lines_[i].covered.size(); ++s) {
        const Vec2 at = middle_of(i, s);
        for (std::size_t slot = 0; slot < in_.problem.slots(); ++slot) {
          if (!(candidates >> slot & 1) || !reached(i, slot, at)) continue;
          const auto flips = flips_at(i, slot, at);
          if (!flips) return false;
          if (*flips) lines_[i].covered[s] ^= Membership{1} << slot;
        }
      }
    return true;
  }

  // About the middle of a sub-segment, relative to the face's lower corner.
  Vec2 middle_of(int i, std::size_t s) const {
    const FaceLine& line = lines_[i];
    const auto place = [&](int boundary) {
      if (boundary == 0 || boundary == static_cast<int>(line.others.size()) + 1) {
        const int side = boundary == 0 ? line.start_side : line.end_side;
        const double at = middle(boundary == 0 ? line.start_at : line.end_at);
        return side == 0 ? Vec2{at, 0} : side == 1 ? Vec2{face_.size, at} : side == 2 ? Vec2{face_.size - at, face_.size} : Vec2{0, face_.size - at};
      }
      const int j = line.others[static_cast<std::size_t>(boundary) - 1];
      const Vec2i& p = points_[static_cast<std::size_t>(std::min(i, j)) * lines_.size() + static_cast<std::size_t>(std::max(i, j))];
      return Vec2{middle(p.b), middle(p.c)};
    };
    const Vec2 p = place(static_cast<int>(s)), q = place(static_cast<int>(s) + 1);
    return {0.5 * (p.x + q.x), 0.5 * (p.y + q.y)};
  }

  Vec3 in_space(const Vec2& at) const {
    Vec3 x = face_.low;
    x[in_.face.b_axis()] += at.x;
    x[in_.face.c_axis()] += at.y;
    return x;
  }

  // Does one of the solid's facets on the line reach the place?
  bool reached(int i, std::size_t slot, const Vec2& at) const {
    const FacetTable& table = in_.restriction.table();
    const Vec3 x = in_space(at);
    for (const Piece& piece : in_.pieces) {
      if (piece.slot != slot || in_.planes.of(piece.surface) != lines_[i].surface) continue;
      const Vec3 n = table.area_vector(piece.facet);
      bool within = true;
      for (int k = 0; k < 3 && within; ++k) {
        const Vec3& p = table.corner(piece.facet, k);
        const Vec3 outward = (table.corner(piece.facet, (k + 1) % 3) - p).cross(n);
        within = outward.dot(x - p) <= 1e-9 * face_.size * outward.norm();
      }
      if (within) return true;
    }
    return false;
  }

  // Membership beside the line: off it by half the way to the nearest other line, so that the regions beside it are met for certain.
  std::optional<bool> flips_at(int i, std::size_t slot, const Vec2& at) {
    const auto value = [&](const FaceLine& line, const Vec2& p) { return line.nb * p.x + line.nc * p.y - line.d; };
    std::array<Vec2, 2> beside;
    {
      const Rounding rounding;
      double room = std::min({at.x, at.y, face_.size - at.x, face_.size - at.y});
      for (int j = 0; j < static_cast<int>(lines_.size()); ++j)
        if (j != i) room = std::min(room, std::abs(middle(value(lines_[j], at))));
      for (const int sense : {0, 1}) {
        const double step = (sense ? 0.5 : -0.5) * room;
        beside[sense] = {at.x + step * middle(lines_[i].nb), at.y + step * middle(lines_[i].nc)};
        const Vec2& p = beside[sense];
        if (!(p.x > 0 && p.y > 0 && p.x < face_.size && p.y < face_.size)) return std::nullopt;
        for (int j = 0; j < static_cast<int>(lines_.size()); ++j) {
          const int sign = certain_sign(value(lines_[j], p));
          if (sign == 0 || (j == i && sign != (sense ? 1 : -1))) return std::nullopt;
        }
      }
    }
    std::array<bool, 2> inside;
    for (const int sense : {0, 1}) {
      const auto told = in_.restriction.candidate_contains(in_.problem, slot, in_space(beside[sense]));
      if (!told) return std::nullopt;
      inside[sense] = *told;
    }
    return inside[0] != inside[1];
  }

  // Walks the perimeter, then every line, and learns the membership beside each sub-segment.
  bool propagate(const Membership corner) {
    Membership mask = corner;
    std::vector<std::vector<Membership>> negative(lines_.size());  // per sub-segment, on the line's negative side
    for (std::size_t i = 0; i < lines_.size(); ++i) negative[i].assign(lines_[i].others.size() + 1, 0);
    std::vector<Membership> at_end(lines_.size());
    for (const LineEnd& end : face_.ends) {
      const FaceLine& line = lines_[end.line];
      if (end.start) {
        negative[end.line].front() = mask;
        mask ^= line.covered.front();
      } else {
        mask ^= line.covered.back();
        at_end[end.line] = mask;
      }
    }
    if (mask != corner) return false;
    const LocalExpression& expression = in_.problem.expression;
    next_.resize(lines_.size());
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const FaceLine& line = lines_[i];
      for (std::size_t s = 0; s < line.others.size(); ++s) {
        const FaceLine& other = lines_[line.others[s]];
        const int at = position(other, static_cast<int>(i));
        // The other line passes from this line's negative side to its positive one if it runs along this normal.
        const bool rising = -other.nc.lower() * line.nb.lower() + other.nb.lower() * line.nc.lower() > 0;
        negative[i][s + 1] = negative[i][s] ^ other.covered[rising ? at : at + 1];
      }
      if (negative[i].back() != at_end[i]) return false;
      for (std::size_t s = 0; s <= line.others.size(); ++s) {
        const bool under = expression.value(negative[i][s]);
        const bool over = expression.value(negative[i][s] ^ line.covered[s]);
        // Solid on the right: the negative side is on the left of start -> end.
        next_[i].push_back(under == over ? 0 : over ? 1 : -1);
      }
    }
    return true;
  }

  struct Step {
    int line, segment;
  };

  int sense(const Step& s) const { return next_[s.line][s.segment]; }

  bool leaves_through_side(const Step& s) const {
    return sense(s) > 0 ? s.segment == static_cast<int>(lines_[s.line].others.size()) : s.segment == 0;
  }

  // The vertex at the far end of a step: index into the line's others.
  int far_vertex(const Step& s) const { return sense(s) > 0 ? s.segment : s.segment - 1; }

  std::optional<std::vector<Arc>> chain() {
    seen_.resize(lines_.size());
    for (std::size_t i = 0; i < lines_.size(); ++i) seen_[i].assign(next_[i].size(), 0);
    std::vector<Arc> arcs;
    for (int i = 0; i < static_cast<int>(lines_.size()); ++i)
      for (const bool end : {false, true}) {
        const Step step{i, end ? static_cast<int>(lines_[i].others.size()) : 0};
        if (sense(step) == (end ? -1 : 1) && !follow(step, false, arcs)) return std::nullopt;
      }
    for (int i = 0; i < static_cast<int>(lines_.size()); ++i)
      for (int s = 0; s < static_cast<int>(next_[i].size()); ++s)
        if (next_[i][s] != 0 && !seen_[i][s] && !follow({i, s}, true, arcs)) return std::nullopt;
    return arcs;
  }

  // From a step to the rim, or around and back to the step.
  bool follow(const Step& first, bool closed, std::vector<Arc>& arcs) {
    Arc arc;
    if (!closed) arc.start = face_.crossing(in_, first.line, sense(first) > 0);
    arc.surfaces.push_back(lines_[first.line].surface);
    arc.facet = facet_on(in_, lines_[first.line].surface);
    Step step = first;
    seen_[step.line][step.segment] = 1;
    while (!leaves_through_side(step)) {
      if (!advance(step, arc)) return false;
      char& seen = seen_[step.line][step.segment];
      if (seen) {
        if (!closed || step.line != first.line || step.segment != first.segment || !close(arc)) return false;
        arcs.push_back(std::move(arc));
        return true;
      }
      seen = 1;
    }
    if (closed) return false;
    arc.end = face_.crossing(in_, step.line, sense(step) < 0);
    arcs.push_back(std::move(arc));
    return true;
  }

  // One vertex on: straight ahead, around a corner, or, where two sheets cross, around the inside on the right.
  bool advance(Step& step, Arc& arc) const {
    const FaceLine& line = lines_[step.line];
    const int v = far_vertex(step);
    const int j = line.others[v];
    const FaceLine& other = lines_[j];
    const int w = position(other, step.line);
    const int ahead = sense(step) > 0 ? v + 1 : v;
    const bool straight = next_[step.line][ahead] == sense(step);
    const bool forth = next_[j][w + 1] > 0, back = next_[j][w] < 0;
    if (straight) {
      if (forth || back) return false;  // cannot happen where memberships are consistent
      step.segment = ahead;
      return true;
    }
    if (!forth && !back) return false;
    const double ux = -line.nc.lower() * sense(step), uy = line.nb.lower() * sense(step);
    const double vx = -other.nc.lower(), vy = other.nb.lower();
    const bool two = forth && back;
    const bool take_forth = two ? ux * vy - uy * vx < 0 : forth;
    const std::size_t lo = std::min(step.line, j), hi = std::max(step.line, j);
    const Vec2i& p = points_[lo * lines_.size() + hi];
    double b = std::clamp(middle(p.b), 0.0, face_.size);
    double c = std::clamp(middle(p.c), 0.0, face_.size);
    if (two) {
      // Into the inside quadrant: between where the arc came from and where it goes.
      const double sign = take_forth ? 1 : -1;
      double db = sign * vx / std::hypot(vx, vy) - ux / std::hypot(ux, uy);
      double dc = sign * vy / std::hypot(vx, vy) - uy / std::hypot(ux, uy);
      const double length = std::hypot(db, dc);
      if (length > 0) b += in_.pull * db / length, c += in_.pull * dc / length;
      arc.contact = true;
    }
    Vec3 bend = face_.low;
    bend[in_.face.b_axis()] += b;
    bend[in_.face.c_axis()] += c;
    arc.bends.push_back(bend);
    arc.surfaces.push_back(other.surface);
    step = {j, take_forth ? w + 1 : w};
    return true;
  }

  struct Vec2i {
    Interval b, c;
  };

  const FaceProblem& in_;
  FaceLines face_;
  std::vector<FaceLine>& lines_ = face_.lines;
  std::vector<std::vector<int>> next_;   // per sub-segment, +1: E runs start -> end, -1: back, 0: not E
  std::vector<std::vector<char>> seen_;
  std::vector<Vec2i> points_;
};

}  // namespace

std::optional<std::vector<Arc>> arrange_pieces(const FaceProblem& input) { return Arrangement(input).arcs(); }

}  // namespace starcell
