// Remeshing: same topology, embedded, within the bound by sampling; good angles; sharp edges exactly where they were.
#include "operations/remesh.h"

#include <algorithm>
#include <cmath>

#include "operations/results.h"
#include "remeshing/triangle_shape.h"
#include "solids/point_distance.h"

namespace starcell {
namespace {

using namespace sample;

double farthest(const Result& from, const Result& to) {
  double farthest = 0;
  for (const Triangle& t : from.triangles) {
    const Vec3 p = (from.vertices[t[0]] + from.vertices[t[1]] + from.vertices[t[2]]) / 3;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& s : to.triangles) nearest = std::min(nearest, to_triangle(p, to.vertices[s[0]], to.vertices[s[1]], to.vertices[s[2]]));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

// The part of the triangles that have an angle below this, in degrees.
double part_below(const Result& r, double degrees) {
  const auto below = [&](const Triangle& t) { return least_angle({r.vertices[t[0]], r.vertices[t[1]], r.vertices[t[2]]}) < degrees * M_PI / 180; };
  return static_cast<double>(std::count_if(r.triangles.begin(), r.triangles.end(), below)) / static_cast<double>(r.triangles.size());
}

// The length of the result's edges that lie on the segment.
double length_on(const Result& r, const Vec3& p, const Vec3& q) {
  const auto is_on = [&](const Vec3& x) { return (x - p).cross(q - p).norm() <= 1e-11 * (q - p).norm() && (x - p).dot(x - q) <= 1e-11; };
  double length = 0;
  for (const Triangle& t : r.triangles)
    for (int k = 0; k < 3; ++k)
      if (const Vec3 &a = r.vertices[t[k]], &b = r.vertices[t[(k + 1) % 3]]; t[k] < t[(k + 1) % 3] && is_on(a) && is_on(b)) length += (b - a).norm();
  return length;
}

TEST(Remesh, OfASmoothSurface) {
  std::mt19937 random(7);
  const Mesh ring = turned(torus(60, 24), random_rotation(random), {5, 100, -3});   // quads of 0.2 to 0.4 by 0.26
  for (const double edge_length : {0.2, 0.5}) {
    const Result r = remesh(solid(ring), edge_length, default_feature_angle, with_error(0.08));
    EXPECT_EQ(r.certificate.verdict, Verdict::exact);
    EXPECT_EQ(topology(r), (Topology{1, {1}}));
    expect_sound(r);
    const Result input{ring.vertices, ring.triangles, {}};
    EXPECT_LE(std::max(farthest(input, r), farthest(r, input)), r.certificate.error_bound);
    EXPECT_LE(r.certificate.error_bound, 0.08);
    EXPECT_LE(part_below(r, 25), 0.01);
    const double equilateral = std::sqrt(0.75) / 2 * edge_length * edge_length, area = 4 * M_PI * M_PI * 3;   // radii 3 and 1
    EXPECT_NEAR(static_cast<double>(r.triangles.size()), area / equilateral, 0.5 * area / equilateral);
  }
}

// All twelve edges of a plate stay, to the rounding; beside its low sides triangles are as small as these, and well shaped.
TEST(Remesh, LeavesSharpEdgesWhereTheyAre) {
  std::mt19937 random(8);
  const Eigen::Matrix3d rotation = random_rotation(random);
  const Vec3 sides(10, 6, 0.4);
  const Mesh plate = turned(box({0, 0, 0}, sides), rotation);
  const Result r = remesh(solid(plate), 1.5, default_feature_angle, with_error(0.1));
  expect_sound(r);
  EXPECT_EQ(r.certificate.verdict, Verdict::exact);
  EXPECT_LT(r.certificate.error_bound, 1e-9);
  EXPECT_NEAR(volume(r), 24, 1e-10);
  EXPECT_EQ(part_below(r, 25), 0);
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      Vec3 p = Vec3::Zero();
      p[(axis + 1) % 3] = corner & 1 ? sides[(axis + 1) % 3] : 0;
      p[(axis + 2) % 3] = corner & 2 ? sides[(axis + 2) % 3] : 0;
      Vec3 q = p;
      q[axis] = sides[axis];
      EXPECT_NEAR(length_on(r, rotation * p, rotation * q), sides[axis], 1e-10);
    }
  EXPECT_EQ(r.certificate.statistics.at("features.corners"), 8);
  EXPECT_EQ(r.certificate.statistics.at("triangles.before"), 12);
  EXPECT_GT(r.certificate.statistics.at("angle.least"), r.certificate.statistics.at("angle.least.before"));
}

// A drum of needles: 120 sides, its ends fans from a corner. The rims' 240 corners stay.
TEST(Remesh, OfNeedles) {
  constexpr std::uint32_t n = 120;
  Mesh drum;
  for (const double z : {0.0, 3.0})
    for (std::uint32_t i = 0; i < n; ++i) drum.vertices.emplace_back(2 * std::cos(2 * M_PI * i / n), 2 * std::sin(2 * M_PI * i / n), z);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    drum.triangles.push_back({i, j, n + j});
    drum.triangles.push_back({i, n + j, n + i});
    if (i > 0 && j > 0) drum.triangles.push_back({0, j, i}), drum.triangles.push_back({n, n + i, n + j});
  }
  const Result r = remesh(solid(drum), 0.5, default_feature_angle, with_error(0.05));
  expect_sound(r);
  EXPECT_EQ(topology(r), solid_ball());
  EXPECT_GT(part_below({drum.vertices, drum.triangles, {}}, 25), 0.9);
  EXPECT_LE(part_below(r, 25), 0.01);
  for (const Vec3& corner : drum.vertices) EXPECT_TRUE(std::count(r.vertices.begin(), r.vertices.end(), corner) == 1) << corner.transpose();
}

// Contoured meshes have folds of a few float32 steps: cut in pieces without a look at the rounding they would cross.
TEST(Remesh, StaysEmbeddedInFloat32) {
  const auto as_solid = [](const Result& r) { return Expression(Polyhedron::trusted(r.vertices, r.triangles, {})); };
  const Result block = evaluate(Expression::set_union({solid(box({0, 0, 0}, {60, 40, 10})), solid(box({31, 11, 3}, {51, 31, 33}))}), with_error(0.2));
  const Expression bore(CurvedSolid::cylinder({41, 21, -10}, {0, 0, 1}, 8, 60));
  const Result part = evaluate(Expression::difference(as_solid(block), bore), with_error(0.2));
  const Result r = remesh(as_solid(part), std::nullopt, default_feature_angle, with_error(60.0 / 128));
  EXPECT_EQ(r.certificate.verdict, Verdict::exact);
  EXPECT_EQ(topology(r), (Topology{1, {1}}));
  expect_sound(r);
}

TEST(Remesh, OfCurvedSolids) {
  const Result r = remesh(Expression(CurvedSolid::sphere({1, 2, 3}, 2)), std::nullopt, default_feature_angle, with_error(0.05));
  EXPECT_EQ(topology(r), solid_ball());
  EXPECT_LE(r.certificate.error_bound, 0.05);
  EXPECT_EQ(r.certificate.statistics.at("edge_length"), 0.25);
  for (const Vec3& p : r.vertices) EXPECT_NEAR((p - Vec3(1, 2, 3)).norm(), 2, 0.05);
  EXPECT_LE(part_below(r, 25), 0.01);
}

TEST(Remesh, RefusesWhatIsOutOfRangeAndStopsWhenToldTo) {
  const Expression ring = solid(torus(30, 20));
  for (const double length : {0.0, -1.0, std::nan(""), HUGE_VAL}) EXPECT_THROW(remesh(ring, length, 40, with_error(0.1)), std::invalid_argument);
  for (const double angle : {0.0, 180.0, std::nan("")}) EXPECT_THROW(remesh(ring, 0.1, angle, with_error(0.1)), std::invalid_argument);
  Options options = with_error(0.1);
  options.progress = [](double done, const std::string&) { return done < 0.3; };
  EXPECT_THROW(remesh(ring, 0.4, 40, options), CancelledError);
}

}  // namespace
}  // namespace starcell
