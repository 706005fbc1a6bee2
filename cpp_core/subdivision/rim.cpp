#include "subdivision/rim.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "subdivision/grid_line.h"

namespace starcell {
namespace {

bool value_of(const LocalExpression& expression, const std::vector<char>& inside) {
  if (inside.size() <= max_slots) {
    Membership mask = 0;
    for (std::size_t slot = 0; slot < inside.size(); ++slot)
      if (inside[slot]) mask |= Membership{1} << slot;
    return expression.value(mask);
  }
  std::vector<State> states;
  states.reserve(inside.size());
  for (const char s : inside) states.push_back(s ? State::inside : State::outside);
  return *expression.simplified(states).constant();
}

// Where two crossings of one surface are nearer to each other than the grid is fine, a stretch is looked at in finer intervals,
// so many in all: beside a knife's edge a few do, a surface that runs along the line would need all there are.
constexpr int most_finer = 256;
constexpr int coarse_levels = 4;

// A stretch of a grid line, in grid coordinates.
struct Stretch {
  int axis;
  GridPoint from;
  std::uint32_t size;
};

struct Event {
  Crossing crossing;
  double low, high;
  std::vector<std::size_t> slots;   // those that flip
};

class Side {
 public:
  Side(const Restriction& restriction, const CellProblem& problem, const Stretch& stretch)
      : restriction_(restriction), table_(restriction.table()), grid_(restriction.grid()), problem_(problem), stretch_(stretch),
        whole_(std::uint64_t{stretch.size} << restriction.grid().finer) {}

  // Events in ascending order; `sure` says that it is their order, and that none is missing.
  std::vector<Event> events(bool& sure) {
    facet_events();
    for (std::size_t slot = 0; slot < problem_.slots(); ++slot) {
      const std::uint32_t operand = problem_.expression.solids()[slot];
      if (table_.is_region(operand)) region_events(table_.region(operand).surface, slot);
    }
    std::sort(events_.begin(), events_.end(), [](const Event& x, const Event& y) {
      return x.crossing.at != y.crossing.at ? x.crossing.at < y.crossing.at : x.crossing < y.crossing;
    });
    for (std::size_t k = 1; k < events_.size(); ++k) sure_ = sure_ && events_[k - 1].high < events_[k].low;
    sure = sure && sure_;
    return std::move(events_);
  }

 private:
  Crossing crossing(std::uint32_t surface, double at, std::uint64_t root = 0) const {
    Crossing x;
    x.axis = static_cast<std::uint8_t>(stretch_.axis);
    x.i = stretch_.from[(stretch_.axis + 1) % 3];
    x.j = stretch_.from[(stretch_.axis + 2) % 3];
    x.surface = surface;
    x.root = root;
    x.low = stretch_.from[stretch_.axis];
    x.high = x.low + stretch_.size;
    x.at = std::clamp(at, grid_.coordinate(stretch_.axis, x.low), grid_.coordinate(stretch_.axis, x.high));
    return x;
  }

  Event& event_on(std::uint32_t surface) {
    for (Event& e : events_)
      if (e.crossing.surface == surface && e.crossing.root == 0) return e;
    return events_.emplace_back(plane_event(surface));
  }

  Event plane_event(std::uint32_t surface) const {
    const Surface& s = table_.surfaces[surface];
    const Vec3 p = grid_.point(stretch_.from);
    const int a = stretch_.axis, b = (a + 1) % 3, c = (a + 2) % 3;
    const Rounding rounding;
    const Interval at = (Interval(s.offset) - Interval(s.normal[b]) * p[b] - Interval(s.normal[c]) * p[c]) / Interval(s.normal[a]);
    return {crossing(surface, middle(at)), at.lower(), at.upper(), {}};
  }

  void facet_events() {
    const int axis = stretch_.axis;
    const Vec3 p = grid_.point(stretch_.from);
    const double to = grid_.coordinate(axis, stretch_.from[axis] + stretch_.size);
    for (const std::uint32_t f : problem_.facets)
      if (segment_crosses(table_, f, axis, p, to)) toggle(event_on(table_.surface[f]), restriction_.slot_of(problem_, f), candidates_);
  }

  // A candidate solid may flip wherever one of its facets is.
  static void toggle(Event& e, std::size_t slot, Membership candidates = 0) {
    const auto known = std::find(e.slots.begin(), e.slots.end(), slot);
    if (known == e.slots.end())
      e.slots.push_back(slot);
    else if (!(candidates >> slot & 1))
      e.slots.erase(known);
  }

