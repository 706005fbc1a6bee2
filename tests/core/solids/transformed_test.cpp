// Images of polyhedra, boxes and half-spaces under affine maps.
#include <gtest/gtest.h>

#include "solids/box.h"
#include "solids/half_space.h"
#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;

Eigen::Matrix4d affine(const Eigen::Matrix3d& linear, const Vec3& shift) {
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  map.topLeftCorner<3, 3>() = linear;
  map.topRightCorner<3, 1>() = shift;
  return map;
}

template <class Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Transformed, MovesVerticesAndBox) {
  const PolyhedronPtr moved = make_box({0, 0, 0}, {1, 2, 3})->transformed(affine(2 * Eigen::Matrix3d::Identity(), {10, 0, 0}));
  EXPECT_EQ(moved->bounding_box().min(), Vec3(10, 0, 0));
  EXPECT_EQ(moved->bounding_box().max(), Vec3(12, 4, 6));
  EXPECT_DOUBLE_EQ(volume(moved), 48.0);
}

TEST(Transformed, AMirrorImageIsTurnedRound) {
  const PolyhedronPtr ring = make(torus(12, 8));
  const PolyhedronPtr mirrored = ring->transformed(affine(Vec3(-1, 1, 1).asDiagonal(), {0, 0, 0}));
  EXPECT_NEAR(volume(mirrored), volume(ring), 1e-9);
  // The neighbours follow: the same as those found afresh.
  EXPECT_EQ(mirrored->neighbours(), Polyhedron::make(mirrored->vertices(), mirrored->triangles())->neighbours());
}

TEST(Transformed, KeepsCavities) {
  const PolyhedronPtr hollow = make(joined({box({-1, -1, -1}, {2, 2, 2}), box({0, 0, 0}, {1, 1, 1})}));
  EXPECT_NEAR(volume(hollow->transformed(affine(-Eigen::Matrix3d::Identity(), {5, 6, 7}))), 26.0, 1e-12);
}

TEST(Transformed, RefusesWhatIsNoAffineBijection) {
  const PolyhedronPtr cube = make_box({0, 0, 0}, {1, 1, 1});
  Eigen::Matrix4d projective = Eigen::Matrix4d::Identity(), infinite = projective, singular = projective;
  projective(3, 0) = 1e-9;
  infinite(0, 1) = NAN;
  singular.row(2) = singular.row(1);
  for (const Eigen::Matrix4d& bad : {projective, infinite, singular}) {
    EXPECT_TRUE(has(complaint([&] { cube->transformed(bad); }), "matrix"));
    EXPECT_TRUE(has(complaint([&] { HalfSpace::make({0, 0, 0}, {0, 0, 1}).transformed(bad); }), "matrix"));
  }
}

TEST(Transformed, ASmallScaleIsNotSingular) {
  // det = 1e-90, yet nothing is lost.
  EXPECT_NO_THROW(make_box({0, 0, 0}, {1, 1, 1})->transformed(affine(1e-30 * Eigen::Matrix3d::Identity(), {0, 0, 0})));
}

TEST(Transformed, RoundingThatClosesAGapIsRefused) {
  // A slot of 1e-6 moved to 1e12, where doubles are 1.2e-4 apart: both walls land on the same coordinates.
  const PolyhedronPtr two = make(joined({box({0, 0, 0}, {1, 1, 1}), box({0.25, 0.25, 1 + 1e-6}, {0.75, 0.75, 2})}));
  EXPECT_THROW(two->transformed(affine(Eigen::Matrix3d::Identity(), {0, 0, 1e12})), InvalidSolidError);
  EXPECT_THROW(two->transformed(affine(1e308 * Eigen::Matrix3d::Identity(), {1e308, 1e308, 1e308})), InvalidSolidError);
}

TEST(Transformed, StretchesTheDeflection) {
  const Mesh cube = box({0, 0, 0}, {1, 1, 1});
  const PolyhedronPtr made = Polyhedron::make(cube.vertices, cube.triangles, {"part", 0.5, {}});
  // The longest stretch bounds how far two sets may move apart: 3, although two axes shrink.
  EXPECT_NEAR(made->transformed(affine(Vec3(0.1, 3, 0.2).asDiagonal(), {0, 0, 0}))->provenance().deflection, 1.5, 1e-12);
}

TEST(BoxSolid, IsAValidPolyhedron) {
  const PolyhedronPtr made = make_box({-1, 0, 2}, {1, 5, 3});
  EXPECT_DOUBLE_EQ(volume(made), 10.0);  // 2 * 5 * 1, outward
  const PolyhedronPtr checked = Polyhedron::make(made->vertices(), made->triangles());
  EXPECT_EQ(checked->triangles(), made->triangles());
  EXPECT_EQ(checked->neighbours(), made->neighbours());
}

TEST(BoxSolid, NamesWrongCorners) {
  EXPECT_TRUE(has(complaint([] { make_box({0, 0, 0}, {1, 0, 1}); }), "lower"));
  EXPECT_TRUE(has(complaint([] { make_box({0, 0, 0}, {1, NAN, 1}); }), "finite"));
}

TEST(HalfSpaceSolid, NamesWrongArguments) {
  EXPECT_TRUE(has(complaint([] { HalfSpace::make({0, 0, INFINITY}, {0, 0, 1}); }), "point"));
  EXPECT_TRUE(has(complaint([] { HalfSpace::make({0, 0, 0}, {0, 0, NAN}); }), "normal"));
  EXPECT_TRUE(has(complaint([] { HalfSpace::make({0, 0, 0}, {0, -0.0, 0}); }), "normal"));
}

TEST(HalfSpaceSolid, ItsImageContainsTheImagesOfItsPoints) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  for (int round = 0; round < 200; ++round) {
    const HalfSpace half = HalfSpace::make(vector(), vector());
    Eigen::Matrix3d linear;
    linear << vector(), vector(), vector();
    const Vec3 shift = vector();
    const HalfSpace image = half.transformed(affine(linear, shift));
    const Vec3 p = vector();
    const double side = half.normal.dot(p - half.point);
    if (std::abs(side) < 1e-6 || std::abs(linear.determinant()) < 1e-3) continue;  // too close for doubles
    EXPECT_EQ(side > 0, image.normal.dot(linear * p + shift - image.point) > 0);
  }
}

}  // namespace
}  // namespace starcell
