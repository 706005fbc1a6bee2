// The convolution's facets: all of a convex sum's boundary and nothing else, and nothing from features that cannot bound a sum.
#include "minkowski/convolution.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double hull_volume(const std::vector<Vec3>& points) {
  std::vector<Kernel::Point_3> all;
  for (const Vec3& p : points) all.emplace_back(p.x(), p.y(), p.z());
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(all.begin(), all.end(), hull);
  return CGAL::to_double(CGAL::Polygon_mesh_processing::volume(hull));
}

std::vector<Vec3> all_sums(const Mesh& a, const Mesh& b) {
  std::vector<Vec3> sums;
  for (const Vec3& p : a.vertices)
    for (const Vec3& q : b.vertices) sums.push_back(p + q);
  return sums;
}

Convolution convolution_of(const Mesh& a, const Mesh& b) { return convolve(SumOperand(make(a), {}), SumOperand(make(b), {})); }

// Of convex operands in general position the facets close, turn outward, and hold what the hull of all sums of vertices does.
TEST(Convolution, OfConvexOperandsIsTheirSumsBoundary) {
  std::mt19937 random(4);
  for (int k = 0; k < 10; ++k) {
    const Mesh a = turned(box({0, 0, 0}, {1, 2, 3}), random_rotation(random)), b = turned(k % 2 ? sphere(1) : tetrahedron(), random_rotation(random), {5, 0, 1});
    const Convolution c = convolution_of(a, b);
    EXPECT_NEAR(volume(c.points, c.facets), hull_volume(all_sums(a, b)), 1e-9) << k;
    Result closed;
    closed.triangles = c.facets;
    EXPECT_EQ(bad_edges(closed), 0u) << k;
  }
}

// Turned inside out, a box is concave everywhere: nothing of it but its faces has a normal, and those reach no vertex.
TEST(Convolution, LeavesOutWhatIsReflex) {
  const SumOperand hollow(make(box({0, 0, 0}, {3, 3, 3})), {false, true});
  EXPECT_TRUE(hollow.edges().empty());
  EXPECT_TRUE(hollow.vertices().empty());
  EXPECT_EQ(hollow.faces().size(), 12u);
  // Its sum with a box is bounded by the six walls, moved in.
  const Convolution c = convolve(hollow, SumOperand(make(box({-1, -1, -1}, {0, 0, 0})), {}));
  Box3 box;
  for (const Vec3& p : c.points) box.extend(p);
  for (const Triangle& t : c.facets) {
    const Vec3 n = (c.points[t[1]] - c.points[t[0]]).cross(c.points[t[2]] - c.points[t[0]]).normalized();
    EXPECT_NEAR(n.cwiseAbs().maxCoeff(), 1, 1e-12);
    int axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    EXPECT_EQ(c.points[t[0]][axis], n[axis] > 0 ? 0 : 2);   // 0 + 0 and 3 - 1
  }
}

Mesh prism(int sides, double radius, double height, double turn) {
  Mesh m;
  for (const double z : {0.0, height})
    for (int k = 0; k < sides; ++k) m.vertices.emplace_back(radius * std::cos(2 * 3.141592653589793 * k / sides + turn), radius * std::sin(2 * 3.141592653589793 * k / sides + turn), z);
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    m.triangles.push_back({k, next, n + next});
    m.triangles.push_back({k, n + next, n + k});
    if (k == 0 || next == 0) continue;
    m.triangles.push_back({0, next, k});
    m.triangles.push_back({n, n + k, n + next});
  }
  return m;
}

// Parallel ends of many sides: every facet of one meets every corner of the other, but few facets cover either end of the sum, once.
TEST(Convolution, CoversParallelFacesWithFewFacets) {
  std::mt19937 random(7);
  for (int k = 0; k < 4; ++k) {
    const Eigen::Matrix3d rotation = k == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : random_rotation(random);
    const Mesh a = turned(prism(120, 3, 1, 0), rotation), b = turned(prism(90, 1, 2, 0.001), rotation, {4, 5, 6});
    const SumOperand one(make(a), {}), other(make(b), {});
    const Convolution few = convolve(one, other), all = convolve(one, other, {.origins = false, .covers = false, .pause = {}});
    EXPECT_GT(all.facets.size(), 30000u);
    EXPECT_LT(few.facets.size(), 3000u);
    for (const double sense : {1.0, -1.0}) {
      const Vec3 end = sense * rotation.col(2);
      double area = 0;
      for (const Triangle& t : few.facets) {
        const Vec3 n = 0.5 * (few.points[t[1]] - few.points[t[0]]).cross(few.points[t[2]] - few.points[t[0]]);
        if (n.dot(end) > 0.999 * n.norm()) area += n.norm();
      }
      EXPECT_NEAR(area, hull_volume(all_sums(a, b)) / 3, 1e-9);   // of height 1 + 2
    }
  }
}

// Every pair of vertices counts by its place: symmetric operands reach the same sum by several ways, and facets are kept once.
TEST(Convolution, KeepsWhatCoincidesOnce) {
  const Mesh cube = box({0, 0, 0}, {1, 1, 1});
  const Convolution c = convolution_of(cube, cube);
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : c.points) places.insert({p.x(), p.y(), p.z()});
  EXPECT_EQ(places.size(), c.points.size());
  EXPECT_EQ(c.points.size(), 26u);   // {0, 1, 2}^3 without the middle
}

}  // namespace
}  // namespace starcell
