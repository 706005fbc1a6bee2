#include "contouring/straight_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "numerics/linear_program.h"

namespace starcell {
namespace {

// Rounding of a dot product of unit normals with differences of coordinates, generously.
double slack(const std::vector<Vec3>& v, const Triangle& s) { return 1e-14 * (v[s[0]].cwiseAbs().maxCoeff() + (v[s[1]] - v[s[0]]).norm()); }

struct Pair {
  std::vector<std::uint32_t> shared, s, t;   // common vertices, and those of one only
};

Pair split(const Triangle& s, const Triangle& t) {
  Pair pair;
  for (const std::uint32_t v : s) (std::find(t.begin(), t.end(), v) != t.end() ? pair.shared : pair.s).push_back(v);
  for (const std::uint32_t v : t)
    if (std::find(s.begin(), s.end(), v) == s.end()) pair.t.push_back(v);
  return pair;
}

// How far t lies beyond s along n; with common vertices the smaller of both sides' distances from them.
double gap(const std::vector<Vec3>& v, const Pair& pair, const Vec3& n) {
  if (pair.shared.empty()) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const Vec3& origin = v[pair.s[0]];
    for (const std::uint32_t x : pair.t) low = std::min(low, n.dot(v[x] - origin));
    for (const std::uint32_t x : pair.s) high = std::max(high, n.dot(v[x] - origin));
    return low - high;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t p : pair.shared) {
    for (const std::uint32_t x : pair.t) least = std::min(least, n.dot(v[x] - v[p]));
    for (const std::uint32_t x : pair.s) least = std::min(least, -n.dot(v[x] - v[p]));
  }
  return least;
}

Vec3 normal_of(const std::vector<Vec3>& v, const Triangle& t) { return (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]); }

std::vector<Vec3> candidates(const std::vector<Vec3>& v, const Triangle& s, const Triangle& t, const Pair& pair) {
  std::vector<Vec3> all{normal_of(v, s), normal_of(v, t), normal_of(v, s) + normal_of(v, t), normal_of(v, s) - normal_of(v, t)};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) all.push_back((v[s[(i + 1) % 3]] - v[s[i]]).cross(v[t[(j + 1) % 3]] - v[t[j]]));
  // In a common plane: across each edge.
  for (int i = 0; i < 3; ++i) {
    all.push_back((v[s[(i + 1) % 3]] - v[s[i]]).cross(normal_of(v, s)));
    all.push_back((v[t[(i + 1) % 3]] - v[t[i]]).cross(normal_of(v, t)));
  }
  // Around a common vertex: between each two sides that leave it.
  const Vec3 upright = normal_of(v, s).normalized() + (normal_of(v, s).dot(normal_of(v, t)) < 0 ? -1.0 : 1.0) * normal_of(v, t).normalized();
  if (pair.shared.size() == 1)
    for (const std::uint32_t x : pair.s)
      for (const std::uint32_t y : pair.t) {
        const Vec3 &p = v[pair.shared[0]];
        all.push_back(((v[x] - p).normalized() + (v[y] - p).normalized()).cross(upright));
        all.push_back((v[y] - p).normalized() - (v[x] - p).normalized());
      }
  std::vector<Vec3> units;
  for (const Vec3& n : all)
    if (n.norm() > 0) units.push_back(n.normalized()), units.push_back(-n.normalized());
  return units;
}

