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

// Leaves at random rotations against those at the identity: DESIGN §4's cost is a few cells at any rotation.
TEST(Contacts, RotationDoesNotAddManyLeaves) {
  std::mt19937 random(6);
  const auto leaves = [](const Eigen::Matrix3d& rotation) {
    const Expression e = solid(turned(cube(0, 0, 0), rotation)) | solid(turned(cube(0.2, 0.3, 1, 0.5), rotation));
    return evaluate(e, with_error(0.05, 1e-6)).certificate.statistics.at("leaves");
  };
  const double still = leaves(Eigen::Matrix3d::Identity());
  for (int i = 0; i < 20; ++i) EXPECT_LE(leaves(random_rotation(random)), 2 * still);
}

/// A band of triangles between two rings of different numbers of corners, with lids: its side facets are not coplanar, so four
/// and more planes pass through the corners of the lower ring.
Mesh drum(int below, int above, double height) {
  Mesh m;
  const auto ring = [&](int n, double radius, double z) {
    for (int k = 0; k < n; ++k) {
      const double a = 6.283185307179586 * k / n + 0.1 * z;
      m.vertices.push_back({radius * std::cos(a), radius * std::sin(a), z});
    }
  };
  ring(below, 1.0, 0);
  ring(above, 0.8, height);
  const auto b = static_cast<std::uint32_t>(below), a = static_cast<std::uint32_t>(above);
  std::uint32_t i = 0, j = 0;
  while (i < b || j < a) {
    const bool lower = j == a || (i < b && double(i + 1) / below <= double(j + 1) / above);
    if (lower)
      m.triangles.push_back({i % b, (i + 1) % b, b + j % a}), ++i;
    else
      m.triangles.push_back({i % b, b + (j + 1) % a, b + j % a}), ++j;
  }
  for (std::uint32_t k = 1; k + 1 < b; ++k) m.triangles.push_back({0, k + 1, k});
  for (std::uint32_t k = 1; k + 1 < a; ++k) m.triangles.push_back({b, b + k, b + k + 1});
  return m;
}

// Where it stands on a box's top, three planes and more besides the shared one pass through every corner of its foot: only
// the cone over the trace can tell what E is there.
TEST(Contacts, ADrumOfTrianglesStandsOnABox) {
  const Mesh m = drum(9, 5, 1.5);
  expect_at_rotations("drum", {m, box({-2, -2, -1}, {2, 2, 0})}, {}, {16 + volume(m.vertices, m.triangles), solid_ball(), 1e-4});
}

/// A frustum of a pyramid with n sides: radius r0 at z0, r1 at z1.
Mesh frustum(std::uint32_t n, double r0, double z0, double r1, double z1) {
  Mesh m;
  for (const auto& [r, z] : {std::pair(r0, z0), std::pair(r1, z1)})
    for (std::uint32_t k = 0; k < n; ++k) {
      const double a = 2 * std::numbers::pi * k / n + 0.3;
      m.vertices.push_back({r * std::cos(a), r * std::sin(a), z});
    }
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    m.triangles.insert(m.triangles.end(), {{k, next, n + next}, {k, n + next, n + k}});
  }
  for (std::uint32_t k = 1; k + 1 < n; ++k) m.triangles.insert(m.triangles.end(), {{0, k + 1, k}, {n, n + k, n + k + 1}});
  return m;
}

// The sides meet along the edges of the common polygon at an angle: three planes in each of those edges, five in each of its
// corners. Nothing has to be moved: the result is exactly the two on top of each other, n sides twice and two lids.
TEST(Contacts, FrustaOnACommonPolygonStayExact) {
  std::mt19937 random(10);
  for (const std::uint32_t n : {4u, 12u})
    for (const double top : {0.5, 0.98, 1.3})
      for (int i = 0; i < 3; ++i) {
        const Eigen::Matrix3d rotation = random_rotation(random);
        const Mesh below = frustum(n, 1, -2, 1, 0), above = frustum(n, 1, 0, top, 1);
        const Result r = evaluate(solid(turned(below, rotation)) | solid(turned(above, rotation)), with_error(0.1));
        const std::string what = std::to_string(n) + " sides to " + std::to_string(top) + ", rotation " + std::to_string(i);
        expect_sound(r, what);
        EXPECT_EQ(topology(r), solid_ball()) << what;
        EXPECT_NE(r.certificate.verdict, Verdict::unresolved) << what;
        EXPECT_LT(r.certificate.error_bound, 1e-9) << what;
        EXPECT_EQ(r.triangles.size(), 4 * n + 2 * (n - 2)) << what;
        EXPECT_NEAR(volume(r), volume(below.vertices, below.triangles) + volume(above.vertices, above.triangles), 1e-9) << what;
      }
}

// Edges that cross, with the solids running into each other: told as they are or moved apart by less than the tolerance, and
// said to touch.
TEST(Contacts, CrossingEdgesEndAsAContact) {
  std::mt19937 random(8);
  for (int i = 0; i < 10; ++i) {
    const Mesh base = cube(0, 0, 0);
    Mesh other = turned(base, random_rotation(random));
    const Vec3 shift = Vec3(0.4, 1, 1) - (0.45 * other.vertices[0] + 0.55 * other.vertices[1]);
    for (Vec3& v : other.vertices) v += shift;
    const Result both = evaluate(solid(base) | solid(other), with_error(0.02, 1e-5));
    const Result common = evaluate(solid(base) & solid(other), with_error(0.02, 1e-5));
    for (const Result* r : {&both, &common}) {
      expect_sound(*r);
      EXPECT_EQ(r->certificate.verdict, Verdict::contact) << i;
      EXPECT_LE(r->certificate.error_bound, 0.02);
    }
    EXPECT_NEAR(volume(both) + volume(common), 2, 1e-4) << i;
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
// Where a plane bounds E from both senses at one corner, no part of the sheet may leave that corner out.
TEST(Contacts, ATwistedCornerIsOnePieceAtManyRotations) {
  expect_at_rotations("twisted corner", {cube(0, 0, 0), cube(-1, 0, 0), cube(-1, 0, -1), cube(-1, -1, -1)}, {}, {4, solid_ball()}, 60);
}

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
