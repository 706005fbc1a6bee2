// Booleans of two boxes, where everything about the answer is known by hand.
#include "operations/results.h"
#include "solids/errors.h"

namespace starcell {
namespace {

using namespace sample;

constexpr double nowhere = std::numeric_limits<double>::infinity();

// [0,3]x[0,2]x[0,1] and [1.3,4.1]x[0.7,1.6]x[-0.4,1.9]: the common box is 1.7 x 0.9 x 1.
const Mesh first = box({0, 0, 0}, {3, 2, 1}), second = box({1.3, 0.7, -0.4}, {4.1, 1.6, 1.9});
constexpr double first_volume = 6.0, second_volume = 2.8 * 0.9 * 2.3, common_volume = 1.7 * 0.9;

struct Case {
  const char* name;
  Expression expression;
  double volume;
  std::size_t corners;  // of the exact solid
};

std::vector<Case> cases(const Eigen::Matrix3d& rotation) {
  const Expression a = solid(turned(first, rotation)), b = solid(turned(second, rotation));
  // No corner of one box lies in the other. Upright edges of the second pierce the first's bottom and top in 4 points, and
  // 2 edges of the first's right side enter and leave the second in 4: so 8 + 8 + 8 corners, 8 + 8, and 8.
  return {{"union", a | b, first_volume + second_volume - common_volume, 24},
          {"cut", a - b, first_volume - common_volume, 16},
          {"intersection", a & b, common_volume, 8}};
}

TEST(BooleanOfBoxes, VolumeIsExactInEveryRotation) {
  std::mt19937 random(1);
  for (int i = 0; i < 6; ++i) {
    const Eigen::Matrix3d rotation = i == 0 ? Eigen::Matrix3d::Identity() : random_rotation(random);
    for (const Case& c : cases(rotation)) {
      const Result r = evaluate(c.expression, with_error(0.2));
      expect_sound(r, c.name);
      EXPECT_NEAR(volume(r), c.volume, 1e-9) << c.name << " rotation " << i;
      EXPECT_EQ(r.certificate.verdict, Verdict::exact) << c.name << " rotation " << i;
      EXPECT_LE(r.certificate.error_bound, 0.2);
    }
  }
}

// A sphere's mesh with n corners has 2n - 4 triangles: 44, 28 and 12 here. Twice that is what the result may have.
TEST(BooleanOfBoxes, FlatSidesComeOutAsFewTriangles) {
  std::mt19937 random(2);
  for (int i = 0; i < 4; ++i)
    for (const Case& c : cases(random_rotation(random))) {
      const Result r = evaluate(c.expression, with_error(0.2));
      EXPECT_GE(r.triangles.size(), 2 * c.corners - 4) << c.name;
      EXPECT_LE(r.triangles.size(), 2 * (2 * c.corners - 4)) << c.name << " rotation " << i;
    }
}

// The second box cuts a notch from top to bottom into the right side of the first: one piece, without a hole.
TEST(BooleanOfBoxes, TopologyDoesNotDependOnTheRotation) {
  std::mt19937 random(3);
  for (int i = 0; i < 4; ++i)
    for (const Case& c : cases(random_rotation(random))) {
      const Result r = evaluate(c.expression, with_error(nowhere));
      EXPECT_EQ(topology(r), solid_ball()) << c.name << " rotation " << i;
      EXPECT_EQ(r.certificate.components, 1);
      EXPECT_EQ(r.certificate.genus, std::vector<int>{0});
    }
}

// A bar through the middle of a plate leaves a ring.
TEST(BooleanOfBoxes, AHoleThroughAPlateHasGenusOne) {
  std::mt19937 random(4);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Matrix3d rotation = random_rotation(random);
    const Result r = evaluate(solid(turned(box({0, 0, 0}, {3, 3, 1}), rotation)) -
                                  solid(turned(box({1, 1.1, -1}, {2, 1.9, 2}), rotation)),
                              with_error(0.1));
    expect_sound(r);
    EXPECT_EQ(topology(r), (Topology{1, {1}}));
    EXPECT_NEAR(volume(r), 9 - 0.8, 1e-9);
  }
}

// A box inside another one, subtracted: an outer and an inner shell, each a sphere.
TEST(BooleanOfBoxes, AVoidIsAShellOfItsOwn) {
  const Result r = evaluate(solid(box({0, 0, 0}, {3, 3, 3})) - solid(box({1, 1, 1}, {2, 2.1, 2.2})), with_error(0.1));
  expect_sound(r);
  EXPECT_EQ(topology(r), (Topology{2, {0, 0}}));
  EXPECT_NEAR(volume(r), 27 - 1.1 * 1.2, 1e-9);
  EXPECT_EQ(r.triangles.size(), 24u) << "two boxes of twelve triangles";
}

TEST(BooleanOfBoxes, BoxesApartStayApart) {
  const Expression a = solid(box({0, 0, 0}, {1, 1, 1})), b = solid(box({2, 0.1, 0.2}, {3, 1, 1}));
  EXPECT_EQ(topology(evaluate(a | b, with_error(0.1))), (Topology{2, {0, 0}}));
  EXPECT_TRUE(evaluate(a & b, with_error(0.1)).triangles.empty());
  EXPECT_NEAR(volume(evaluate(a - b, with_error(0.1))), 1, 1e-9);
}

// The first box is cut by the plane through its middle across a diagonal: by symmetry half of it is left.
TEST(BooleanOfBoxes, AHalfSpaceThroughTheMiddleLeavesHalf) {
  const Vec3 middle(1.5, 1, 0.5);
  const Result r = evaluate(solid(first) & Expression(HalfSpace::make(middle, Vec3(1, 2, 3))), with_error(0.1));
  expect_sound(r);
  EXPECT_NEAR(volume(r), 3, 1e-9);
  EXPECT_EQ(topology(r), solid_ball());
  EXPECT_NEAR(volume(evaluate(solid(first) - Expression(HalfSpace::make(middle, Vec3(1, 2, 3))), with_error(0.1))), 3, 1e-9);
}

TEST(BooleanOfBoxes, WhatIsUnboundedIsRefused) {
  const Expression half(HalfSpace::make({0, 0, 0}, {0, 0, 1})), a = solid(first);
  EXPECT_THROW(evaluate(half, with_error(0.1)), UnboundedError);
  EXPECT_THROW(evaluate(a | half, with_error(0.1)), UnboundedError);
  EXPECT_THROW(evaluate(a.complement(), with_error(0.1)), UnboundedError);
  EXPECT_NO_THROW(evaluate(a & a.complement().complement(), with_error(0.1)));
}

TEST(BooleanOfBoxes, ErrorsThatMakeNoSenseAreRefused) {
  for (const double error : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(evaluate(solid(first), with_error(error)), std::invalid_argument) << error;
}

// One polyhedron may stand in an expression twice: (A cut B) joined with (A and B) is A.
TEST(BooleanOfBoxes, ASolidMayOccurTwice) {
  const Expression a = solid(first), b = solid(second);
  const Result r = evaluate((a - b) | (a & b), with_error(0.1));
  expect_sound(r);
  EXPECT_NEAR(volume(r), first_volume, 1e-9);
  EXPECT_EQ(r.triangles.size(), 12u);
}

// Every length scaled by a power of two, and moved far away: the same solid.
TEST(BooleanOfBoxes, SmallLargeAndFarAwaySolidsWorkToo) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const double far : {0.0, 1e3}) {
      const auto placed = [&](const Mesh& m) {
        Mesh copy = m;
        for (Vec3& p : copy.vertices) p = scale * (p + Vec3(far, -far, 0.5 * far));
        return solid(copy);
      };
      const Result r = evaluate(placed(first) - placed(second), with_error(0.1 * scale));
      expect_sound(r);
      EXPECT_EQ(topology(r), solid_ball()) << scale << ' ' << far;
      Mesh back{r.vertices, r.triangles};
      for (Vec3& p : back.vertices) p = p / scale - Vec3(far, -far, 0.5 * far);
      EXPECT_NEAR(volume(back.vertices, back.triangles), first_volume - common_volume, 1e-8) << scale << ' ' << far;
    }
}

}  // namespace
}  // namespace starcell
