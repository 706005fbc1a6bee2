// Penetration depth and separation: closed forms of boxes, a ring that only comes off sideways, and the way out.
#include "operations/penetration_depth.h"

#include <algorithm>

#include "minkowski/meeting.h"
#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;

PenetrationDepth depth_of(const Mesh& a, const Mesh& b, double error) { return penetration_depth(solid(a), solid(b), with_error(error)); }

bool meet(const Mesh& a, const Mesh& b, const Vec3& shift) {
  const SumOperand one(make(a), {}), other(make(b), {true, false});
  return Meeting(one, other).at(shift).value_or(true);
}

TEST(PenetrationDepth, OfBoxesIsTheLeastOverlap) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> size(0.5, 2), share(-1.3, 1.3);
  int overlapping = 0;
  for (int k = 0; k < 40; ++k) {
    const Eigen::Matrix3d rotation = random_rotation(random);
    Vec3 a, b, s;
    for (int i = 0; i < 3; ++i) a[i] = size(random), b[i] = size(random), s[i] = 0.5 * share(random) * (a[i] + b[i]);
    const Vec3 overlap = 0.5 * (a + b) - s.cwiseAbs();
    const Mesh one = turned(box(-0.5 * a, 0.5 * a), rotation), other = turned(box(s - 0.5 * b, s + 0.5 * b), rotation);
    const PenetrationDepth d = depth_of(one, other, 0.01);
    // Of either surface.
    for (const auto& [point, middle, half] : {std::tuple<Vec3, Vec3, Vec3>(d.point_a, Vec3::Zero(), 0.5 * a), {d.point_b, s, 0.5 * b}})
      EXPECT_NEAR(((rotation.transpose() * point - middle).cwiseAbs() - half).maxCoeff(), 0, 1e-9);
    if (overlap.minCoeff() > 0) {
      ++overlapping;
      EXPECT_LE(d.lower, overlap.minCoeff() + 1e-9);
      EXPECT_GE(d.upper, overlap.minCoeff() - 1e-9);
      EXPECT_LE(d.upper - d.lower, 0.01);
      EXPECT_NEAR(d.direction.norm(), 1, 1e-12);
      EXPECT_FALSE(meet(one, other, (1 + 1e-9) * d.upper * d.direction));
      EXPECT_LE((d.point_a - d.point_b - d.upper * d.direction).norm(), 0.01);
    } else {
      const double gap = (-overlap).cwiseMax(0).norm();   // boxes are apart by the gaps along all axes together
      EXPECT_EQ(d.lower, 0);
      EXPECT_EQ(d.upper, 0);
      EXPECT_LE(d.separation_lower, gap + 1e-9);
      EXPECT_GE(d.separation_upper, gap - 1e-9);
      EXPECT_LE(d.separation_upper - d.separation_lower, 1e-9);
      EXPECT_NEAR((d.point_a - d.point_b).norm(), gap, 1e-9);
    }
  }
  EXPECT_GT(overlapping, 5);
}

// Ends that lie in one plane say nothing of whether the solids overlap: a post in a hole does not.
TEST(PenetrationDepth, OfWhatIsFlushIsItsClearance) {
  const Result made = evaluate(solid(box({-2, -2, 0}, {2, 2, 1})) - solid(box({-1, -1, -1}, {1, 1, 2})), with_error(0.01));
  const Mesh ring{made.vertices, made.triangles};
  for (const double half : {0.7, 0.999999}) {
    const PenetrationDepth d = depth_of(ring, box({-half, -half, 0}, {half, half, 1}), 0.01);
    EXPECT_EQ(d.upper, 0);
    EXPECT_NEAR(d.separation_lower, 1 - half, 1e-9);
    EXPECT_NEAR(d.separation_upper, 1 - half, 1e-9);
  }
  // One that fills the hole touches: nothing is claimed but that it does not overlap by more than rounding.
  const PenetrationDepth touching = depth_of(ring, box({-1, -1, 0}, {1, 1, 1}), 0.01);
  EXPECT_EQ(touching.lower, 0);
  EXPECT_EQ(touching.separation_lower, 0);
}

// A frame whose hole is 1 wide, jammed on a pole 1.2 thick and 10 high: the way out is sideways past the frame's whole width.
TEST(PenetrationDepth, OfAFrameJammedOnAPole) {
  const Expression frame = solid(box({-1.5, -1.5, -0.1}, {1.5, 1.5, 0.1})) - solid(box({-0.5, -0.5, -1}, {0.5, 0.5, 1}));
  const Result made = evaluate(frame, with_error(0.01));
  const Mesh ring{made.vertices, made.triangles};
  for (const auto& [height, depth] : {std::pair(5.0, 2.1), std::pair(1.0, 1.1)}) {   // a short pole comes out along its axis
    const PenetrationDepth d = depth_of(ring, box({-0.6, -0.6, -height}, {0.6, 0.6, height}), 0.02);
    EXPECT_LE(d.lower, depth + 1e-9);
    EXPECT_GE(d.upper, depth - 1e-9);
    EXPECT_LE(d.upper - d.lower, 0.02);
  }
}

