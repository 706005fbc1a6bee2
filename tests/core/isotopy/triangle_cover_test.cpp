// How far a triangle is from a surface: closed forms, surfaces with holes, overhangs, walls below an edge.
#include "isotopy/triangle_cover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "solids/connectivity.h"

namespace starcell {
namespace {

struct Surface {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

// [low, high]^2 in n x n squares, at a height that may vary.
Surface sheet(int n, double low, double high, const std::function<double(double, double)>& height) {
  Surface s;
  const double step = (high - low) / n;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) s.points.emplace_back(low + i * step, low + j * step, height(low + i * step, low + j * step));
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      s.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return s;
}

double bound_of(const Corners& t, const Surface& s, double most, double give = 0) {
  // Beyond an open edge is the triangle itself: nothing more to reach.
  const std::vector<Triangle> across = connect(s.points, s.triangles).neighbours;
  std::vector<std::uint32_t> seeds, used;
  std::vector<std::uint64_t> seen(s.triangles.size(), 0);
  for (std::uint32_t k = 0; k < s.triangles.size(); ++k) seeds.push_back(k);
  std::uint64_t stamp = 0;
  return cover_by_parts(
      t, seeds, [&](std::uint32_t k) { return Corners{s.points[s.triangles[k][0]], s.points[s.triangles[k][1]], s.points[s.triangles[k][2]]}; },
      [&](std::uint32_t k, int edge) { return across[k][edge] == kNoTriangle ? k : across[k][edge]; }, most, 1e-14, give, used, seen, stamp);
}

const Corners flat{Vec3(0.1, 0.2, 0), Vec3(0.9, 0.3, 0), Vec3(0.4, 0.8, 0)};

TEST(TriangleCover, OfAParallelSheetIsItsHeight) {
  for (const double h : {0.0, 0.1, -0.25}) EXPECT_NEAR(bound_of(flat, sheet(7, 0, 1, [h](double, double) { return h; }), 1), std::abs(h), 1e-9);
}

// A sheet that rises to 0.2 in the middle of T: no less than there, and no more than its highest point.
TEST(TriangleCover, OfABumpIsItsHeight) {
  const auto bump = [](double x, double y) { return 0.2 * std::max(0.0, 1 - 4 * std::hypot(x - 0.45, y - 0.4)); };
  const double bound = bound_of(flat, sheet(40, 0, 1, bump), 1);
  EXPECT_GT(bound, 0.15);
  EXPECT_LE(bound, 0.2 + 1e-9);
}

// A pit with steep walls under T, deeper than the error: what is over it is near its rim, as far as 0.05 away.
TEST(TriangleCover, SeesPits) {
  const auto pit = [](double x, double y) { return std::max(std::abs(x - 0.45), std::abs(y - 0.45)) < 0.05 - 1e-9 ? -5.0 : 0.0; };
  const Surface s = sheet(100, 0, 1, pit);
  EXPECT_FALSE(bound_of(flat, s, 0.03) <= 0.03);
  const double bound = bound_of(flat, s, 0.3);
  EXPECT_GE(bound, 0.04);
  EXPECT_LE(bound, 0.3);
}

// T reaches 0.1 beyond the end of the sheet, with a wall that falls from there, straight or back under T.
TEST(TriangleCover, ReachesBeyondAnEdge) {
  for (const double back : {0.0, 0.3}) {
    Surface s = sheet(8, 0, 0.8, [](double, double) { return 0.0; });
    const auto n = static_cast<std::uint32_t>(s.points.size());
    for (int j = 0; j <= 8; ++j) s.points.emplace_back(0.8 - back, 0.1 * j, -9);   // far below: where the wall ends is no matter
    for (std::uint32_t j = 0; j < 8; ++j) {
      const std::uint32_t p = 72 + j;   // the sheet's last row
      s.triangles.push_back({p, n + j, n + j + 1});
      s.triangles.push_back({p, n + j + 1, p + 1});
    }
    const Corners over{Vec3(0.1, 0.2, 0), Vec3(0.9, 0.3, 0), Vec3(0.4, 0.7, 0)};
    const double bound = bound_of(over, s, 0.2, 0.01);
    double nearest = 1;
    for (const Triangle& u : s.triangles) nearest = std::min(nearest, distance_to_triangle(over[1], {s.points[u[0]], s.points[u[1]], s.points[u[2]]}));
    EXPECT_NEAR(nearest, 0.1, 1e-12) << back;
    EXPECT_GE(bound, 0.1 - 1e-9) << back;
    EXPECT_LE(bound, 0.2) << back;
    EXPECT_FALSE(bound_of(over, s, 0.09, 0.004) <= 0.09) << back;
  }
}

// Against brute force: random triangles over a random relief; the bound is never below a sampled distance.
TEST(TriangleCover, IsNeverTooSmall) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> d(0, 1);
  int proved = 0;
  for (int k = 0; k < 60; ++k) {
    Surface s = sheet(12, -0.5, 1.5, [&](double, double) { return 0.1 * d(random); });
    const Corners t{Vec3(d(random), d(random), 0.1 * d(random)), Vec3(d(random), d(random), 0.1 * d(random)), Vec3(d(random), d(random), 0.1 * d(random))};
    Corners facing = t;
    if ((t[1] - t[0]).cross(t[2] - t[0]).z() < 0) std::swap(facing[1], facing[2]);
    const double bound = bound_of(facing, s, 0.5, 0.01);
    if (!std::isfinite(bound)) continue;
    ++proved;
    for (int sample = 0; sample < 200; ++sample) {
      Vec3 w(d(random), d(random), d(random));
      w /= w.sum();
      const Vec3 x = w[0] * facing[0] + w[1] * facing[1] + w[2] * facing[2];
      double nearest = 1e9;
      for (const Triangle& u : s.triangles) nearest = std::min(nearest, distance_to_triangle(x, {s.points[u[0]], s.points[u[1]], s.points[u[2]]}));
      ASSERT_LE(nearest, bound);
    }
  }
  EXPECT_GT(proved, 50);
}

}  // namespace
}  // namespace starcell
