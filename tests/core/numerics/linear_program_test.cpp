// The programs only give hints; but hints for problems with an ample answer must be right, or every guard search fails.
#include "numerics/linear_program.h"

#include <gtest/gtest.h>

#include <random>

namespace starcell {
namespace {

Vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> gauss;
  return Vec3(gauss(random), gauss(random), gauss(random)).normalized();
}

// Normals are drawn within 80 degrees of a hidden direction, which is therefore an answer with margin cos 80 degrees.
TEST(LinearProgram, FindsADirectionThatSeesEveryNormal) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 hidden = random_unit(random);
    std::vector<Vec3> normals;
    while (normals.size() < 3u + i % 60)
      if (const Vec3 n = random_unit(random); n.dot(hidden) > 0.1736) normals.push_back(n);
    const auto u = widest_direction(normals);
    ASSERT_TRUE(u);
    for (const Vec3& n : normals) EXPECT_GT(n.dot(*u), 0);
  }
}

// u . x > 0 and u . (-x) > 0 exclude each other.
TEST(LinearProgram, OppositeNormalsHaveNoDirection) {
  EXPECT_FALSE(widest_direction({Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY()}));
}

// The normals of a tetrahedron add up to zero, so no direction sees them all.
TEST(LinearProgram, NormalsAroundACornerlessSolidHaveNoDirection) {
  EXPECT_FALSE(widest_direction({Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}));
}

// Planes tangent to a small ball inside the box: its centre is deep behind all of them.
TEST(LinearProgram, FindsAPointBehindEveryPlane) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> inner(-0.5, 0.5);
  const Box3 box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  for (int i = 0; i < 200; ++i) {
    const Vec3 centre(inner(random), inner(random), inner(random));
    std::vector<Vec3> normals, points;
    for (int k = 0; k < 4 + i % 40; ++k) {
      normals.push_back(random_unit(random));
      points.push_back(centre + 0.2 * normals.back());
    }
    const auto o = deepest_point(normals, points, box);
    ASSERT_TRUE(o);
    EXPECT_TRUE(box.contains(*o));
    for (std::size_t k = 0; k < normals.size(); ++k) EXPECT_GT(normals[k].dot(points[k] - *o), 0);
  }
}

// Left of x = 0 and right of x = 0.5.
TEST(LinearProgram, ContradictingPlanesHaveNoPoint) {
  const Box3 box(Vec3(-1, -1, -1), Vec3(1, 1, 1));
  EXPECT_FALSE(deepest_point({Vec3::UnitX(), -Vec3::UnitX()}, {Vec3(0, 0, 0), Vec3(0.5, 0, 0)}, box));
}

// The half-space x < -3 does not reach the box.
TEST(LinearProgram, APointOutsideTheBoxIsNoAnswer) {
  EXPECT_FALSE(deepest_point({Vec3::UnitX()}, {Vec3(-3, 0, 0)}, Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1))));
}

}  // namespace
}  // namespace starcell
