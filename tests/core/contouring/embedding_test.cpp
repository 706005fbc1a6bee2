#include "contouring/embedding.h"

#include <gtest/gtest.h>

#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;

TEST(Embedding, AClosedMeshOfNeighboursDoesNotMeetItself) {
  const Mesh mesh = torus(12, 8);
  EXPECT_TRUE(meeting_triangles(mesh.vertices, mesh.triangles, false).empty());
  EXPECT_TRUE(meeting_triangles(mesh.vertices, mesh.triangles, true).empty());
}

// Triangle 0 stands through triangle 1; triangle 2 is far away.
TEST(Embedding, CrossingTrianglesAreNamed) {
  const std::vector<Vec3> v{{0, 0, -1}, {1, 0, 1}, {0, 0, 1}, {-1, -1, 0}, {2, -1, 0}, {0, 2, 0}, {9, 9, 9}, {10, 9, 9}, {9, 10, 9}};
  const std::vector<Triangle> t{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  EXPECT_EQ(meeting_triangles(v, t, false), (std::vector<std::uint32_t>{0, 1}));
}

// 10^-9 apart near 1 is apart in double; both heights are the same float32.
TEST(Embedding, WhatFloat32BringsTogetherIsNamedOnlyThere) {
  const double up = 1 + 1e-9;
  const std::vector<Vec3> v{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.1, 0.1, up}, {0.9, 0.1, up}, {0.1, 0.9, up}};
  const std::vector<Triangle> t{{0, 1, 2}, {3, 4, 5}};
  EXPECT_TRUE(meeting_triangles(v, t, false).empty());
  EXPECT_EQ(meeting_triangles(v, t, true), (std::vector<std::uint32_t>{0, 1}));
}

TEST(Embedding, FansThatCrossMeet) {
  std::vector<Vec3> v{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.6, 0.5, 1}, {0.5, 0.6, 1}};
  const Triangle a{0, 1, 2}, b{3, 4, 5};
  EXPECT_TRUE(fans_meet(v, &a, 1, &b, 1));
  v[3].z() = 0.5;
  EXPECT_FALSE(fans_meet(v, &a, 1, &b, 1));
}

}  // namespace
}  // namespace starcell