  void region_events(std::uint32_t surface, std::size_t slot) {
    const SmoothSurface* form = restriction_.form_of(problem_, slot);
    if (!form) {
      if (plane_sign(surface, 0) != plane_sign(surface, whole_)) toggle(event_on(surface), slot);
      return;
    }
    bool known = false;   // through another slot on the same surface
    for (Event& e : events_)
      if (e.crossing.surface == surface) e.slots.push_back(slot), known = true;
    if (!known) isolate(*form, surface, slot, 0, whole_);
  }

  // Offsets along the stretch are in units / 2^finer.
  Vec3 place(std::uint64_t offset) const {
    Vec3 p = grid_.point(stretch_.from);
    p[stretch_.axis] = grid_.coordinate(stretch_.axis, stretch_.from[stretch_.axis], offset);
    return p;
  }

  // The function's sign at an offset; what is not certain grazes.
  template <class F>
  int sign(const F& s, std::uint64_t offset) {
    const auto [found, sure] = plain_sign(s, offset);
    sure_ = sure_ && sure;
    return found;
  }

  int plane_sign(std::uint32_t surface, std::uint64_t offset) { return sign(table_.surfaces[surface], offset); }

  // A sign that depends on the place alone, and whether it is certain.
  template <class F>
  std::pair<int, bool> plain_sign(const F& s, std::uint64_t offset) const {
    const Rounding rounding;
    const Interval value = s.expand(place(offset), Vec3::Zero()).value;
    const int certain = certain_sign(value);
    return {certain != 0 ? certain : middle(value) < 0 ? -1 : 1, certain != 0};
  }

  void isolate(const SmoothSurface& s, std::uint32_t surface, std::size_t slot, std::uint64_t from, std::uint64_t size) {
    const Vec3 a = place(from), b = place(from + size);
    bool none, monotone;
    Interval slope;
    {
      const Rounding rounding;
      const Expansion e = s.expand(0.5 * (a + b), 0.5 * (b - a));
      none = certain_sign(e.range()) != 0;
      slope = e.along(Vec3::Unit(stretch_.axis));
      monotone = certain_sign(slope) != 0;
    }
    if (none) return;
    if (!monotone && size <= std::uint64_t{1} << grid_.finer) --finer_left_;
    // Of a surface of too many pieces nothing is ever certain, and every look at it is dear: such cells are given up.
    const bool coarse = !s.simple() && size <= whole_ >> coarse_levels;
    if (monotone || size == 1 || finer_left_ < 0 || coarse) {
      if (!monotone) sure_ = false;
      if (sign(s, from) != sign(s, from + size)) enclose_root(s, surface, slot, from, size, slope);
      return;
    }
    isolate(s, surface, slot, from, size / 2);
    isolate(s, surface, slot, from + size / 2, size / 2);
  }

  // Newton's method proposes, signs decide in which of the finest intervals the root is.
  void enclose_root(const SmoothSurface& s, std::uint32_t surface, std::size_t slot, std::uint64_t from, std::uint64_t size, const Interval& slope) {
    const int axis = stretch_.axis;
    const double fine = std::ldexp(grid_.unit, -grid_.finer), length = fine * static_cast<double>(size);
    Vec3 p = place(from);
    const double begin = p[axis];
    p[axis] = begin + 0.5 * length;
    for (int step = 0; step < 6; ++step) {
      Vec3 gradient;
      const double value = s.value(p, &gradient);
      if (gradient[axis] == 0) break;
      const double next = std::clamp(p[axis] - value / gradient[axis], begin, begin + length);
      const bool still = std::abs(next - p[axis]) <= 1e-15 * std::abs(next);
      p[axis] = next;
      if (still) break;
    }
    // Which interval it is names the root, and every cell has to find the same name. If both ends have certain signs it is the true
    // one; otherwise bisection has the last word, whose places do not depend on where it began.
    const int start = plain_sign(s, from).first;
    std::uint64_t low, high;   // different signs at from + low, from + high
    bool low_sure, high_sure;
    const auto begin_anew = [&] { low = 0, high = size, low_sure = high_sure = true; };
    const auto probe = [&](std::uint64_t offset) {
      if (offset <= low || offset >= high) return;
      const auto [found, sure] = plain_sign(s, from + offset);
      if (found == start)
        low = offset, low_sure = sure;
      else
        high = offset, high_sure = sure;
    };
    const auto guess = static_cast<std::uint64_t>(std::clamp(std::floor((p[axis] - begin) / fine), 0.0, static_cast<double>(size - 1)));
    begin_anew();
    probe(guess);
    probe(guess + 1);
    if (high - low > 1 || !low_sure || !high_sure) {
      begin_anew();
      while (high - low > 1) probe(low + (high - low) / 2);
    }
    const std::uint64_t root = (std::uint64_t{stretch_.from[axis]} << grid_.finer) + from + low;
    const double infinity = std::numeric_limits<double>::infinity();
    double at_low = low_sure ? grid_.coordinate(axis, 0, root) : -infinity, at_high = high_sure ? grid_.coordinate(axis, 0, root + 1) : infinity;
    if (certain_sign(slope) != 0) {   // one step of interval Newton
      const Rounding rounding;
      const Interval newton = Interval(p[axis]) - s.expand(p, Vec3::Zero()).value / slope;
      at_low = std::max(at_low, newton.lower());
      at_high = std::min(at_high, newton.upper());
    }
    if (std::isinf(at_low) || std::isinf(at_high)) sure_ = false, at_low = at_high = p[axis];
    events_.push_back({crossing(surface, 0.5 * (at_low + at_high), root), at_low, at_high, {slot}});
  }

