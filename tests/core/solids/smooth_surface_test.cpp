// Enclosures of curved solids' surfaces: checked against the functions written out again here, at random places, with random maps.
#include "solids/smooth_surface.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "solids/curved_solid.h"

namespace starcell {
namespace {

struct Sample {
  const char* name;
  CurvedSolidPtr solid;
  std::function<double(const Vec3&)> inside;   // negative inside its curved surface, in the solid's own coordinates
};

// Every kind, in coordinates that are easy to write out; the maps come on top.
std::vector<Sample> samples() {
  Eigen::Matrix4d saddle = Eigen::Matrix4d::Zero();
  saddle.diagonal() << 1, -0.5, 0.25, -1;
  return {{"sphere", CurvedSolid::sphere({1, 2, 3}, 0.7), [](const Vec3& p) { return (p - Vec3(1, 2, 3)).norm() - 0.7; }},
          {"ellipsoid", CurvedSolid::ellipsoid({0, 1, 0}, {1, 2, 0.5}, Eigen::Matrix3d::Identity()),
           [](const Vec3& p) { return (p - Vec3(0, 1, 0)).cwiseQuotient(Vec3(1, 2, 0.5)).norm() - 1; }},
          {"cylinder", CurvedSolid::cylinder({1, 0, 0}, {0, 0, 2}, 0.8, 3), [](const Vec3& p) { return std::hypot(p.x() - 1, p.y()) - 0.8; }},
          {"cone", CurvedSolid::cone({0, 0, 1}, {0, 0, 1}, 1, 0.25, 2), [](const Vec3& p) { return std::hypot(p.x(), p.y()) - (1 - 0.375 * (p.z() - 1)); }},
          {"sharp cone", CurvedSolid::cone({0, 0, 0}, {0, 0, 1}, 1, 0, 2), [](const Vec3& p) { return std::hypot(p.x(), p.y()) - (1 - 0.5 * p.z()); }},
          {"torus", CurvedSolid::torus({0, 0, 0}, {0, 0, 1}, 2, 0.6), [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 2, p.z()) - 0.6; }},
          {"quadric", CurvedSolid::quadric(saddle), [](const Vec3& p) { return p.x() * p.x() - 0.5 * p.y() * p.y() + 0.25 * p.z() * p.z() - 1; }}};
}

Eigen::Matrix4d random_map(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  do {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) map(i, j) = unit(random);
  } while (std::abs(map.topLeftCorner<3, 3>().determinant()) < 0.1);
  return map;
}

Vec3 random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> unit(-reach, reach);
  return {unit(random), unit(random), unit(random)};
}

TEST(SmoothSurface, SignsAreThoseOfTheMappedSolid) {
  std::mt19937 random(1);
  for (const Sample& s : samples())
    for (int i = 0; i < 40; ++i) {
      const Eigen::Matrix4d first = random_map(random), second = random_map(random);
      const auto solid = s.solid->transformed(first)->transformed(second);
      for (int k = 0; k < 50; ++k) {
        const Vec3 own = random_point(random, 3), p = (second * first * own.homogeneous()).hnormalized();
        const double expected = s.inside(own);
        if (std::abs(expected) < 1e-9) continue;
        EXPECT_EQ(solid->surfaces().front()->sign(p), expected < 0 ? -1 : 1) << s.name;
      }
    }
}

// At points of a random box: values in the range, differences along it in the slope, interpolation's excess as promised.
TEST(SmoothSurface, ExpansionsEncloseTheFunction) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0, 1);
  for (const Sample& s : samples())
    for (int i = 0; i < 300; ++i) {
      const auto solid = i % 3 == 0 ? s.solid : s.solid->transformed(random_map(random));
      const SmoothSurface& surface = *solid->surfaces().front();
      const Vec3 center = random_point(random, 3);
      Vec3 reach = random_point(random, i % 2 ? 1 : 0.05).cwiseAbs();
      if (i % 5 == 0) reach[i % 3] = 0;   // a face
      const auto place = [&] { return Vec3(center + random_point(random, 1).cwiseProduct(reach)); };
      const std::array<Vec3, 3> p{place(), place(), place()};
      const double weights[3] = {share(random), share(random), share(random)}, sum = weights[0] + weights[1] + weights[2];
      const Vec3 x = (weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2]) / sum;
      const double f[3] = {surface.value(p[0]), surface.value(p[1]), surface.value(p[2])}, f_x = surface.value(x);
      const double interpolated = (weights[0] * f[0] + weights[1] * f[1] + weights[2] * f[2]) / sum;
      const double on_edge = surface.value(0.5 * (p[0] + p[1]));
      const Rounding rounding;
      const Expansion e = surface.expand(center, reach);
      const double rounded = 1e-11 * (1 + std::abs(f_x));
      EXPECT_LE(e.range().lower(), f_x + rounded) << s.name;
      EXPECT_GE(e.range().upper(), f_x - rounded) << s.name;
      const Interval along = e.along(p[1] - p[0]);
      EXPECT_LE(along.lower(), f[1] - f[0] + rounded) << s.name;
      EXPECT_GE(along.upper(), f[1] - f[0] - rounded) << s.name;
      const Interval excess = e.excess(p[0], p[1], p[2]), edge = e.excess(p[0], p[1]);
      EXPECT_LE(excess.lower(), interpolated - f_x + rounded) << s.name;
      EXPECT_GE(excess.upper(), interpolated - f_x - rounded) << s.name;
      EXPECT_LE(edge.lower(), 0.5 * (f[0] + f[1]) - on_edge + rounded) << s.name;
      EXPECT_GE(edge.upper(), 0.5 * (f[0] + f[1]) - on_edge - rounded) << s.name;
    }
}

