#include "repair/rounding_motion.h"

#include <algorithm>
#include <mutex>

#include "contouring/straight_motion.h"
#include "solids/triangle_hierarchy.h"

namespace starcell {
namespace {

using K = ExactKernel;
using Vector = K::Vector_3;
using Points = std::vector<ExactPoint>;

// Of the coordinates: farther than nearest doubles are, and a tenth of what floating point allows for (straight_motion.cpp).
constexpr double nearest_share = 1e-15;

struct Pair {
  std::vector<std::uint32_t> shared, s, t;
};

Pair split(const Triangle& s, const Triangle& t) {
  Pair pair;
  for (const std::uint32_t v : s) (std::count(t.begin(), t.end(), v) > 0 ? pair.shared : pair.s).push_back(v);
  for (const std::uint32_t v : t)
    if (std::count(s.begin(), s.end(), v) == 0) pair.t.push_back(v);
  return pair;
}

// All of t beyond all of s along n, but for what they share.
bool beyond(const Points& p, const Pair& pair, const Vector& n) {
  const auto ahead = [&](std::uint32_t from, std::uint32_t to) { return CGAL::sign((p[to] - p[from]) * n) == CGAL::POSITIVE; };
  if (pair.shared.empty())
    return std::all_of(pair.s.begin(), pair.s.end(), [&](std::uint32_t x) { return std::all_of(pair.t.begin(), pair.t.end(), [&](std::uint32_t y) { return ahead(x, y); }); });
  const std::uint32_t c = pair.shared[0];
  return std::all_of(pair.s.begin(), pair.s.end(), [&](std::uint32_t x) { return ahead(x, c); }) &&
         std::all_of(pair.t.begin(), pair.t.end(), [&](std::uint32_t y) { return ahead(c, y); });
}

template <std::size_t N>
bool all_are(CGAL::Sign sign, const std::array<K::FT, N>& coefficients) {
  return std::all_of(coefficients.begin(), coefficients.end(), [&](const K::FT& c) { return CGAL::sign(c) == sign; });
}

K::FT det(const Vector& a, const Vector& b, const Vector& c) { return CGAL::determinant(a, b, c); }

bool keep_about_edge(const Points& before, const Points& after, const Pair& pair) {
  const std::uint32_t p = pair.shared[0], q = pair.shared[1], a = pair.s[0], b = pair.t[0];
  const Vector u0 = before[q] - before[p], u1 = after[q] - after[p], x0 = before[a] - before[p], x1 = after[a] - after[p], y0 = before[b] - before[p],
               y1 = after[b] - after[p];
  const std::array<K::FT, 4> volume{det(u0, x0, y0), det(u1, x0, y0) + det(u0, x1, y0) + det(u0, x0, y1), det(u1, x1, y0) + det(u1, x0, y1) + det(u0, x1, y1), det(u1, x1, y1)};
  if (all_are(CGAL::POSITIVE, volume) || all_are(CGAL::NEGATIVE, volume)) return true;
  const auto cross = [](const Vector& v, const Vector& w) { return CGAL::cross_product(v, w); };
  const Vector c0 = cross(u0, x0), c1 = cross(u0, x1) + cross(u1, x0), c2 = cross(u1, x1);   // the middle ones twice
  const Vector d0 = cross(u0, y0), d1 = cross(u0, y1) + cross(u1, y0), d2 = cross(u1, y1);
  return all_are<5>(CGAL::NEGATIVE, {c0 * d0, c0 * d1 + c1 * d0, c0 * d2 + c1 * d1 + c2 * d0, c1 * d2 + c2 * d1, c2 * d2});
}

bool keep(const Points& before, const Points& after, const std::vector<Vec3>& places, const Triangle& s, const Triangle& t) {
  const Pair pair = split(s, t);
  if (pair.shared.size() == 3) return false;
  if (pair.shared.size() == 2) return keep_about_edge(before, after, pair);
  const Vec3 n = separating_normal(places, s, t);
  const Vector hint(n.x(), n.y(), n.z());
  if (beyond(before, pair, hint) && beyond(after, pair, hint)) return true;
  // Nearer than what doubles tell: the triangles' own planes, and what is square to a side of each, exactly.
  const auto side = [&](const Triangle& of, std::size_t k) { return after[of[(k + 1) % 3]] - after[of[k]]; };
  std::vector<Vector> normals{CGAL::cross_product(side(s, 0), side(s, 1)), CGAL::cross_product(side(t, 0), side(t, 1))};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) normals.push_back(CGAL::cross_product(side(s, i), side(t, j)));
  return std::any_of(normals.begin(), normals.end(), [&](const Vector& m) {
    return (beyond(before, pair, m) && beyond(after, pair, m)) || (beyond(before, pair, -m) && beyond(after, pair, -m));
  });
}

// How far a point moves along one axis, at most.
double motion(const K::FT& from, double to) {
  const auto [low, high] = CGAL::to_interval(from - K::FT(to));
  return std::max(-low, high);
}

}  // namespace

std::vector<Box3> not_proved_to_keep(const ExactSurface& surface, const std::vector<Vec3>& places, const std::function<void()>& pause) {
  Points after;
  std::vector<bool> moves;
  double farthest = 0;
  bool nearest = true;
  for (std::size_t v = 0; v < places.size(); ++v) {
    after.emplace_back(places[v].x(), places[v].y(), places[v].z());
    moves.push_back(surface.points[v] != after[v]);
    if (!moves.back()) continue;
    const ExactPoint& from = surface.points[v];
    const double far = std::max({motion(from.x(), places[v].x()), motion(from.y(), places[v].y()), motion(from.z(), places[v].z())});
    farthest = std::max(farthest, far);
    nearest = nearest && far <= nearest_share * places[v].cwiseAbs().maxCoeff();
  }
  const auto moved = [&](const Triangle& t) { return moves[t[0]] || moves[t[1]] || moves[t[2]]; };
  // Floating point allows for more rounding than this: what it separates where they end was apart before.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> close;
  std::mutex guard;
  TriangleHierarchy(places, surface.triangles, 2 * farthest).overlapping_pairs([&](std::uint32_t s, std::uint32_t t) {
    const Triangle &a = surface.triangles[s], &b = surface.triangles[t];
    if ((moved(a) || moved(b)) && !(nearest && stay_apart(places, places, a, b))) {
      const std::lock_guard<std::mutex> lock(guard);
      close.emplace_back(s, t);
    }
    return true;
  });
  std::sort(close.begin(), close.end());
  std::vector<Box3> found;
  for (const auto& [s, t] : close) {
    pause();
    if (keep(surface.points, after, places, surface.triangles[s], surface.triangles[t])) continue;
    found.emplace_back();
    for (const std::uint32_t v : surface.triangles[s]) found.back().extend(places[v]);
  }
  return found;
}

}  // namespace starcell
