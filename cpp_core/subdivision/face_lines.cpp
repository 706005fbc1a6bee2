#include "subdivision/face_lines.h"

#include <algorithm>

namespace starcell {
namespace {

// The line's sign at the four corners says which two sides it meets.
bool find_ends(FaceLine& line, double size) {
  const Interval s(size);
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

bool make_lines(const FaceProblem& in, FaceLines& result) {
  const FacetTable& table = in.restriction.table();
  std::vector<std::uint32_t> surfaces;
  for (const Piece& p : in.pieces) surfaces.push_back(in.planes.of(p.surface));
  std::sort(surfaces.begin(), surfaces.end());
  surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
  for (const std::uint32_t id : surfaces) {
    FaceLine line;
    line.surface = id;
    Interval n[3];
    in.planes.enclose(table, id, result.low, n, line.d);
    line.nb = n[in.face.b_axis()];
    line.nc = n[in.face.c_axis()];
    if (!find_ends(line, result.size)) return false;
    result.lines.push_back(std::move(line));
  }
  return true;
}

bool order_perimeter(FaceLines& result) {
  auto& lines = result.lines;
  auto& ends = result.ends;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ends.push_back({lines[i].start_side, lines[i].start_at, static_cast<int>(i), true});
    ends.push_back({lines[i].end_side, lines[i].end_at, static_cast<int>(i), false});
  }
  std::sort(ends.begin(), ends.end(), [](const LineEnd& x, const LineEnd& y) {
    if (x.side != y.side) return x.side < y.side;
    if (x.at.lower() != y.at.lower()) return x.at.lower() < y.at.lower();
    return x.line != y.line ? x.line < y.line : x.start < y.start;
  });
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    if (ends[k].side == ends[k + 1].side && !(ends[k].at.upper() < ends[k + 1].at.lower())) return false;
  for (std::size_t k = 0; k < ends.size(); ++k)
    (ends[k].start ? lines[ends[k].line].start_rank : lines[ends[k].line].end_rank) = static_cast<int>(k);
  return true;
}

}  // namespace

std::optional<FaceLines> face_lines(const FaceProblem& in) {
  const Rounding rounding;
  FaceLines result;
  const Grid& grid = in.restriction.grid();
  result.low = grid.point(in.face.corner(0, 0));
  result.size = grid.length(in.face.size);
  if (!make_lines(in, result) || !order_perimeter(result)) return std::nullopt;
  return result;
}

int FaceLines::line_of(std::uint32_t surface) const {
  const auto it = std::lower_bound(lines.begin(), lines.end(), surface,
                                   [](const FaceLine& line, std::uint32_t id) { return line.surface < id; });
  return it != lines.end() && it->surface == surface ? static_cast<int>(it - lines.begin()) : -1;
}

Crossing FaceLines::crossing(const FaceProblem& in, int line, bool start) const {
  const FaceLine& l = lines[line];
  const int side = side_name[start ? l.start_side : l.end_side];
  std::uint32_t surface = l.surface;
  if (!in.planes.empty())
    for (const Piece& p : in.pieces)
      if ((p.from.side == side || p.to.side == side) && in.planes.of(p.surface) == l.surface) surface = p.surface;
  return side_crossing(in.restriction.table(), in.restriction.grid(), in.face, side, surface);
}

bool FaceLines::cover(const FaceProblem& in, const std::function<int(const FaceLine&, const PieceEnd&)>& boundary) {
  const auto goes_on = [&](const Piece& p, const PieceEnd& end) {
    return end.side < 0 && in.surface_of(end.neighbour) == in.planes.of(p.surface);
  };
  for (FaceLine& line : lines) line.covered.assign(line.others.size() + 1, 0);
  const Membership candidates = in.problem.candidates(in.restriction.table());
  std::size_t used = 0;
  for (const Piece& first : in.pieces) {
    if (candidates >> first.slot & 1) {
      ++used;
      continue;
    }
    if (goes_on(first, first.from)) continue;
    const Piece* last = &first;
    ++used;
    while (goes_on(*last, last->to)) {
      const auto it = std::lower_bound(in.pieces.begin(), in.pieces.end(), last->to.neighbour,
                                       [](const Piece& p, std::uint32_t f) { return p.facet < f; });
      if (it == in.pieces.end() || it->facet != last->to.neighbour || ++used > in.pieces.size()) return false;
      last = &*it;
    }
    FaceLine& line = lines[line_of(in.planes.of(first.surface))];
    int from = boundary(line, first.from), to = boundary(line, last->to);
    if (from < 0 || to < 0 || from == to) return false;
    if (from > to) std::swap(from, to);
    for (int s = from; s < to; ++s) line.covered[s] ^= Membership{1} << first.slot;
  }
  return used == in.pieces.size();
}

std::uint32_t facet_on(const FaceProblem& in, std::uint32_t surface) {
  for (const Piece& p : in.pieces)
    if (in.planes.of(p.surface) == surface) return p.facet;
  return 0;
}

}  // namespace starcell
