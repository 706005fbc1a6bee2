#include "configuration_space/crossing_links.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "configuration_space/angle_function.h"

namespace starcell {
namespace {

// Notation: s and t are the second and third angle, in half turns from 0 where they are counted: at (i, j) the arm is flat, s = i pi and t = j pi. The
// corners are p0 .. p3; a (of p2), b (p3), c (p0), d (p1) as in the header:
//   a = l2 sin s,   b = l2 sin s + l3 sin(s + t),   c = l2 sin t + l1 sin(s + t),   d = l2 sin t.
// About (1, 1), with x = pi - s, y = pi - t, the links cross in the one sense (x, y > 0) where x + y < pi, b < 0, c < 0, in the other one where all is turned round:
// the three links and their crossing bound a triangle, whose outer angles s and t are both less than pi, together more. With l2 = l3 and these, b < 0 is
// 2 x + y < pi; with l1 = l2, c < 0 is x + 2 y < pi.

// Where a function is beyond a margin: above it, or, turned, below its negative.
struct Half {
  std::array<SmoothSurfacePtr, 2> less;   // the function less the margin, and with it added
  bool positive;
  Half operator-() const { return {less, !positive}; }
  Expression set() const { return positive ? Expression(less[0]).complement() : Expression(less[1]); }
  /// Where it grows to, at a point; the function may be as it is or turned.
  Vec3 inwards(const Vec3& q) const {
    Vec3 g;
    less[0]->value(q, &g);
    return positive ? g : -g;
  }
};

bool odd(int i) { return i % 2 != 0; }
double direction(int i) { return odd(i) ? -1 : 1; }

class Crossing {
 public:
  Crossing(const std::array<double, 3>& lengths, double unit, double margin) : l_(lengths), unit_(unit), margin_(margin) {}

  std::vector<Expression> over(const Box3& domain) {
    std::vector<Expression> sets;
    const auto turns = [&](int axis, bool up) { return (up ? domain.max() : domain.min())[axis] / (M_PI * unit_); };
    const auto first = [&](int axis) { return static_cast<int>(std::floor(turns(axis, false))) - 1; };
    const auto last = [&](int axis) { return static_cast<int>(std::ceil(turns(axis, true))) + 1; };
    // Only what reaches into the domain: other sets would change nothing.
    const auto meets = [&](double s0, double s1, double t0, double t1) {
      return s0 <= turns(1, true) && s1 >= turns(1, false) && t0 <= turns(2, true) && t1 >= turns(2, false);
    };
    for (int i = first(1); i <= last(1); ++i)
      for (int j = first(2); j <= last(2); ++j) {
        const double r = near(i, j) / M_PI;
        if (r > 0 && meets(i - r, i + r, j - r, j + r))
          if (const auto set = flat(i, j)) {
            sets.push_back(*set);
            if (i > turns(1, false) && i < turns(1, true) && j > turns(2, false) && j < turns(2, true)) flat_.push_back({i, j});
          }
        if (!odd(i) || !odd(j)) continue;
        if (meets(i - 1, i, j - 1, j)) sets.push_back(triangle(i, j, 1));
        if (meets(i, i + 1, j, j + 1)) sets.push_back(triangle(i, j, -1));
      }
    return sets;
  }

  /// Flat places in the domain about which the links cross.
  const std::vector<std::array<int, 2>>& flat_places() const { return flat_; }

