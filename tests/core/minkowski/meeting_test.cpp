// Does A meet x - B? Against closed forms, and against CGAL's exact triangle intersections.
#include "minkowski/meeting.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Vec3 uniform(std::mt19937& random, double low, double high) {
  std::uniform_real_distribution<double> d(low, high);
  const double x = d(random), y = d(random), z = d(random);
  return {x, y, z};
}

TEST(Meeting, OfBoxesIsThatOfIntervals) {
  const SumOperand a(make(box({0, 0, 0}, {3, 2, 1})), {}), b(make(box({4, -1, 2}, {5, 1, 2.5})), {});
  const Meeting meeting(a, b);
  std::mt19937 random(1);
  const Box3 sum(Vec3(4, -1, 2), Vec3(8, 3, 3.5));
  for (int k = 0; k < 2000; ++k) {
    const Vec3 x = Vec3(6, 1, 2.75) + uniform(random, -3, 3);
    EXPECT_EQ(meeting.at(x), std::optional(sum.contains(x))) << x.transpose();
  }
}

// Boxes of one height, in any rotation: at x with no height at all only a point of both tells that they meet.
TEST(Meeting, SharesAPointWhereFacesAreInLine) {
  std::mt19937 random(3);
  for (int turn = 0; turn < 4; ++turn) {
    const Eigen::Matrix3d rotation = turn == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : random_rotation(random);
    const SumOperand a(make(turned(box({0, 0, 0}, {3, 2, 1}), rotation)), {}), b(make(turned(box({-2, -2, -1}, {0, 0, 0}), rotation)), {});
    const Meeting meeting(a, b);
    const Box3 sum(Vec3(-2, -2, -1), Vec3(3, 2, 1));
    int shared = 0, asked = 0;
    for (int k = 0; k < 300; ++k) {
      const Vec3 x = Vec3(0.5, 0, 0) + Vec3(3 * uniform(random, -1, 1).x(), 2.5 * uniform(random, -1, 1).y(), 0);
      const Box3 around((rotation * x).array() - 1e-3, (rotation * x).array() + 1e-3);
      const bool found = meeting.share_a_point(around);
      const double inside = (Vec3(0.5 * sum.sizes()) - (x - sum.center()).cwiseAbs()).minCoeff();
      if (found) EXPECT_GT(inside, 1e-3) << x.transpose();
      if (inside > 0.05) asked += 1, shared += found;
    }
    EXPECT_GT(asked, 100);
    EXPECT_EQ(shared, asked);
  }
}

// With their boundaries apart one solid may still lie in the other, and a cavity keeps out what lies in it.
TEST(Meeting, SeesWhatLiesInside) {
  const Mesh hollow = joined({box({0, 0, 0}, {9, 9, 9}), flipped(box({3, 3, 3}, {6, 6, 6}))});
  const Mesh small = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  for (const bool turned_round : {false, true}) {
    const SumOperand a(make(turned_round ? small : hollow), {}), b(make(turned_round ? hollow : small), {turned_round, false});
    const Meeting meeting(a, b);
    const double sense = turned_round ? -1 : 1;
    EXPECT_EQ(meeting.at(sense * Vec3(1.5, 1.4, 1.6)), std::optional(true)) << "in the wall";
    EXPECT_EQ(meeting.at(sense * Vec3(4.5, 4.4, 4.6)), std::optional(false)) << "in the cavity";
    EXPECT_EQ(meeting.at(sense * Vec3(2.8, 4.4, 4.6)), std::optional(true)) << "through the cavity's wall";
    EXPECT_EQ(meeting.at(sense * Vec3(11.0, 4.4, 4.6)), std::optional(false)) << "outside";
  }
}

// The complement of a box meets what is not wholly in it.
TEST(Meeting, OfAComplement) {
  const SumOperand outside(make(box({0, 0, 0}, {3, 3, 3})), {false, true}), b(make(box({-1, -1, -1}, {0, 0, 0})), {});
  const Meeting meeting(outside, b);
  EXPECT_EQ(meeting.at({1.1, 1.2, 0.9}), std::optional(false));
  EXPECT_EQ(meeting.at({2.1, 1.2, 0.9}), std::optional(true));
  EXPECT_EQ(meeting.at({7.1, 1.2, 0.9}), std::optional(true));
}

bool boundaries_meet(const Mesh& a, const Mesh& b, const Vec3& x) {
  const auto triangle = [](const Vec3& p, const Vec3& q, const Vec3& r) {
    const auto point = [](const Vec3& v) { return Kernel::Point_3(v.x(), v.y(), v.z()); };
    return Kernel::Triangle_3(point(p), point(q), point(r));
  };
  for (const Triangle& s : a.triangles)
    for (const Triangle& t : b.triangles)
      if (CGAL::do_intersect(triangle(a.vertices[s[0]], a.vertices[s[1]], a.vertices[s[2]]),
                             triangle(x - b.vertices[t[0]], x - b.vertices[t[1]], x - b.vertices[t[2]])))
        return true;
  return false;
}

TEST(Meeting, AgreesWithExactIntersections) {
  std::mt19937 random(7);
  int meets = 0, apart = 0;
  for (int pair = 0; pair < 4; ++pair) {
    const Mesh a = turned(torus(9, 6), random_rotation(random)), b = turned(pebble(random, 1), random_rotation(random), {2, 0, 0});
    const SumOperand one(make(a), {}), other(make(b), {});
    const Meeting meeting(one, other);
    for (int k = 0; k < 60; ++k) {
      const Vec3 x = Vec3(2, 0, 0) + uniform(random, -5, 5);
      const auto told = meeting.at(x);
      ASSERT_TRUE(told.has_value());
      if (boundaries_meet(a, b, x)) {
        EXPECT_TRUE(*told) << x.transpose();
        ++meets;
      } else if (!*told) {
        ++apart;   // where the boundaries are apart one may still contain the other
      }
    }
  }
  EXPECT_GT(meets, 40);
  EXPECT_GT(apart, 40);
}

// A box in which the answer is always yes holds it for every point; touching is never claimed.
TEST(Meeting, ThroughoutABoxIsTrueOfItsPoints) {
  std::mt19937 random(2);
  const Mesh a = turned(torus(9, 6), random_rotation(random)), b = turned(box({0, 0, 0}, {1, 1, 1}), random_rotation(random));
  const SumOperand one(make(a), {}), other(make(b), {});
  const Meeting meeting(one, other);
  int held = 0;
  for (int k = 0; k < 400; ++k) {
    const Vec3 x = uniform(random, -4, 4);
    const Box3 around(x - Vec3::Constant(0.1), x + Vec3::Constant(0.1));
    if (!meeting.throughout(around)) continue;
    ++held;
    for (int i = 0; i < 20; ++i) EXPECT_EQ(meeting.at(x + uniform(random, -0.1, 0.1)), std::optional(true));
  }
  EXPECT_GT(held, 20);
}

}  // namespace
}  // namespace starcell
