// Decimation against its own words: topology by counting, embedding by the exact test, distances by brute force from both sides.
#include "decimation/decimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "isotopy/star_map.h"
#include "solids/point_distance.h"
#include "solids/self_intersection.h"
#include "solids/upward_ray.h"

namespace starcell {
namespace {

struct Sample {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

// A torus of n x m quads, its points jittered.
Sample torus(std::uint32_t n, std::uint32_t m, double jitter, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> by(-jitter, jitter);
  Sample s;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const double u = 2 * M_PI * i / n, v = 2 * M_PI * j / m, r = 2 + 0.7 * std::cos(v);
      s.vertices.emplace_back(r * std::cos(u) + by(random), r * std::sin(u) + by(random), 0.7 * std::sin(v) + by(random));
      const std::uint32_t a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m, d = i * m + (j + 1) % m;
      s.triangles.push_back({a, b, c});
      s.triangles.push_back({a, c, d});
    }
  return s;
}

// A cube whose sides are n x n squares each; the points of its sides are shared.
Sample cube(int n) {
  Sample s;
  std::map<std::array<int, 3>, std::uint32_t> number;
  const auto at = [&](std::array<int, 3> p) {
    const auto [it, fresh] = number.emplace(p, static_cast<std::uint32_t>(s.vertices.size()));
    if (fresh) s.vertices.emplace_back(p[0], p[1], p[2]);
    return it->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool top : {false, true})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> p{};
            p[axis] = top ? n : 0, p[(axis + 1) % 3] = i + di, p[(axis + 2) % 3] = j + dj;
            return at(p);
          };
          std::array<std::uint32_t, 4> q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (!top) std::swap(q[1], q[3]);
          s.triangles.push_back({q[0], q[1], q[2]});
          s.triangles.push_back({q[0], q[2], q[3]});
        }
  return s;
}

// The farthest that points of `from` are from `to`, at corners and random places of its triangles.
double farthest(const std::vector<Vec3>& from, const std::vector<Triangle>& from_triangles, const std::vector<Vec3>& to,
                const std::vector<Triangle>& to_triangles, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0, 1);
  double farthest = 0;
  for (const Triangle& t : from_triangles)
    for (int k = 0; k < 3; ++k) {
      Vec3 w(weight(random), weight(random), weight(random));
      if (k == 0) w = Vec3(1, 0, 0);
      const Vec3 p = (w[0] * from[t[0]] + w[1] * from[t[1]] + w[2] * from[t[2]]) / w.sum();
      double nearest = std::numeric_limits<double>::infinity();
      for (const Triangle& s : to_triangles) nearest = std::min(nearest, sample::to_triangle(p, to[s[0]], to[s[1]], to[s[2]]));
      farthest = std::max(farthest, nearest);
    }
  return farthest;
}

void expect_sound(const Sample& s, const Decimated& d, double most, int euler) {
  EXPECT_LE(d.bound, most);
  EXPECT_TRUE(connect(d.vertices, d.triangles).closed_manifold());
  EXPECT_EQ(static_cast<int>(d.vertices.size()) - static_cast<int>(d.triangles.size()) / 2, euler);
  const SelfIntersections met = find_self_intersections(d.vertices, d.triangles, TriangleHierarchy(d.vertices, d.triangles));
  EXPECT_EQ(met.pairs.count + met.zero_area.count, 0u);
  EXPECT_LE(farthest(s.vertices, s.triangles, d.vertices, d.triangles, 1), d.bound);
  EXPECT_LE(farthest(d.vertices, d.triangles, s.vertices, s.triangles, 2), d.bound);
}

TEST(Decimate, KeepsATorusWithinItsBound) {
  for (const double most : {0.03, 0.06, 0.2}) {
    const Sample s = torus(40, 20, 0.01, 3);
    const Decimated d = decimate(s.vertices, s.triangles, most);
    expect_sound(s, d, most, 0);
    EXPECT_LT(d.triangles.size(), s.triangles.size() * 3 / 4);
  }
}

// Flat sides and sharp edges cost nothing: 12 triangles are left, and no distance but rounding.
TEST(Decimate, TakesAllOfFlatSides) {
  const Sample s = cube(6);
  const Decimated d = decimate(s.vertices, s.triangles, 1e-6);
  expect_sound(s, d, 1e-6, 2);
  EXPECT_EQ(d.triangles.size(), 12u);
  EXPECT_LT(d.bound, 1e-7);
}

// However much is allowed, a torus stays one.
TEST(Decimate, NeverChangesTopology) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Sample s = torus(16, 8, 0.05, seed);
    expect_sound(s, decimate(s.vertices, s.triangles, 1e3), 1e3, 0);
  }
}