// One normal for both times, by the small linear program: its answer is a hint like any other candidate.
std::optional<Vec3> common_normal(const std::vector<Vec3>& start, const std::vector<Vec3>& end, const Pair& pair) {
  std::vector<Vec3> ways;
  for (const auto* v : {&start, &end}) {
    if (pair.shared.empty()) {
      for (const std::uint32_t x : pair.s)
        for (const std::uint32_t y : pair.t) ways.push_back((*v)[y] - (*v)[x]);
    } else {
      for (const std::uint32_t x : pair.s) ways.push_back((*v)[pair.shared[0]] - (*v)[x]);
      for (const std::uint32_t y : pair.t) ways.push_back((*v)[y] - (*v)[pair.shared[0]]);
    }
  }
  // Nearly in one plane: stretched across it, lest the program takes the difference that matters for rounding.
  Vec3 across = Vec3::Zero();
  for (std::size_t i = 0; i < ways.size(); ++i)
    for (std::size_t j = i + 1; j < ways.size(); ++j)
      if (const Vec3 c = ways[i].cross(ways[j]); c.norm() > across.norm()) across = c;
  if (!(across.norm() > 0)) return std::nullopt;
  across.normalize();
  double thick = 0, wide = 0;
  for (const Vec3& w : ways) thick = std::max(thick, std::abs(w.dot(across))), wide = std::max(wide, w.norm());
  const double stretch = thick > 0 ? wide / thick : 1;
  for (Vec3& w : ways) {
    w += (stretch - 1) * w.dot(across) * across;
    if (!(w.norm() > 0)) return std::nullopt;
    w.normalize();
  }
  auto n = widest_direction(ways);
  if (!n || !(n->norm() > 0)) return std::nullopt;
  *n += (stretch - 1) * n->dot(across) * across;
  return n->normalized();
}

double det(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

// Places between start and end are rounded: how far the differences of two of them are off. Generous by a factor of four.
double place_rounding(const std::vector<Vec3>& v0, const std::vector<Vec3>& v1, const Pair& pair) {
  const std::uint32_t p = pair.shared[0];
  const double reach = std::max(v0[p].cwiseAbs().maxCoeff(), v1[p].cwiseAbs().maxCoeff()) + (v0[pair.s[0]] - v0[p]).norm() +
                       (v0[pair.t[0]] - v0[p]).norm();
  return 4e-15 * reach;
}

// Bernstein coefficients of the volume over the edge: one sign throughout.
bool keeps_volume(const std::vector<Vec3>& v0, const std::vector<Vec3>& v1, const Pair& pair) {
  const std::uint32_t p = pair.shared[0], q = pair.shared[1], a = pair.s[0], b = pair.t[0];
  const Vec3 u0 = v0[q] - v0[p], u1 = v1[q] - v1[p], x0 = v0[a] - v0[p], x1 = v1[a] - v1[p], y0 = v0[b] - v0[p], y1 = v1[b] - v1[p];
  const double c[4] = {det(u0, x0, y0), (det(u1, x0, y0) + det(u0, x1, y0) + det(u0, x0, y1)) / 3,
                       (det(u1, x1, y0) + det(u1, x0, y1) + det(u0, x1, y1)) / 3, det(u1, x1, y1)};
  const double u = std::max(u0.norm(), u1.norm()), x = std::max(x0.norm(), x1.norm()), y = std::max(y0.norm(), y1.norm());
  const double r = place_rounding(v0, v1, pair), error = 1e-14 * u * x * y + r * (u * x + x * y + y * u);
  return std::all_of(c, c + 4, [&](double x) { return x > error; }) || std::all_of(c, c + 4, [&](double x) { return x < -error; });
}

// They meet beyond their edge only while they are coplanar and on the same side of it. On opposite sides throughout: the
// Bernstein coefficients of (u x x) . (u x y), of degree four, are all negative.
bool stays_wide(const std::vector<Vec3>& v0, const std::vector<Vec3>& v1, const Pair& pair) {
  const std::uint32_t p = pair.shared[0], q = pair.shared[1], a = pair.s[0], b = pair.t[0];
  const Vec3 u0 = v0[q] - v0[p], u1 = v1[q] - v1[p], x0 = v0[a] - v0[p], x1 = v1[a] - v1[p], y0 = v0[b] - v0[p], y1 = v1[b] - v1[p];
  const Vec3 c0 = u0.cross(x0), c1 = 0.5 * (u0.cross(x1) + u1.cross(x0)), c2 = u1.cross(x1);
  const Vec3 d0 = u0.cross(y0), d1 = 0.5 * (u0.cross(y1) + u1.cross(y0)), d2 = u1.cross(y1);
  const double e[5] = {c0.dot(d0), 0.5 * (c0.dot(d1) + c1.dot(d0)), (c0.dot(d2) + 4 * c1.dot(d1) + c2.dot(d0)) / 6,
                       0.5 * (c1.dot(d2) + c2.dot(d1)), c2.dot(d2)};
  const double u = std::max(u0.norm(), u1.norm()), x = std::max(x0.norm(), x1.norm()), y = std::max(y0.norm(), y1.norm());
  const double r = place_rounding(v0, v1, pair), dc = 1e-15 * u * x + 2 * r * (u + x), dd = 1e-15 * u * y + 2 * r * (u + y);
  const double error = std::max({c0.norm(), c1.norm(), c2.norm()}) * dd + std::max({d0.norm(), d1.norm(), d2.norm()}) * dc + dc * dd;
  return std::all_of(e, e + 5, [&](double x) { return x < -error; });
}

bool apart_on_the_way(const std::vector<Vec3>& start, const std::vector<Vec3>& end, const Triangle& s, const Triangle& t,
                      const Pair& pair) {
  if (pair.shared.size() == 2) return keeps_volume(start, end, pair) || stays_wide(start, end, pair);
  const double error = slack(start, s) + slack(start, t) + slack(end, s) + slack(end, t);
  for (const auto* v : {&start, &end})
    for (const Vec3& n : candidates(*v, s, t, pair))
      if (gap(start, pair, n) > error && gap(end, pair, n) > error) return true;
  const auto n = common_normal(start, end, pair);
  return n && gap(start, pair, *n) > error && gap(end, pair, *n) > error;
}

// A motion that turns too far for one normal is looked at in halves; a half's straight motion is the whole's.
bool apart_throughout(const std::vector<Vec3>& start, const std::vector<Vec3>& end, const Triangle& s, const Triangle& t,
                      const Pair& pair, int depth) {
  if (pair.shared.size() == 3) return false;
  if (apart_on_the_way(start, end, s, t, pair)) return true;
  if (depth == 7) return false;
  std::vector<Vec3> middle;
  for (std::size_t v = 0; v < start.size(); ++v) middle.push_back(0.5 * (start[v] + end[v]));
  return apart_throughout(start, middle, s, t, pair, depth + 1) && apart_throughout(middle, end, s, t, pair, depth + 1);
}

}  // namespace

