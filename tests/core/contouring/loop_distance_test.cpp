// Bounds of the Fréchet distance of closed polylines, against what is known and against samples.
#include "contouring/loop_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace starcell {
namespace {

// A regular hexagon of radius 1, one of whose corners is left out: the chord passes it at a distance of 1/2.
TEST(LoopDistance, OfALoopThatLeavesACornerOut) {
  std::vector<Vec3> hexagon, without;
  for (int k = 0; k < 6; ++k) hexagon.emplace_back(std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0);
  for (int k : {4, 5, 0, 1, 3}) without.push_back(hexagon[static_cast<std::size_t>(k)]);   // and it starts elsewhere
  EXPECT_NEAR(loop_distance(hexagon, without, 1e-9), 0.5, 1e-12);
  EXPECT_NEAR(loop_distance(without, hexagon, 1e-9), 0.5, 1e-12);
  EXPECT_LE(loop_distance(hexagon, hexagon, 1e-9), 1e-12);
}

TEST(LoopDistance, IsInfiniteWithoutACommonPoint) {
  const std::vector<Vec3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Vec3> moved = triangle;
  for (Vec3& p : moved) p.z() += 0.1;
  EXPECT_TRUE(std::isinf(loop_distance(triangle, moved, 1e-3)));
  EXPECT_NEAR(loop_distance(triangle, moved, 0.2), 0.1, 1e-12);
}

double distance_to(const std::vector<Vec3>& loop, const Vec3& x) {
  double nearest = 1e300;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 a = loop[k], d = loop[(k + 1) % loop.size()] - a;
    nearest = std::min(nearest, (a + std::clamp((x - a).dot(d) / d.squaredNorm(), 0.0, 1.0) * d - x).norm());
  }
  return nearest;
}

// Of two loops with some corners in common, no point is farther from the other loop.
TEST(LoopDistance, IsNoLessThanTheHausdorffDistance) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> real(-0.2, 0.2);
  for (int round = 0; round < 200; ++round) {
    const auto n = 3 + random() % 8;
    std::vector<Vec3> p, q;
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(n);
      const Vec3 corner(std::cos(angle), std::sin(angle), real(random));
      const bool common = k == 0 || random() % 2 == 0;
      if (common || random() % 2 == 0) p.push_back(corner);
      if (common) q.push_back(corner);
      if (!common && random() % 2 == 0) q.push_back(corner + Vec3(real(random), real(random), real(random)));
    }
    if (p.size() < 3 || q.size() < 3) continue;
    std::rotate(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(random() % q.size()), q.end());
    const double bound = loop_distance(p, q, 1e-9);
    ASSERT_TRUE(std::isfinite(bound));
    for (const auto& [from, to] : {std::pair(&p, &q), std::pair(&q, &p)})
      for (std::size_t k = 0; k < from->size(); ++k)
        for (const double share : {0.0, 0.3, 0.5, 0.9})
          EXPECT_LE(distance_to(*to, (1 - share) * (*from)[k] + share * (*from)[(k + 1) % from->size()]), bound + 1e-12);
  }
}

}  // namespace
}  // namespace starcell
