// Degenerate positions (DESIGN §4): faces, edges and corners that touch, at the identity and at random rotations.
#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;

Mesh cube(double x, double y, double z, double side = 1) { return box({x, y, z}, {x + side, y + side, z + side}); }

struct Expected {
  double volume;
  Topology topology;
  double volume_tolerance = 1e-9;
};

/// The union of what is added, minus what is removed, with a contact tolerance of a millionth.
void expect_at_rotations(const char* name, const std::vector<Mesh>& added, const std::vector<Mesh>& removed,
                         const Expected& expected, int rotations = 4) {
  std::mt19937 random(5);
  for (int i = 0; i < rotations; ++i) {
    const Eigen::Matrix3d rotation = i == 0 ? Eigen::Matrix3d::Identity() : random_rotation(random);
    std::vector<Expression> plus, minus;
    for (const Mesh& m : added) plus.push_back(solid(turned(m, rotation)));
    for (const Mesh& m : removed) minus.push_back(solid(turned(m, rotation)));
    Expression e = Expression::set_union(plus);
    if (!minus.empty()) e = e - Expression::set_union(minus);
    const Result r = evaluate(e, with_error(0.05, 1e-6));
    const std::string what = std::string(name) + ", rotation " + std::to_string(i);
    expect_sound(r, what);
    EXPECT_EQ(topology(r), expected.topology) << what;
    EXPECT_NEAR(volume(r), expected.volume, expected.volume_tolerance) << what;
    EXPECT_NE(r.certificate.verdict, Verdict::unresolved) << what;
    EXPECT_LE(r.certificate.statistics.at("leaves"), 2000) << what << ": contacts cost a few cells, not their area";
  }
}

TEST(Contacts, StackedCubesAreOneBlock) {
  expect_at_rotations("stacked", {cube(0, 0, 0), cube(0, 0, 1)}, {}, {2, solid_ball()});
}

TEST(Contacts, ASmallCubeOnALargeOneIsOnePiece) {
  expect_at_rotations("small on large", {cube(0, 0, 0), cube(0.2, 0.3, 1, 0.5)}, {}, {1.125, solid_ball()});
}

TEST(Contacts, CubesWithEqualEdgesInACornerAreOnePiece) {
  expect_at_rotations("flush in a corner", {cube(0, 0, 0), cube(0, 0, 1, 0.5)}, {}, {1.125, solid_ball()});
}

TEST(Contacts, HalfShiftedNeighboursAreOnePiece) {
  expect_at_rotations("half shifted", {cube(0, 0, 0), cube(1, 0.5, 0)}, {}, {2, solid_ball()});
}

// The pocket's wall lies in the cube's side: no sliver may stay there.
TEST(Contacts, APocketFlushWithTheSideLeavesNoSliver) {
  expect_at_rotations("flush pocket", {cube(0, 0, 0)}, {box({0, 0.25, 0.5}, {0.5, 0.75, 1})}, {0.875, solid_ball()});
}

TEST(Contacts, ASlotFlushWithBothEndsIsOpen) {
  expect_at_rotations("flush slot", {cube(0, 0, 0)}, {box({0.25, 0, 0.5}, {0.75, 1, 1})}, {0.75, solid_ball()});
}

// Four bars around a hole: a ring.
TEST(Contacts, AFrameOfFourBarsHasGenusOne) {
  expect_at_rotations("frame of four",
                      {box({0, 0, 0}, {3, 1, 1}), box({0, 2, 0}, {3, 3, 1}), box({0, 1, 0}, {1, 2, 1}), box({2, 1, 0}, {3, 2, 1})},
                      {}, {8, {1, {1}}});
}

// Six plates around a void of 1: an outer and an inner sphere.
TEST(Contacts, SixPlatesCloseAVoid) {
  expect_at_rotations("closed shell",
                      {box({0, 0, 0}, {3, 3, 1}), box({0, 0, 2}, {3, 3, 3}), box({0, 0, 1}, {3, 1, 2}), box({0, 2, 1}, {3, 3, 2}),
                       box({0, 1, 1}, {1, 2, 2}), box({2, 1, 1}, {3, 2, 2})},
                      {}, {26, {2, {0, 0}}}, 2);
}

