// Slivers thinner than a float32 step, and the proof that moving them apart is an isotopy.
#include "contouring/float_gaps.h"

#include <gtest/gtest.h>

#include "contouring/embedding.h"
#include "contouring/straight_motion.h"
#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;

// A plate near z = 100, where float32 steps are 7.6e-6 wide, and a tenth of a step thick: rounded, its sides coincide.
TEST(FloatGaps, AThinPlateIsOpened) {
  Mesh plate = box({100, 100, 100}, {103, 102, 100 + 7e-7});
  ASSERT_TRUE(meeting_pairs(plate.vertices, plate.triangles, {no_axis}).front().empty());
  ASSERT_FALSE(meeting_pairs(plate.vertices, plate.triangles, {all_axes}).front().empty());
  const FloatGaps gaps = open_float_gaps(plate.vertices, plate.triangles, 1e-3);
  ASSERT_TRUE(gaps.opened);
  EXPECT_LT(gaps.moved, 10 * 7.6e-6);
  EXPECT_TRUE(meeting_pairs(plate.vertices, plate.triangles, {no_axis}).front().empty());
  EXPECT_TRUE(meeting_pairs(plate.vertices, plate.triangles, {all_axes}).front().empty());
  EXPECT_GT(volume(plate.vertices, plate.triangles), 0) << "not turned inside out";
}

TEST(FloatGaps, NothingMovesIfThePermittedWayIsTooShort) {
  Mesh plate = box({100, 100, 100}, {103, 102, 100 + 7e-7});
  const std::vector<Vec3> before = plate.vertices;
  EXPECT_FALSE(open_float_gaps(plate.vertices, plate.triangles, 1e-9).opened);
  EXPECT_EQ(plate.vertices, before);
}

const Triangle low{0, 1, 2}, high{3, 4, 5};

std::vector<Vec3> two_triangles(double z) { return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, z}, {1, 0, z}, {0, 1, z}}; }

TEST(StraightMotion, WhatMovesApartStaysApart) { EXPECT_TRUE(stay_apart(two_triangles(1e-9), two_triangles(1), low, high)); }

// Apart at both ends, through each other between.
TEST(StraightMotion, WhatPassesThroughDoesNot) { EXPECT_FALSE(stay_apart(two_triangles(1), two_triangles(-1), low, high)); }

// Past each other in one plane: a quarter turn of the normal, which no single one shows.
TEST(StraightMotion, WhatGoesAroundIsFollowedInParts) {
  std::vector<Vec3> start = two_triangles(0), end = start;
  for (int k = 3; k < 6; ++k) start[k] += Vec3(2, 0, 0.01), end[k] += Vec3(0.01, 2, 0.01);
  EXPECT_TRUE(stay_apart(start, end, low, high));
}

// Two triangles hinged on the edge 0 1; the apex 3 moves over the hinge.
std::vector<Vec3> hinged(const Vec3& apex) { return {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, apex}; }

TEST(StraightMotion, AHingeMayPassThroughFlatWhenOpenButNotWhenShut) {
  const Triangle s{0, 1, 2}, t{1, 0, 3};
  EXPECT_TRUE(stay_apart(hinged({0.5, -1, 0.1}), hinged({0.5, -1, -0.1}), s, t)) << "opened wide";
  EXPECT_FALSE(stay_apart(hinged({0.5, 1, 0.1}), hinged({0.5, 1, -0.1}), s, t)) << "shut: through each other";
}

}  // namespace
}  // namespace starcell
