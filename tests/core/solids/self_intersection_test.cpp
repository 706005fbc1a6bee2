// Which pairs of triangles count as meeting: claims on hand-made pairs, and agreement with exact constructions.
#include "solids/self_intersection.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include "solids/sample_meshes.h"
#include "solids/triangle_pair.h"

namespace starcell {
namespace {

using namespace sample;

SelfIntersections found_in(const Mesh& mesh) {
  return find_self_intersections(mesh.vertices, mesh.triangles, TriangleHierarchy(mesh.vertices, mesh.triangles));
}

// Do the two triangles meet outside shared vertices? The same answer in every order of corners and triangles.
bool meet(const std::vector<Vec3>& v, const Triangle& s, const Triangle& t) {
  const bool answer = meet_outside_shared(v, s, t);
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_EQ(meet_outside_shared(v, {s[turn], s[(turn + 1) % 3], s[(turn + 2) % 3]}, {t[1], t[0], t[2]}), answer);
    EXPECT_EQ(meet_outside_shared(v, {t[turn], t[(turn + 1) % 3], t[(turn + 2) % 3]}, {s[0], s[2], s[1]}), answer);
  }
  return answer;
}

TEST(TrianglePair, FoldedOverASharedEdge) {
  // Edge (0,0,0)-(1,0,0); the second apex on the same side of it, on the other side, or lifted by the least amount.
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(meet({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 2, 0}}, {0, 1, 2}, {1, 0, 3}));
  EXPECT_FALSE(meet({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -2, 0}}, {0, 1, 2}, {1, 0, 3}));
  EXPECT_FALSE(meet({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 2, least}}, {0, 1, 2}, {1, 0, 3}));
  EXPECT_FALSE(meet({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 1, 2}, {1, 0, 3}));
}

TEST(TrianglePair, OneSharedVertex) {
  const std::vector<Vec3> base = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto with = [&](Vec3 c, Vec3 d) {
    std::vector<Vec3> v = base;
    v.push_back(c);
    v.push_back(d);
    return meet(v, {0, 1, 2}, {0, 3, 4});
  };
  EXPECT_TRUE(with({1, 1, 1}, {1, 1, -1}));           // its far edge pierces the base triangle's line x + y = 1 beyond it
  EXPECT_TRUE(with({0.25, 0.25, 1}, {0.25, 0.25, -1}));  // pierces the inside
  EXPECT_FALSE(with({-1, -1, 1}, {-1, -1, -1}));       // crosses the plane on the other side of the vertex
  EXPECT_FALSE(with({0.25, 0.25, 1}, {0.5, 0.25, 2}));  // above
  EXPECT_TRUE(with({0.25, 0.25, 0}, {0.5, 0.25, 2}));  // one corner on the base triangle
  EXPECT_TRUE(with({2, 0, 0}, {0, 0, 1}));             // runs along an edge of the base triangle, without sharing it
  EXPECT_TRUE(with({2, 1, 0}, {1, 2, 0}));             // coplanar, overlapping
  EXPECT_FALSE(with({-1, 0, 0}, {0, -1, 0}));          // coplanar, opposite
  EXPECT_FALSE(with({0, -1, 0}, {1, -1, 0}));          // coplanar, beside
}

TEST(TrianglePair, NothingShared) {
  const auto with = [&](Vec3 a, Vec3 b, Vec3 c) {
    return meet({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, a, b, c}, {0, 1, 2}, {3, 4, 5});
  };
  EXPECT_TRUE(with({1, 1, -1}, {1, 1, 1}, {5, 5, 0}));     // pierced
  EXPECT_TRUE(with({1, 1, 0}, {1, 1, 1}, {2, 2, 1}));      // touched by a vertex inside
  EXPECT_TRUE(with({2, 2, 0}, {5, 5, 1}, {5, 5, -1}));     // touched on the edge
  EXPECT_TRUE(with({4, 0, 0}, {5, 0, 1}, {5, 0, -1}));     // touched in a vertex that is not the same vertex
  EXPECT_TRUE(with({1, 1, 0}, {2, 1, 0}, {1, 2, 0}));      // coplanar, inside
  EXPECT_TRUE(with({2, 2, 0}, {4, 4, 0}, {4, 3, 0}));      // coplanar, touching
  EXPECT_FALSE(with({2.5, 2, 0}, {4, 4, 0}, {4, 3, 0}));   // coplanar, apart
  EXPECT_FALSE(with({1, 1, 1e-300}, {2, 1, 1}, {1, 2, 1}));  // above by next to nothing
  const double above = std::nextafter(2.0, 3.0);
  EXPECT_FALSE(with({above, 2, 0}, {5, 5, 1}, {5, 5, -1}));  // beyond the edge by one unit in the last place
}