// Faces of both in line, in any rotation: no crossing of an edge and a face is certain there, and the way out slides along a face.
TEST(PenetrationDepth, OfFacesInLine) {
  std::mt19937 random(31);
  const Mesh corner = [] {
    const Result made = evaluate(solid(box({0, 0, 0}, {4, 4, 1})) | solid(box({0, 0, 0}, {1, 4, 4})) | solid(box({0, 0, 0}, {4, 1, 4})), with_error(0.01));
    return Mesh{made.vertices, made.triangles};
  }();
  struct Case {
    Mesh a, b;
    double depth;
  };
  const Mesh slab = box({0, 0, 0}, {4, 4, 1});
  const std::vector<Case> cases{{slab, box({3.25, 1, 0}, {6, 2, 1}), 0.75},                       // ends of both in line
                                {slab, slab, 1},
                                {box({0, 0, 0}, {2, 2, 2}), box({0, 0, 0.5}, {2, 2, 3}), 1.5},   // all four sides in line
                                {slab, box({1, 1, 0.5}, {2, 2, 1}), 0.5},                         // flush
                                {corner, box({0.25, 1, 1}, {2, 2, 2}), 0.75}};                    // in one wall, on another, along a third
  for (std::size_t k = 0; k < cases.size(); ++k)
    for (const Eigen::Matrix3d& rotation : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), random_rotation(random), random_rotation(random)}) {
      const PenetrationDepth d = depth_of(turned(cases[k].a, rotation), turned(cases[k].b, rotation), 0.01);
      EXPECT_LE(d.lower, cases[k].depth + 1e-9) << k;
      EXPECT_GE(d.upper, cases[k].depth - 1e-9) << k;
      EXPECT_LE(d.upper - d.lower, 0.01) << k;
    }
}

// One inside the other, boundaries apart: the depth is to the nearest side, and past it.
TEST(PenetrationDepth, OfWhatLiesInside) {
  const PenetrationDepth d = depth_of(box({0, 0, 0}, {10, 10, 10}), box({4, 4, 7}, {5, 5, 8}), 0.01);
  EXPECT_NEAR(d.upper, 3, 0.011);
  EXPECT_NEAR(d.lower, 3, 0.011);
  EXPECT_NEAR(d.direction.z(), 1, 1e-6);
}

// Curved solids are meshed, and the bounds are wider by as much: a ring whose hole is 0.4 on a pole of radius 0.5.
TEST(PenetrationDepth, OfCurvedSolidsHoldsTheTruth) {
  const Expression pole(CurvedSolid::cylinder({0, 0, -5}, Vec3::UnitZ(), 0.5, 10)), ball(CurvedSolid::sphere({0.4, 0, 0}, 0.3));
  const PenetrationDepth d = penetration_depth(pole, ball, with_error(0.05));
  EXPECT_LE(d.lower, 0.4);   // 0.5 + 0.3 - 0.4
  EXPECT_GE(d.upper, 0.4);
  EXPECT_LE(d.upper - d.lower, 0.05);
  EXPECT_GT(d.deflection, 0);
}

// Neither convex: a ring whose hole is 0.4 wide on a pole of radius 0.5 comes off sideways, past its whole tube.
TEST(PenetrationDepth, OfCurvedSolidsThatAreNotConvex) {
  const Expression ring(CurvedSolid::torus(Vec3::Zero(), Vec3::UnitZ(), 1.4, 1.0)), pole(CurvedSolid::cylinder({0, 0, -9}, Vec3::UnitZ(), 0.5, 18));
  const PenetrationDepth d = penetration_depth(ring, pole, with_error(0.4));
  EXPECT_LE(d.lower, 2.9);   // 1.4 + 1.0 + 0.5
  EXPECT_GE(d.upper, 2.9);
  EXPECT_LE(d.upper - d.lower, 0.4);
  EXPECT_EQ(d.separation_upper, 0);
}

// A disc lies loose in a cavity, with less room than the mesh of the cavity leaves: the mesh is stuck in it, the solid is not.
TEST(PenetrationDepth, AMeshProvesNoOverlapOfWhatIsNotConvex) {
  const Expression hollow = Expression::difference(solid(box({-2, -2, -2}, {2, 2, 2})), Expression(CurvedSolid::sphere(Vec3::Zero(), 1)));
  const Expression disc(CurvedSolid::cylinder({0, 0, -0.05}, Vec3::UnitZ(), std::sqrt(0.998 * 0.998 - 0.05 * 0.05), 0.1));
  const PenetrationDepth d = penetration_depth(hollow, disc, with_error(0.2));
  EXPECT_EQ(d.lower, 0);
  EXPECT_LE(d.separation_lower, 0.002);
  EXPECT_GE(d.separation_upper, 0.002);
}

// Needles have no normals to trust: the bound of their distance is taken from their corners.
TEST(PenetrationDepth, OfNeedlesIsNoMoreThanTheTruth) {
  std::mt19937 random(21);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Matrix3d rotation = random_rotation(random);
    const double width = 1e-5 * (1 + k), gap = 1e-7;
    const Mesh plate = turned(box({-1, -0.5 * width, -1}, {1, 0.5 * width, 0}), rotation);
    Mesh tip = tetrahedron();
    for (Vec3& p : tip.vertices) p = rotation * Vec3(p.x(), p.y(), p.z() + gap + 0.1);
    const PenetrationDepth d = depth_of(plate, tip, 1e-3);
    // The truth is no more than the distance of any two points.
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : tip.vertices) {
      const Vec3 local = rotation.transpose() * p;
      const Vec3 on(std::clamp(local.x(), -1.0, 1.0), std::clamp(local.y(), -0.5 * width, 0.5 * width), std::clamp(local.z(), -1.0, 0.0));
      least = std::min(least, (local - on).norm());
    }
    EXPECT_LE(d.separation_lower, least + 1e-13) << width;
    EXPECT_GE(d.separation_upper, d.separation_lower);
  }
}

TEST(PenetrationDepth, RefusesWhatIsEmpty) {
  const Expression nothing = solid(box({0, 0, 0}, {1, 1, 1})) & solid(box({5, 5, 5}, {6, 6, 6}));
  EXPECT_THROW(penetration_depth(nothing, solid(box({0, 0, 0}, {1, 1, 1})), with_error(0.1)), std::invalid_argument);
}

}  // namespace
}  // namespace starcell
