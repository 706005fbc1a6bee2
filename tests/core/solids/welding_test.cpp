// Welding joins what is equal, and nothing else.
#include "solids/welding.h"

#include <gtest/gtest.h>

#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;

std::vector<std::int32_t> kNoLabels;

TEST(Welding, JoinsASoupIntoItsMesh) {
  const Mesh cube = box({0, 0, 0}, {1, 1, 1});
  Mesh soup;  // as an STL file has it: three vertices a triangle
  for (const Triangle& t : cube.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.vertices.size());
    for (std::uint32_t v : t) soup.vertices.push_back(cube.vertices[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  EXPECT_EQ(weld(soup.vertices, soup.triangles, kNoLabels), 0u);
  EXPECT_EQ(soup.vertices.size(), 8u);
  for (std::size_t t = 0; t < 12; ++t)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(soup.vertices[soup.triangles[t][k]], cube.vertices[cube.triangles[t][k]]);
}

TEST(Welding, TakesMinusZeroForZero) {
  std::vector<Vec3> vertices = {{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {0, 0, 1}};
  std::vector<Triangle> triangles = {{0, 1, 2}, {3, 2, 4}};
  weld(vertices, triangles, kNoLabels);
  EXPECT_EQ(vertices.size(), 4u);
  EXPECT_EQ(triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  for (const Vec3& p : vertices)
    for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(std::signbit(p[axis]));
}

TEST(Welding, KeepsNeighbouringNumbersApart) {
  const double next = std::nextafter(1.0, 2.0);  // the closest that two doubles can be
  std::vector<Vec3> vertices = {{1, 1, 1}, {next, 1, 1}, {1, next, 1}};
  std::vector<Triangle> triangles = {{0, 1, 2}};
  EXPECT_EQ(weld(vertices, triangles, kNoLabels), 0u);
  EXPECT_EQ(vertices.size(), 3u);
}

TEST(Welding, DropsUnusedVerticesAndKeepsTheOrder) {
  std::vector<Vec3> vertices = {{9, 9, 9}, {2, 0, 0}, {8, 8, 8}, {1, 0, 0}, {0, 0, 3}, {7, 7, 7}};
  std::vector<Triangle> triangles = {{4, 3, 1}};
  weld(vertices, triangles, kNoLabels);
  EXPECT_EQ(vertices, (std::vector<Vec3>{{2, 0, 0}, {1, 0, 0}, {0, 0, 3}}));
  EXPECT_EQ(triangles, (std::vector<Triangle>{{2, 1, 0}}));
}

TEST(Welding, DropsTrianglesThatRepeatAVertexWithTheirLabels) {
  std::vector<Vec3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  std::vector<Triangle> triangles = {{0, 1, 1}, {0, 1, 2}, {0, 3, 2}};  // the last repeats a vertex once 3 is 0
  std::vector<std::int32_t> labels = {5, 6, 7};
  EXPECT_EQ(weld(vertices, triangles, labels), 2u);
  EXPECT_EQ(triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(labels, (std::vector<std::int32_t>{6}));
}

TEST(Welding, TakesNothing) {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  EXPECT_EQ(weld(vertices, triangles, kNoLabels), 0u);
}

}  // namespace
}  // namespace starcell