TEST(TrianglePair, CollinearPointsHaveNoArea) {
  EXPECT_TRUE(has_no_area({0, 0, 0}, {1, 2, 3}, {2, 4, 6}));
  EXPECT_TRUE(has_no_area({0, 0, 0}, {3, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(has_no_area({0, 0, 0}, {1, 2, 3}, {2, 4, std::nextafter(6.0, 7.0)}));
  EXPECT_FALSE(has_no_area({0, 0, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}));  // the area underflows, but is not zero
}

TEST(SelfIntersection, TwoCubesCrossing) {
  const std::string message = refusal(joined({box({0, 0, 0}, {1, 1, 1}), box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5})}));
  EXPECT_TRUE(has(message, "pairs of triangles that intersect (the first at (")) << message;
}

TEST(SelfIntersection, CubesThatTouchWithoutSharedVertices) {
  const Mesh cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(has(refusal(joined({cube, box({0.25, 0.25, 1}, {0.75, 0.75, 2})})), "intersect"));   // face on face
  EXPECT_TRUE(has(refusal(joined({cube, box({1, 0.25, 1}, {2, 0.75, 2})})), "intersect"));         // edge on edge
  EXPECT_TRUE(has(refusal(joined({cube, moved(tetrahedron(), {0.25, 0.25, 1})})), "intersect"));   // face on face
  EXPECT_EQ(refusal(joined({cube, box({0.25, 0.25, std::nextafter(1.0, 2.0)}, {0.75, 0.75, 2})})), "");  // apart by 2e-16
}

TEST(SelfIntersection, AZeroAreaTriangleIsRefused) {
  // A cube whose edge (0,0,0)-(1,0,0) is split on one side only: a collinear triangle closes the T-junction.
  Mesh cube = box({0, 0, 0}, {1, 1, 1});
  cube.vertices.emplace_back(0.5, 0, 0);
  cube.triangles[0] = {0, 2, 8};  // was (0, 2, 1)
  cube.triangles.push_back({8, 2, 1});
  cube.triangles.push_back({0, 8, 1});
  const std::string message = refusal(cube);
  EXPECT_TRUE(has(message, "1 zero-area triangle, which makes it self-intersect")) << message;
  EXPECT_FALSE(has(message, "open") || has(message, "manifold")) << message;
}

TEST(SelfIntersection, VeryManyPairsAreNotAllCounted) {
  // 2000 long triangles through one line: two million pairs.
  Mesh fan;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const double a = std::numbers::pi * i / 2000;
    fan.vertices.insert(fan.vertices.end(), {{std::cos(a), std::sin(a), 0}, {-std::cos(a), -std::sin(a), 1}, {-std::cos(a), -std::sin(a), -1}});
    fan.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const SelfIntersections found = found_in(fan);
  EXPECT_FALSE(found.all_found);
  EXPECT_EQ(found.pairs.count, SelfIntersections::kMostPairs);
  EXPECT_TRUE(has(refusal(fan), "more than 1000 pairs of triangles that intersect"));
}

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

// Is the common part of two triangles, constructed exactly, more than the vertex or edge that they share?
struct IsMoreThan {
  std::vector<Exact::Point_3> shared;
  bool on_shared(const Exact::Point_3& p) const {
    return shared.size() == 2 ? Exact::Segment_3(shared[0], shared[1]).has_on(p) : shared.size() == 1 && shared[0] == p;
  }
  bool operator()(const Exact::Point_3& p) const { return !on_shared(p); }
  bool operator()(const Exact::Segment_3& s) const { return !on_shared(s.source()) || !on_shared(s.target()); }
  bool operator()(const Exact::Triangle_3&) const { return true; }
  bool operator()(const std::vector<Exact::Point_3>&) const { return true; }
};

// The pairs that meet, by CGAL's exact constructions on all pairs: shares nothing with the search under test.
std::size_t exact_count(const Mesh& mesh) {
  std::vector<Exact::Triangle_3> triangles;
  for (const Triangle& t : mesh.triangles) {
    const auto point = [&](int k) { const Vec3& p = mesh.vertices[t[k]]; return Exact::Point_3(p[0], p[1], p[2]); };
    triangles.emplace_back(point(0), point(1), point(2));
  }
  std::size_t count = 0;
  for (std::size_t s = 0; s < triangles.size(); ++s)
    for (std::size_t t = s + 1; t < triangles.size(); ++t) {
      if (!CGAL::do_overlap(triangles[s].bbox(), triangles[t].bbox())) continue;
      IsMoreThan more;
      for (int k = 0; k < 3; ++k)
        if (std::count(mesh.triangles[t].begin(), mesh.triangles[t].end(), mesh.triangles[s][k])) more.shared.push_back(triangles[s].vertex(k));
      const auto common = CGAL::intersection(triangles[s], triangles[t]);
      count += common && boost::apply_visitor([&](const auto& part) { return more(part); }, *common);
    }
  return count;
}

TEST(SelfIntersection, AgreesWithExactConstructionsOnRandomSmallSoups) {
  std::mt19937 random(5);
  int compared = 0;
  for (int round = 0; round < 3000; ++round) {
    // Few vertices on a small grid: shared vertices, shared edges, coplanar and touching triangles abound.
    const std::uint32_t vertices = 6 + random() % 4;
    const int grid = 2 + random() % 3;
    Mesh mesh;
    for (std::uint32_t v = 0; v < vertices; ++v)
      mesh.vertices.emplace_back(random() % grid, random() % grid, random() % (round % 2 ? grid : 1));
    const auto corner = [&] { return static_cast<std::uint32_t>(random() % vertices); };
    for (int t = 0; t < 4; ++t) {
      const Triangle s = {corner(), corner(), corner()};
      if (has_no_area(mesh.vertices[s[0]], mesh.vertices[s[1]], mesh.vertices[s[2]])) continue;
      bool doubled = false;  // counted elsewhere
      for (const Triangle& other : mesh.triangles) doubled |= std::is_permutation(s.begin(), s.end(), other.begin());
      if (!doubled) mesh.triangles.push_back(s);
    }
    ASSERT_EQ(found_in(mesh).pairs.count, exact_count(mesh)) << "round " << round;
    ++compared;
  }
  EXPECT_EQ(compared, 3000);
}

TEST(SelfIntersection, AgreesWithExactConstructionsOnBlobsThatCross) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> wobble(0.8, 1.2), shift(-1.0, 1.0);
  for (int round = 0; round < 12; ++round) {
    const auto blob = [&] { return star_shape(2, [&](const Vec3&) { return wobble(random); }); };
    const Mesh two = joined({blob(), moved(blob(), {shift(random), shift(random), shift(random)})});
    const std::size_t expected = exact_count(two);
    EXPECT_EQ(found_in(two).pairs.count, expected);
    EXPECT_EQ(refusal(two).empty(), expected == 0);
  }
}