bool stay_apart(const std::vector<Vec3>& start, const std::vector<Vec3>& end, const Triangle& s, const Triangle& t) {
  // The few vertices concerned, and their places at the two times.
  std::vector<std::uint32_t> ids(s.begin(), s.end());
  for (const std::uint32_t v : t)
    if (std::find(s.begin(), s.end(), v) == s.end()) ids.push_back(v);
  std::vector<Vec3> from, to;
  for (const std::uint32_t v : ids) from.push_back(start[v]), to.push_back(end[v]);
  const auto local = [&](std::uint32_t v) { return static_cast<std::uint32_t>(std::find(ids.begin(), ids.end(), v) - ids.begin()); };
  const Triangle ls{local(s[0]), local(s[1]), local(s[2])}, lt{local(t[0]), local(t[1]), local(t[2])};
  return apart_throughout(from, to, ls, lt, split(ls, lt), 0);
}

Vec3 separating_normal(const std::vector<Vec3>& vertices, const Triangle& s, const Triangle& t) {
  const Pair pair = split(s, t);
  Vec3 best = Vec3::Zero();
  if (pair.shared.size() == 3) return best;
  if (pair.shared.size() == 2) {
    // Across the edge: from one triangle's plane to the other's apex.
    const Vec3 n = normal_of(vertices, s).normalized();
    const double height = n.dot(vertices[pair.t[0]] - vertices[pair.shared[0]]);
    return height > 0 ? n : height < 0 ? Vec3(-n) : best;
  }
  double most = 0;
  for (const Vec3& n : candidates(vertices, s, t, pair)) {
    const double g = gap(vertices, pair, n);
    if (g > most) most = g, best = n;
  }
  return best;
}

}  // namespace starcell
