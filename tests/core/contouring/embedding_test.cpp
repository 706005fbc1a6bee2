#include "contouring/embedding.h"

#include <gtest/gtest.h>

#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;

std::vector<std::uint32_t> meeting_triangles(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, RoundedAxes rounded) {
  return triangles_of(meeting_pairs(vertices, triangles, {rounded}).front());
}

TEST(Embedding, AClosedMeshOfNeighboursDoesNotMeetItself) {
  const Mesh mesh = torus(12, 8);
  EXPECT_TRUE(meeting_triangles(mesh.vertices, mesh.triangles, no_axis).empty());
  EXPECT_TRUE(meeting_triangles(mesh.vertices, mesh.triangles, all_axes).empty());
}

// Triangle 0 stands through triangle 1; triangle 2 is far away.
TEST(Embedding, CrossingTrianglesAreNamed) {
  const std::vector<Vec3> v{{0, 0, -1}, {1, 0, 1}, {0, 0, 1}, {-1, -1, 0}, {2, -1, 0}, {0, 2, 0}, {9, 9, 9}, {10, 9, 9}, {9, 10, 9}};
  const std::vector<Triangle> t{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  EXPECT_EQ(meeting_triangles(v, t, no_axis), (std::vector<std::uint32_t>{0, 1}));
}

// 10^-9 apart near 1 is apart in double; both heights are the same float32.
TEST(Embedding, WhatFloat32BringsTogetherIsNamedOnlyThere) {
  const double up = 1 + 1e-9;
  const std::vector<Vec3> v{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.1, 0.1, up}, {0.9, 0.1, up}, {0.1, 0.9, up}};
  const std::vector<Triangle> t{{0, 1, 2}, {3, 4, 5}};
  EXPECT_TRUE(meeting_triangles(v, t, no_axis).empty());
  EXPECT_EQ(meeting_triangles(v, t, all_axes), (std::vector<std::uint32_t>{0, 1}));
}

// The same, and heights are the third axis: rounding the others alone keeps the triangles apart.
TEST(Embedding, EveryRoundingIsAskedByItself) {
  const double up = 1 + 1e-9;
  const std::vector<Vec3> v{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.1, 0.1, up}, {0.9, 0.1, up}, {0.1, 0.9, up}};
  const std::vector<Triangle> t{{0, 1, 2}, {3, 4, 5}};
  const auto meeting = meeting_pairs(v, t, {no_axis, 1, 2, 4, all_axes});
  ASSERT_EQ(meeting.size(), 5u);
  for (const int k : {0, 1, 2}) EXPECT_TRUE(meeting[k].empty()) << k;
  for (const int k : {3, 4}) EXPECT_EQ(meeting[k], (std::vector<MeetingPair>{{0, 1}})) << k;
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