TEST(SelfIntersection, StarShapesDoNotIntersect) {
  // Radii at random: each triangle is seen from the centre in its own direction, so none can meet another's inside.
  std::mt19937 random(8);
  for (int round = 0; round < 20; ++round) {
    std::uniform_real_distribution<double> radius(round < 10 ? 0.1 : 0.999999, 1.0);
    const Mesh mesh = star_shape(4, [&](const Vec3&) { return radius(random); });
    EXPECT_EQ(refusal(mesh), "");
  }
}

TEST(SelfIntersection, FlatMeshesAtAnyRotation) {
  // A plate of 12 x 12 squares, turned: nearly coplanar triangles everywhere, some exactly so, none meeting.
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 3; ++round) {
    const Eigen::Matrix3d turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
    const int n = 12;
    Mesh plate = torus(n, n, 3, 1);
    for (std::size_t v = 0; v < plate.vertices.size(); ++v) {
      // A square ring of rectangular cross-section, sampled at 0..n-1 around both ways: flat sides.
      const auto square = [&](double x) {
        const double s = 4 * x / n;  // position along the four sides of [-1, 1]^2
        return s < 1 ? Eigen::Vector2d(-1 + 2 * s, -1) : s < 2 ? Eigen::Vector2d(1, -3 + 2 * s) : s < 3 ? Eigen::Vector2d(5 - 2 * s, 1) : Eigen::Vector2d(-1, 7 - 2 * s);
      };
      const Eigen::Vector2d a = square(double(v / n)), b = square(double(v % n));
      plate.vertices[v] = turn * Vec3(a[0] * (3 + b[0]), a[1] * (3 + b[0]), b[1]);
    }
    EXPECT_EQ(found_in(plate).pairs.count, exact_count(plate));
    EXPECT_EQ(found_in(plate).pairs.count, 0u);
  }
}

}  // namespace
}  // namespace starcell