// F + c G is enclosed by the combination: two unit spheres 2 + 1e-6 apart, of which G + F never vanishes.
TEST(SmoothSurface, CombinationsTellNearlyTouchingSpheresApart) {
  const auto a = CurvedSolid::sphere({0, 0, 0}, 1), b = CurvedSolid::sphere({2 + 1e-6, 0, 0}, 1);
  const Rounding rounding;
  const Vec3 center(1, 0.01, 0.02), reach(0.1, 0.1, 0.1);
  const Expansion f = a->surfaces()[0]->expand(center, reach), g = b->surfaces()[0]->expand(center, reach);
  EXPECT_EQ(certain_sign(f.range()), 0);
  EXPECT_EQ(certain_sign(g.range()), 0);
  EXPECT_EQ(certain_sign(combine(1, f, 1, g).range()), 1);
}

TEST(SmoothSurface, CoincidentSurfacesOfRevolutionAreFound) {
  const Box3 box(Vec3(-3, -3, -3), Vec3(3, 3, 3));
  const auto distance = [&](const CurvedSolidPtr& a, const CurvedSolidPtr& b) { return surface_distance(*a->surfaces()[0], *b->surfaces()[0], box); };
  // The same cylinder from another base point, and 1e-4 thicker.
  const auto cylinder = CurvedSolid::cylinder({0, 0, 0}, {1, 1, 0}, 1, 1);
  EXPECT_LT(*distance(cylinder, CurvedSolid::cylinder({2, 2, 0}, {-3, -3, 0}, 1, 5)), 1e-11);
  EXPECT_NEAR(*distance(cylinder, CurvedSolid::cylinder({2, 2, 0}, {-3, -3, 0}, 1.0001, 5)), 1e-4, 1e-9);
  // Two frusta of one cone: radius 1 to 0.5 over a height of 1, and the next 0.5 to 0.25 over 0.5.
  const auto cone = CurvedSolid::cone({0, 0, 0}, {0, 0, 1}, 1, 0.5, 1);
  EXPECT_LT(*distance(cone, CurvedSolid::cone({0, 0, 1}, {0, 0, 1}, 0.5, 0.25, 0.5)), 1e-11);
  EXPECT_LT(*distance(cone, CurvedSolid::cone({0, 0, 1.5}, {0, 0, -1}, 0.25, 1, 1.5)), 1e-11);
  EXPECT_FALSE(distance(cone, CurvedSolid::cone({0, 0, 4}, {0, 0, -1}, 1, 0.5, 1)).has_value());   // opens the other way
  EXPECT_FALSE(distance(cylinder, cone).has_value());
  const auto torus = CurvedSolid::torus({1, 0, 0}, {0, 0, 1}, 1, 0.2);
  EXPECT_LT(*distance(torus, CurvedSolid::torus({1, 0, 0}, {0, 0, -5}, 1, 0.2)), 1e-11);
}

TEST(CurvedSolid, BoxesTouchTheSolid) {
  std::mt19937 random(3);
  for (const Sample& s : samples()) {
    if (!s.solid->bounding_box()) continue;
    const auto solid = s.solid->transformed(random_map(random));
    const Box3 box = *solid->bounding_box();
    // No point is outside the box and inside the solid; just inside each side there is one, near the surface.
    int outside = 0;
    for (int i = 0; i < 200000; ++i) {
      const Vec3 p = box.center() + random_point(random, 0.6).cwiseProduct(box.sizes());
      bool inside = solid->surfaces()[0]->value(p) < 0;
      for (const EndPlane& end : solid->ends()) inside = inside && end.normal.dot(p) < end.offset;
      if (inside && !box.contains(p)) ++outside;
    }
    EXPECT_EQ(outside, 0) << s.name;
  }
}

TEST(CurvedSolid, BadArgumentsAreNamed) {
  const auto message = [](const std::function<CurvedSolidPtr()>& make) -> std::string {
    try {
      make();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_TRUE(message([] { return CurvedSolid::sphere({0, 0, 0}, 0); }).starts_with("radius"));
  EXPECT_TRUE(message([] { return CurvedSolid::cylinder({0, 0, 0}, {0, 0, 0}, 1, 1); }).starts_with("axis"));
  EXPECT_TRUE(message([] { return CurvedSolid::cylinder({0, 0, 0}, {0, 0, 1}, 1, -1); }).starts_with("height"));
  EXPECT_TRUE(message([] { return CurvedSolid::cone({0, 0, 0}, {0, 0, 1}, 0, 0, 1); }).starts_with("radius2"));
  EXPECT_TRUE(message([] { return CurvedSolid::torus({0, 0, 0}, {0, 0, 1}, 1, 1); }).starts_with("minor"));
  EXPECT_TRUE(message([] { return CurvedSolid::ellipsoid({0, 0, 0}, {1, 1, 1}, Eigen::Matrix3d::Ones()); }).starts_with("rotation"));
  EXPECT_TRUE(message([] { return CurvedSolid::quadric(Eigen::Matrix4d::Zero()); }).starts_with("matrix4x4"));
}

}  // namespace
}  // namespace starcell