  /// How much smaller a margin is than the move that it makes: of the functions' least slopes where they are 0, and, where two of them meet, of how fast both grow
  /// along the line between them. About (1, 1) all kinds of corners are: flat ones there and at its neighbours, p3 in p0, and, of equal links, where c or b as a plane meets the
  /// plane that it has as a factor.
  double least_slope() {
    double least = 1;
    // On b = 0 one of the two cosines of b's slope is at least this, by the other's sine; so for c.
    for (const double other : {l_[0], l_[2]})
      if (other != l_[1]) least = std::min(least, std::sqrt(std::abs(other - l_[1]) * (other + l_[1]) / 2) / unit_);
    const auto meet = [&](const Half& f, const Half& g, const Vec3& q) {
      const Vec3 u = f.inwards(q), v = g.inwards(q), between = (u.normalized() + v.normalized()).normalized();
      least = std::min({least, u.dot(between), v.dot(between)});
    };
    for (const auto& [i, j] : {std::pair{1, 1}, {0, 1}, {1, 0}})
      if (const auto both = ends(i, j)) meet(both->first, -both->second, unit_ * M_PI * Vec3(0, i, j));
    const auto cosine = [](double p, double q, double across) { return (across * across - p * p - q * q) / (2 * p * q); };
    const double s = cosine(l_[0], l_[1], l_[2]), t = cosine(l_[1], l_[2], l_[0]);
    if (std::abs(s) < 1 && std::abs(t) < 1) meet(-b(1, 1), -c(1, 1), unit_ * Vec3(0, std::acos(s), std::acos(t)));
    if (l_[0] == l_[1]) meet(beyond(1, 0, 1, false), beyond(1, 2, 2, true), unit_ * M_PI * Vec3(0, 1, 0.5));
    if (l_[1] == l_[2]) meet(beyond(0, 1, 1, false), beyond(2, 1, 2, true), unit_ * M_PI * Vec3(0, 0.5, 1));
    return least;
  }

 private:
  // slope . (s, t) - half_turns pi unit - offset.
  SmoothSurfacePtr plane(int of_s, int of_t, int half_turns, double offset) {
    SmoothSurfacePtr& known = planes_[{of_s, of_t, half_turns, offset}];
    if (!known) known = std::make_shared<AngleFunction>(unit_, Vec3(0, of_s, of_t), -half_turns, -offset);
    return known;
  }
  Half beyond(int of_s, int of_t, int half_turns, bool positive) { return {{plane(of_s, of_t, half_turns, margin_), plane(of_s, of_t, half_turns, -margin_)}, positive}; }

  Half beyond(std::array<SmoothSurfacePtr, 2>& known, const AngleWave& one, const AngleWave& two) const {
    for (std::size_t k = 0; k < 2; ++k)
      if (!known[k]) known[k] = std::make_shared<AngleFunction>(unit_, std::vector<AngleWave>{one, two}, k == 0 ? -margin_ : margin_);
    return {known, true};
  }

  // Near (i, j), or within a triangle at it; a's and d's sines are positive where their angles are beyond i pi, but for the direction.
  Half a(int i) { return beyond(1, 0, i, !odd(i)); }
  Half d(int j) { return beyond(0, 1, j, !odd(j)); }
  Half b(int i, int j) {
    if (l_[1] == l_[2]) return beyond(2, 1, 2 * i + j, !odd(i));   // 2 l sin(s + t / 2) cos(t / 2)
    return beyond(b_, {l_[1], Vec3(0, 1, 0)}, {l_[2], Vec3(0, 1, 1)});
  }
  Half c(int i, int j) {
    if (l_[0] == l_[1]) return beyond(1, 2, i + 2 * j, !odd(j));   // 2 l sin(t + s / 2) cos(s / 2)
    return beyond(c_, {l_[1], Vec3(0, 0, 1)}, {l_[0], Vec3(0, 1, 1)});
  }

  // How far about (i, j) no corner passes another one, seen along the first link, of those that do not coincide there as equally long links make them; 0: there is none.
  double near(int i, int j) const {
    const double p2 = l_[0] + direction(i) * l_[1], p3 = p2 + direction(i + j) * l_[2];
    double room = std::min(std::abs(p2 - l_[0]), std::abs(p3));
    if (l_[0] != l_[1] || !odd(i)) room = std::min(room, std::abs(p2));
    if (l_[1] != l_[2] || !odd(j)) room = std::min(room, std::abs(p3 - l_[0]));
    if (!(room > 1e-12 * (l_[0] + l_[1] + l_[2]))) return 0;      // rounding: a sum of three
    double h = M_PI_4;
    while (l_[1] * (1 - std::cos(h)) + l_[2] * (1 - std::cos(2 * h)) > 0.9 * room) h *= 0.5;
    return h;
  }

  // |s - i pi| < h and |t - j pi| < h.
  Expression square(int i, int j, double h) {
    const double r = h * unit_;
    return Expression::intersection({Expression(plane(1, 0, i, r)), Expression(plane(1, 0, i, -r)).complement(), Expression(plane(0, 1, j, r)), Expression(plane(0, 1, j, -r)).complement()});
  }

