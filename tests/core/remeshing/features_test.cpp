// Sharp edges: which they are, what they do when the mesh changes, and how much room they leave.
#include "remeshing/features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "remeshing/size_field.h"
#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using sample::Mesh;

constexpr double forty_degrees = 40 * M_PI / 180;

TEST(Features, OfABoxAreItsEdges) {
  const Mesh cube = sample::box({0, 0, 0}, {1, 2, 3});
  const Features features(cube.vertices, cube.triangles, forty_degrees, 0);
  EXPECT_EQ(features.size(), 12u);   // not the diagonals of its sides
  for (std::uint32_t v = 0; v < 8; ++v) {
    EXPECT_EQ(features.along(v).size(), 3u);
    EXPECT_FALSE(features.is_straight(v, cube.vertices));
  }
  EXPECT_EQ(runs(features, cube.vertices).size(), 12u);
  EXPECT_EQ(Features(cube.vertices, cube.triangles, 91 * M_PI / 180, 0).size(), 0u);
}

// A vertex between two corners makes two edges of one, on one run; without it they are one again.
TEST(Features, AreSplitAndStraightened) {
  Mesh cube = sample::box({0, 0, 0}, {1, 2, 3});
  Features features(cube.vertices, cube.triangles, forty_degrees, 0);
  const std::uint32_t a = 0, b = features.along(0)[0], middle = 8;
  cube.vertices.push_back(0.5 * (cube.vertices[a] + cube.vertices[b]));
  features.split(a, b, middle);
  EXPECT_FALSE(features.has(a, b));
  EXPECT_TRUE(features.has(a, middle) && features.has(middle, b));
  EXPECT_TRUE(features.is_straight(middle, cube.vertices));
  EXPECT_EQ(features.size(), 13u);
  EXPECT_EQ(runs(features, cube.vertices).size(), 12u);
  cube.vertices[middle] += Vec3(1e-9, 1e-9, 1e-9);   // a bend: the run ends there
  EXPECT_FALSE(features.is_straight(middle, cube.vertices));
  EXPECT_EQ(runs(features, cube.vertices).size(), 13u);
  features.straighten(middle);
  EXPECT_TRUE(features.has(a, b));
  EXPECT_EQ(features.size(), 12u);
}

// A needle in a flat side, its corner off the plane by less than its width counts: it faces anywhere, and makes nothing sharp.
TEST(Features, SliversHaveNoSay) {
  Mesh cube = sample::box({0, 0, 0}, {1, 1, 1});
  const auto top = [&](const Triangle& t) { return cube.vertices[t[0]].z() + cube.vertices[t[1]].z() + cube.vertices[t[2]].z() == 3; };
  std::vector<std::uint32_t> both;
  for (std::uint32_t t = 0; t < cube.triangles.size(); ++t)
    if (top(cube.triangles[t])) both.push_back(t);
  ASSERT_EQ(both.size(), 2u);
  // The diagonal opens into a needle up to a point beside its middle, which is a little too high.
  const Triangle s = cube.triangles[both[0]], t = cube.triangles[both[1]];
  std::vector<std::uint32_t> ends;
  for (const std::uint32_t v : s)
    if (std::count(t.begin(), t.end(), v)) ends.push_back(v);
  std::uint32_t k = 0;
  while (std::count(ends.begin(), ends.end(), s[k])) ++k;   // s[k], then the diagonal from p to q
  const std::uint32_t apex = s[k], p = s[(k + 1) % 3], q = s[(k + 2) % 3], middle = 8;
  const Vec3 half = 0.5 * (cube.vertices[p] + cube.vertices[q]);
  cube.vertices.push_back(half + 1e-4 * (cube.vertices[apex] - half) + Vec3(0, 0, 1e-4));
  cube.triangles[both[0]] = {apex, p, middle};
  cube.triangles.push_back({apex, middle, q});
  cube.triangles.push_back({p, q, middle});
  EXPECT_GT(Features(cube.vertices, cube.triangles, forty_degrees, 0).size(), 12u);
  EXPECT_EQ(Features(cube.vertices, cube.triangles, forty_degrees, 1e-3).size(), 12u);
}

// Sizes of a plate 10 x 10 x 0.5: its corners' shortest run is 0.5; a wall of less than the least changes nothing.
TEST(SizeField, LeavesNoMoreRoomThanSharpEdges) {
  const Mesh plate = sample::box({0, 0, 0}, {10, 10, 0.5});
  const Features features(plate.vertices, plate.triangles, forty_degrees, 0);
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const Triangle& t : plate.triangles)
    for (int k = 0; k < 3; ++k)
      if (t[k] < t[(k + 1) % 3]) edges.push_back({t[k], t[(k + 1) % 3]});
  for (const double s : sizes(plate.vertices, edges, features, std::vector<double>(8, 3.0), 0.1)) EXPECT_DOUBLE_EQ(s, 0.5);
  for (const double s : sizes(plate.vertices, edges, features, std::vector<double>(8, 3.0), 1.0)) EXPECT_DOUBLE_EQ(s, 3.0);
  std::vector<double> most(8, 3.0);
  most[0] = 2;   // what is asked for at one place holds about it, too: growing by 0.4 of the way
  const std::vector<double> graded = sizes(plate.vertices, edges, features, most, 1.0);
  for (std::uint32_t v = 0; v < 8; ++v) EXPECT_LE(graded[v], std::min(3.0, 2 + 0.4 * (plate.vertices[v] - plate.vertices[0]).norm() + 1e-12)) << v;
}

}  // namespace
}  // namespace starcell
