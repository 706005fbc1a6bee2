// Simplification: same topology, embedded also as float32, within the bound by sampling; flat sides to the fewest triangles there are.
#include "operations/simplify.h"

#include "contouring/embedding.h"
#include "operations/results.h"
#include "solids/point_distance.h"

namespace starcell {
namespace {

using namespace sample;

// The farthest that corners and random points of one mesh are from the other.
double farthest(const std::vector<Vec3>& from, const std::vector<Triangle>& from_triangles, const Result& to, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> weight(0, 1);
  double farthest = 0;
  for (const Triangle& t : from_triangles) {
    Vec3 w(weight(random), weight(random), weight(random));
    const Vec3 p = (w[0] * from[t[0]] + w[1] * from[t[1]] + w[2] * from[t[2]]) / w.sum();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& s : to.triangles) nearest = std::min(nearest, to_triangle(p, to.vertices[s[0]], to.vertices[s[1]], to.vertices[s[2]]));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

// Every triangle in four, again and again; nothing moves.
Mesh refined(Mesh mesh, int times) {
  for (int k = 0; k < times; ++k) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (fresh) mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
      return at->second;
    };
    std::vector<Triangle> four;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) four.push_back(t);
    }
    mesh.triangles = four;
  }
  return mesh;
}

// Scans of more triangles than collapses are worth are contoured first; the bound is of both, and what was before is the scan.
TEST(Simplify, ContoursHugeMeshesFirst) {
  const Mesh ring = torus(320, 240);
  ASSERT_GT(ring.triangles.size(), 150000u);
  const Result r = simplify(solid(ring), with_error(0.2));
  EXPECT_GT(r.certificate.statistics.at("cells"), 0);
  EXPECT_EQ(r.certificate.statistics.at("triangles.before"), 153600);
  EXPECT_EQ(r.certificate.verdict, Verdict::exact);
  EXPECT_EQ(topology(r), (Topology{1, {1}}));
  EXPECT_LE(r.certificate.error_bound, 0.2);
  EXPECT_LT(r.triangles.size(), 200u);
  const Mesh coarse = torus(32, 24);   // some of the scan's points: the same circles
  EXPECT_LE(farthest(coarse.vertices, coarse.triangles, r, 3), r.certificate.error_bound + 0.02);
}

TEST(Simplify, KeepsTopologyWithinTheError) {
  std::mt19937 random(5);
  for (const double error : {0.2, 0.05, 0.01}) {
    const Mesh ring = turned(torus(48, 24), random_rotation(random), {100, -20, 3});
    const Result r = simplify(solid(ring), with_error(error));
    EXPECT_EQ(r.certificate.verdict, Verdict::exact);
    EXPECT_EQ(topology(r), (Topology{1, {1}}));
    EXPECT_EQ(bad_edges(r), 0u);
    EXPECT_LE(r.certificate.error_bound, error);
    EXPECT_LE(farthest(ring.vertices, ring.triangles, r, 1), r.certificate.error_bound);
    EXPECT_LE(farthest(r.vertices, r.triangles, Result{ring.vertices, ring.triangles, {}}, 2), r.certificate.error_bound);
    for (const auto& pairs : meeting_pairs(r.vertices, r.triangles, every_rounding)) EXPECT_TRUE(pairs.empty());
    EXPECT_EQ(r.certificate.statistics.at("triangles.before"), 2304);
    EXPECT_LT(r.triangles.size(), error > 0.1 ? 120u : error > 0.03 ? 500u : 1600u);
  }
}

// Sides of many triangles, in any rotation: the box's twelve are left, and its edges are sharp.
TEST(Simplify, LeavesTheFewestOfFlatSides) {
  std::mt19937 random(6);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix3d rotation = k == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : random_rotation(random);
    const Mesh plate = turned(refined(box({0, 0, 0}, {10, 10, 1}), 4), rotation);
    const Result r = simplify(solid(plate), with_error(0.01));
    EXPECT_EQ(r.triangles.size(), 12u);
    EXPECT_NEAR(volume(r.vertices, r.triangles), 100, 1e-9);
    EXPECT_LT(r.certificate.error_bound, 1e-6);   // a seam of a thousandth of the error, at most
  }
}

// What is no mesh is contoured first; the bound holds all of it.
TEST(Simplify, OfCurvedSolids) {
  const Expression ball(CurvedSolid::sphere({1, 2, 3}, 2));
  const Result r = simplify(ball, with_error(0.05));
  EXPECT_EQ(topology(r), (Topology{1, {0}}));
  EXPECT_LE(r.certificate.error_bound, 0.05);
  for (const Vec3& p : r.vertices) EXPECT_NEAR((p - Vec3(1, 2, 3)).norm(), 2, 0.05);
  EXPECT_LT(r.triangles.size(), evaluate(ball, with_error(0.05)).triangles.size());
}

TEST(Simplify, StopsWhenToldTo) {
  Options options = with_error(0.01);
  options.progress = [](double, const std::string&) { return false; };
  EXPECT_THROW(simplify(solid(torus(30, 20)), options), CancelledError);
  options = with_error(0.0);
  EXPECT_THROW(simplify(solid(torus(30, 20)), options), std::invalid_argument);
}

}  // namespace
}  // namespace starcell