// Four cubes in a chain that winds around one corner and shares a face from one to the next: joined by faces alone.
TEST(Contacts, ATwistedCornerIsOnePiece) {
  expect_at_rotations("twisted corner", {cube(0, 0, 0), cube(-1, 0, 0), cube(-1, 0, -1), cube(-1, -1, -1)}, {},
                      {4, solid_ball(), 1e-5});
}

TEST(Contacts, ASolidJoinedWithItselfIsItself) {
  expect_at_rotations("A or A", {cube(0, 0, 0), cube(0, 0, 0)}, {}, {1, solid_ball()});
}

TEST(Contacts, ASolidMinusItselfIsEmpty) {
  expect_at_rotations("A - A", {cube(0, 0, 0)}, {cube(0, 0, 0)}, {0, {0, {}}});
  std::mt19937 random(8);
  const Mesh stone = pebble(random, 1);
  EXPECT_TRUE(evaluate(solid(stone) - solid(stone), with_error(0.05)).triangles.empty());
}

TEST(Contacts, ATouchingNeighbourTakesNothingAway) {
  expect_at_rotations("touching, subtracted", {cube(0, 0, 0)}, {cube(0, 0, 1)}, {1, solid_ball()});
}

TEST(Contacts, TouchingCubesHaveNothingInCommon) {
  std::mt19937 random(6);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Matrix3d rotation = random_rotation(random);
    const Result r =
        evaluate(solid(turned(cube(0, 0, 0), rotation)) & solid(turned(cube(0, 0, 1), rotation)), with_error(0.05, 1e-6));
    EXPECT_TRUE(r.triangles.empty());
    EXPECT_TRUE(r.vertices.empty());
    EXPECT_EQ(r.certificate.components, 0);
  }
}

// Inside joins only across a face: two pieces that touch stay two, pulled apart by less than the contact tolerance.
TEST(Contacts, EdgeToEdgeIsAContactAndAManifold) {
  std::mt19937 random(7);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Matrix3d rotation = i == 0 ? Eigen::Matrix3d::Identity() : random_rotation(random);
    const Result r =
        evaluate(solid(turned(cube(0, 0, 0), rotation)) | solid(turned(cube(1, 1, 0), rotation)), with_error(0.05, 1e-6));
    expect_sound(r, "edge to edge, rotation " + std::to_string(i));
    EXPECT_EQ(r.certificate.verdict, Verdict::contact) << i;
    EXPECT_FALSE(r.certificate.contacts.empty()) << i;
    EXPECT_EQ(topology(r), (Topology{2, {0, 0}})) << i;
    EXPECT_NEAR(volume(r), 2, 1e-3) << i;
  }
}

TEST(Contacts, CornerToCornerIsAContactAndAManifold) {
  std::mt19937 random(9);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Matrix3d rotation = i == 0 ? Eigen::Matrix3d::Identity() : random_rotation(random);
    const Result r =
        evaluate(solid(turned(cube(0, 0, 0), rotation)) | solid(turned(cube(1, 1, 1), rotation)), with_error(0.05, 1e-6));
    expect_sound(r, "corner to corner, rotation " + std::to_string(i));
    EXPECT_EQ(r.certificate.verdict, Verdict::contact) << i;
    EXPECT_EQ(topology(r), (Topology{2, {0, 0}})) << i;
    EXPECT_NEAR(volume(r), 2, 1e-3) << i;
  }
}

// 27 cubes: every kind of contact at once, and one block in the end.
TEST(Contacts, ABlockOfCubesIsOneCube) {
  std::vector<Mesh> cubes;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 3; ++z) cubes.push_back(cube(x, y, z));
  expect_at_rotations("block", cubes, {}, {27, solid_ball(), 1e-8}, 3);
}

}  // namespace
}  // namespace starcell