  // Relative heights of the last link over the first at the lower end of what they have in common, and at the upper one, about (i, j). Of two corners that
  // coincide the one that moves along a plane stands for both. None where they have no more than an end in common: nothing crosses.
  std::optional<std::pair<Half, Half>> ends(int i, int j) {
    const bool forward = !odd(i + j), at_p0 = l_[0] == l_[1] && odd(i), at_p1 = l_[1] == l_[2] && odd(j);
    const double p0 = 0, p1 = l_[0], p2 = p1 + direction(i) * l_[1], p3 = at_p1 ? p1 : p2 + direction(i + j) * l_[2];
    const double from = forward ? p2 : p3, to = forward ? p3 : p2;
    if (to <= p0 || from >= p1) return std::nullopt;
    const Half over_p0 = forward ? -c(i, j) : c(i, j), over_p1 = forward ? -d(j) : d(j);
    const auto of_last = [&](bool p2_end) { return p2_end ? a(i) : b(i, j); };
    const Half low = at_p0 ? a(i) : from < p0 ? over_p0 : of_last(forward);
    const Half high = at_p1 ? over_p1 : to > p1 ? over_p1 : of_last(!forward);
    return std::pair{low, high};
  }

  // What crosses about (i, j).
  std::optional<Expression> flat(int i, int j) {
    const auto both = ends(i, j);
    if (!both) return std::nullopt;
    const auto& [low, high] = *both;
    const Expression crossed = Expression::set_union({Expression::intersection({low.set(), (-high).set()}), Expression::intersection({(-low).set(), high.set()})});
    return Expression::intersection({square(i, j, near(i, j)), crossed});
  }

  // Those about (i, j), both odd, in the sense of x, y > 0 or < 0, without what is said where the arm is flat.
  Expression triangle(int i, int j, int sense) {
    const auto turned = [&](const Half& h) { return sense > 0 ? h : -h; };
    // x > 0: s is less than i pi. Beyond i pi - sense pi the arm is stretched.
    const bool l23 = l_[1] == l_[2], l12 = l_[0] == l_[1];
    const Half x = beyond(1, 0, i, false), y = beyond(0, 1, j, false);
    const SmoothSurfacePtr stretched = plane(1, 1, i + j - sense, 0);
    const Half b_below = l23 ? beyond(2, 1, 2 * i + j - sense, true) : -b(i, j), c_below = l12 ? beyond(1, 2, i + 2 * j - sense, true) : -c(i, j);
    std::vector<Expression> all{sense > 0 ? Expression(stretched).complement() : Expression(stretched)};
    for (const Half& h : {x, y, b_below, c_below}) all.push_back(turned(h).set());
    for (const auto& [u, v] : {std::pair{i, j}, {i - sense, j}, {i, j - sense}}) {
      const double h = near(u, v);
      if (h > 0) all.push_back(square(u, v, 0.5 * h).complement());
    }
    return Expression::intersection(all);
  }

  std::array<double, 3> l_;
  double unit_, margin_;
  std::map<std::tuple<int, int, int, double>, SmoothSurfacePtr> planes_;
  std::array<SmoothSurfacePtr, 2> b_, c_;
  std::vector<std::array<int, 2>> flat_;
};

}  // namespace

std::optional<CrossingLinks> crossing_links(const std::array<double, 3>& lengths, double unit, const Box3& domain, double move) {
  constexpr double reserve = 0.8;
  Crossing crossing(lengths, unit, move > 0 ? reserve * move * Crossing(lengths, unit, 0).least_slope() : 0);
  const std::vector<Expression> sets = crossing.over(domain);
  if (sets.empty()) return std::nullopt;
  CrossingLinks links{Expression::set_union(sets), move, {}};
  for (const auto& [i, j] : crossing.flat_places()) {
    Box3 line = domain;
    for (const int axis : {1, 2}) {
      const double at = unit * M_PI * (axis == 1 ? i : j);
      line.min()[axis] = at - move;
      line.max()[axis] = at + move;
    }
    links.contacts.push_back(line);
  }
  return links;
}

}  // namespace starcell
