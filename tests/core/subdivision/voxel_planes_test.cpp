// V-planes where more than three planes meet. The cell is [12, 16]^3.
#include "subdivision/voxel_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "subdivision/scene.h"

namespace starcell {
namespace {

using namespace sample;
using Op = LocalExpression::Op;

/// A pyramid with n sides: its tip in the cell, its foot far below.
Mesh pyramid(std::uint32_t n, const Vec3& tip) {
  Mesh m;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double a = 2 * std::numbers::pi * k / n + 0.17;
    m.vertices.push_back({tip.x() + 14 * std::cos(a), tip.y() + 14 * std::sin(a), tip.z() - 15});
  }
  m.vertices.push_back(tip);
  for (std::uint32_t k = 0; k < n; ++k) m.triangles.push_back({k, (k + 1) % n, n});
  for (std::uint32_t k = 1; k + 1 < n; ++k) m.triangles.push_back({0, k + 1, k});
  return m;
}

std::optional<std::vector<PlaneSheet>> sheets(const std::vector<Mesh>& meshes, Op op) {
  const Scene scene(meshes, op);
  auto found = plane_sheets(scene.restriction, scene.at({12, 12, 12}, 4));
  if (!found) return std::nullopt;
  return std::move(found->sheets);
}

const Vec3 tip(13.9, 14.1, 14.2);

// More than three planes through one point: certain, because the point is a corner of facets on each of them.
TEST(VoxelPlanes, ATipOfManySidesIsOneSheet) {
  for (const std::uint32_t n : {3u, 4u, 6u, 9u}) {
    const auto found = sheets({pyramid(n, tip)}, Op::set_union);
    ASSERT_TRUE(found) << n;
    ASSERT_EQ(found->size(), 1u) << n;
    EXPECT_EQ(found->front().surfaces.size(), n);
    EXPECT_FALSE(found->front().contact) << n;
    EXPECT_EQ(found->front().flats.size(), n) << n;
  }
}

// Out of a box's top comes the tip; or the box keeps what is below its top. One disk each time, of six sides and the top.
TEST(VoxelPlanes, ATipThroughTheTopOfABox) {
  const Mesh block = box({1, 1, 1}, {31, 31, 13.3});
  for (const Op op : {Op::set_union, Op::intersection}) {
    const auto found = sheets({pyramid(6, tip), block}, op);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->size(), 1u);
    EXPECT_EQ(found->front().surfaces.size(), 7u);
    EXPECT_EQ(found->front().flats.size(), 7u);
  }
}

// The box from above leaves a ring around the pyramid in the cell: no disk, but known polygon by polygon. Six sides of the pyramid
// and the box's bottom, which has two cycles: the cell's outline and the pyramid's.
TEST(VoxelPlanes, ARingIsGivenByItsPolygons) {
  const auto ring = sheets({pyramid(6, tip), box({1, 1, 13.3}, {31, 31, 31})}, Op::set_union);
  ASSERT_TRUE(ring);
  ASSERT_EQ(ring->size(), 1u);
  EXPECT_FALSE(ring->front().disk);
  ASSERT_EQ(ring->front().flats.size(), 7u);
  EXPECT_EQ(std::count_if(ring->front().flats.begin(), ring->front().flats.end(), [](const FlatPart& part) { return part.cycles.size() == 2; }), 1);
}

// Two operands' tips at one place are eight planes of which nobody knows that they meet: refused, not guessed.
TEST(VoxelPlanes, TipsOfTwoSolidsAtOnePlaceAreRefused) {
  Mesh other = pyramid(5, tip);
  for (Vec3& p : other.vertices) p = tip + Vec3(p.x() - tip.x(), -(p.y() - tip.y()), -(p.z() - tip.z()));
  EXPECT_FALSE(sheets({pyramid(4, tip), other}, Op::set_union));
}

}  // namespace
}  // namespace starcell