  const Restriction& restriction_;
  const FacetTable& table_;
  const Grid& grid_;
  const CellProblem& problem_;
  const Stretch stretch_;
  const std::uint64_t whole_;   // its size, in units / 2^finer
  const Membership candidates_ = problem_.candidates(table_);
  int finer_left_ = most_finer;
  std::vector<Event> events_;
  bool sure_ = true;
};

GridPoint beyond(int axis, GridPoint from, std::uint32_t size) {
  from[axis] += size;
  return from;
}

}  // namespace

const RimLines::Line& RimLines::line(int axis, const GridPoint& from, std::uint32_t size) {
  for (const Line& known : lines_)
    if (known.axis == axis && known.from == from && known.size == size) return known;
  Line line{axis, from, size, true, {}};
  const std::vector<Event> events = Side(restriction_, problem_, {axis, from, size}).events(line.sure);
  std::vector<char> inside = restriction_.membership_at(problem_, from);
  bool value = value_of(problem_.expression, inside);
  const std::vector<char> at_end = restriction_.membership_at(problem_, beyond(axis, from, size));
  const Membership candidates = problem_.candidates(restriction_.table());
  for (std::size_t k = 0; k < events.size(); ++k) {
    const Event& e = events[k];
    for (const std::size_t slot : e.slots) {
      if (!(candidates >> slot & 1)) {
        inside[slot] ^= 1;
      } else if (k + 1 == events.size()) {
        inside[slot] = at_end[slot];
      } else {
        Vec3 between = place_of(e.crossing, restriction_.grid());
        between[axis] = 0.5 * (e.high + events[k + 1].low);
        const auto beside = restriction_.candidate_contains(problem_, slot, between);
        line.sure = line.sure && beside.has_value();
        inside[slot] = beside.value_or(inside[slot] != 0);
      }
    }
    const bool next = value_of(problem_.expression, inside);
    if (next != value) line.flips.push_back({e.crossing, e.low, e.high, next, 0});
    value = next;
  }
  // What was toggled along the line has to be what its far end says.
  line.sure = line.sure && inside == at_end;
  return lines_.emplace_back(std::move(line));
}

std::optional<std::vector<Flip>> RimLines::around(const Face& face, bool certain) {
  std::vector<Flip> around;
  // Counter-clockwise: bottom and right upwards, top and left downwards.
  for (const int side : {2, 1, 3, 0}) {
    const GridPoint low = side < 2 ? face.corner(side, 0) : face.corner(0, side - 2);
    const Line& line = this->line(side < 2 ? face.c_axis() : face.b_axis(), low, face.size);
    if (certain && !line.sure) return std::nullopt;
    const std::size_t before = around.size();
    for (Flip flip : line.flips) {
      flip.side = side;
      if (side == 3 || side == 0) flip.enters = !flip.enters;
      around.push_back(flip);
    }
    if (side == 3 || side == 0) std::reverse(around.begin() + static_cast<std::ptrdiff_t>(before), around.end());
  }
  return around;
}

}  // namespace starcell