// Two sheets 0.02 apart, and far more allowed than that: they must not cross.
TEST(Decimate, KeepsSheetsApart) {
  Sample s = torus(30, 16, 0.0, 0);
  const auto n = static_cast<std::uint32_t>(s.vertices.size());
  for (std::uint32_t v = 0; v < n; ++v) {
    const Vec3 p = s.vertices[v], center = 2 * Vec3(p.x(), p.y(), 0).normalized();
    s.vertices.push_back(center + (p - center) * (0.68 / 0.7));
  }
  const std::size_t m = s.triangles.size();
  for (std::size_t t = 0; t < m; ++t) s.triangles.push_back({s.triangles[t][0] + n, s.triangles[t][2] + n, s.triangles[t][1] + n});
  expect_sound(s, decimate(s.vertices, s.triangles, 0.5), 0.5, 0);
}

TEST(Decimate, StopsWhenAsked) {
  const Sample s = torus(40, 20, 0.01, 3);
  EXPECT_GT(decimate(s.vertices, s.triangles, 0.2, [](double) { return false; }).triangles.size(), decimate(s.vertices, s.triangles, 0.2).triangles.size());
}

// A square pyramid's four sides, and a fan about a point of its base: a graph over them. Folded over, as long as nothing leaves the base.
TEST(StarMap, TellsGraphs) {
  const std::vector<Vec3> rim{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Vec3 apex(0.5, 0.5, 0.3);
  std::vector<Corners> before, fan;
  for (std::size_t k = 0; k < 4; ++k) before.push_back({apex, rim[k], rim[(k + 1) % 4]});
  for (std::size_t k = 0; k < 4; ++k) fan.push_back({Vec3(0.25, 0.5, 0), rim[k], rim[(k + 1) % 4]});
  EXPECT_TRUE(is_graph_over(before, fan, Vec3(0, 0, 1)));
  // The apex beyond the fourth side, that side turned over.
  for (Corners& t : before) t[0] = Vec3(0.1, 0.5, 0.3);
  before[3] = {Vec3(0.1, 0.5, 0.3), rim[3], Vec3(0.3, 0.5, 0)};
  before.push_back({Vec3(0.1, 0.5, 0.3), Vec3(0.3, 0.5, 0), rim[0]});
  before.push_back({Vec3(0.3, 0.5, 0), rim[3], rim[0]});
  EXPECT_TRUE(is_graph_over(before, fan, Vec3(0, 0, 1)));
  before[3][2] = before[4][1] = before[5][0] = Vec3(-0.1, 0.5, 0);   // beyond the rim
  EXPECT_FALSE(is_graph_over(before, fan, Vec3(0, 0, 1)));
  EXPECT_FALSE(is_graph_over(before, fan, Vec3(1, 0, 0)));   // seen on edge
  std::swap(fan[0][1], fan[0][2]);
  EXPECT_FALSE(is_graph_over(before, fan, Vec3(0, 0, 1)));   // folded
}

// A tiny ball beside a large one's surface: collapses that pass over it would leave it on the other side.
TEST(Decimate, PassesOverNothing) {
  Sample s = torus(24, 12, 0.0, 0);
  const auto inside = [&](const std::vector<Vec3>& v, const std::vector<Triangle>& triangles, const Vec3& x) {
    bool in = false;
    for (const Triangle& t : triangles) in ^= is_above(v[t[0]], v[t[1]], v[t[2]], x);
    return in;
  };
  // Thirty balls of 0.01 just outside, in the dents between ridges that a coarser torus has no room for.
  const std::size_t m = s.triangles.size();
  std::vector<Vec3> middles;
  for (std::size_t t = 0; t < m; t += m / 30) {
    const Vec3 &a = s.vertices[s.triangles[t][0]], &b = s.vertices[s.triangles[t][1]], &c = s.vertices[s.triangles[t][2]];
    middles.push_back((a + b + c) / 3 + 0.03 * (b - a).cross(c - a).normalized());
  }
  for (const Vec3& x : middles) {
    const auto n = static_cast<std::uint32_t>(s.vertices.size());
    for (const Vec3& d : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) s.vertices.push_back(x + 0.01 * d);
    for (const Triangle& t : {Triangle{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}) s.triangles.push_back({n + t[0], n + t[1], n + t[2]});
  }
  const Decimated d = decimate(s.vertices, s.triangles, 0.3);
  EXPECT_LT(d.triangles.size(), s.triangles.size() / 2);
  // The largest component is the torus; every other one is a ball, and still outside it.
  std::vector<std::uint32_t> root(d.vertices.size());
  for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = v;
  const std::function<std::uint32_t(std::uint32_t)> find = [&](std::uint32_t v) { return root[v] == v ? v : root[v] = find(root[v]); };
  for (const Triangle& t : d.triangles) root[find(t[1])] = find(t[0]), root[find(t[2])] = find(t[0]);
  std::map<std::uint32_t, std::vector<Triangle>> pieces;
  for (const Triangle& t : d.triangles) pieces[find(t[0])].push_back(t);
  ASSERT_EQ(pieces.size(), middles.size() + 1);
  const auto largest = std::max_element(pieces.begin(), pieces.end(), [](const auto& p, const auto& q) { return p.second.size() < q.second.size(); });
  for (const auto& [at, triangles] : pieces)
    if (at != largest->first) EXPECT_FALSE(inside(d.vertices, largest->second, d.vertices[triangles[0][0]]));
}

}  // namespace
}  // namespace starcell
