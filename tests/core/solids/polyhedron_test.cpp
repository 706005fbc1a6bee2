// What Polyhedron::make accepts, what it refuses, and in which words.
#include "solids/polyhedron.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;

TEST(Polyhedron, KeepsAValidMeshAsItIs) {
  const Mesh cube = box({0, 0, 0}, {1, 2, 3});
  const PolyhedronPtr made = make(cube);
  EXPECT_EQ(made->vertices(), cube.vertices);
  EXPECT_EQ(made->triangles(), cube.triangles);
  EXPECT_EQ(made->bounding_box().min(), Vec3(0, 0, 0));
  EXPECT_EQ(made->bounding_box().max(), Vec3(1, 2, 3));
}

TEST(Polyhedron, NeighboursLieAcrossTheirEdges) {
  const PolyhedronPtr made = make(torus(9, 7));
  const auto& triangles = made->triangles();
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      // The neighbour runs through the same edge the other way, and names t as its neighbour there.
      const std::uint32_t other = made->neighbours()[t][k];
      int found = -1;
      for (int j = 0; j < 3; ++j)
        if (triangles[other][j] == triangles[t][(k + 1) % 3] && triangles[other][(j + 1) % 3] == triangles[t][k]) found = j;
      ASSERT_GE(found, 0);
      EXPECT_EQ(made->neighbours()[other][found], t);
    }
}

TEST(Polyhedron, RefusesAnOpenMeshAndSaysWhere) {
  Mesh cube = box({0, 0, 0}, {1, 1, 1});
  cube.triangles.pop_back();  // (3, 7, 5): the edges 3-7, 7-5, 5-3 lose a triangle; vertex 3 has the smallest number
  const std::string message = refusal(cube);
  EXPECT_TRUE(has(message, "3 open edges (the first at (1, 1, 0)-(1, 0, 1))")) << message;
}

TEST(Polyhedron, RefusesNumbersThatAreNotFinite) {
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    Mesh cube = box({0, 0, 0}, {1, 1, 1});
    cube.vertices[6][1] = bad;
    EXPECT_TRUE(has(refusal(cube), "1 vertex that is not finite")) << refusal(cube);
  }
}

TEST(Polyhedron, IgnoresNonFiniteVerticesThatNoTriangleUses) {
  Mesh cube = box({0, 0, 0}, {1, 1, 1});
  cube.vertices.emplace_back(NAN, 0, 0);
  EXPECT_EQ(make(cube)->vertices().size(), 8u);
}

TEST(Polyhedron, RefusesADoubledFacet) {
  Mesh cube = box({0, 0, 0}, {1, 1, 1});
  cube.triangles.push_back(cube.triangles[0]);  // its three edges now belong to three triangles each
  const std::string message = refusal(cube);
  EXPECT_TRUE(has(message, "3 non-manifold edges")) << message;
  EXPECT_TRUE(has(message, "1 doubled facet, which is not manifold")) << message;
}

TEST(Polyhedron, RefusesTwoFacetsBackToBack) {
  // Every edge has two triangles in opposite directions, yet nothing is enclosed.
  EXPECT_TRUE(has(refusal({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}), "manifold"));
}

TEST(Polyhedron, RefusesTwoCubesThatShareAnEdge) {
  const Mesh two = joined({box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0}, {2, 2, 1})});
  const std::string message = refusal(two);  // welded, the common edge has four triangles
  EXPECT_TRUE(has(message, "1 non-manifold edge (at (1, 1, 0)-(1, 1, 1))")) << message;
}

TEST(Polyhedron, RefusesTwoCubesThatShareAVertex) {
  const std::string message = refusal(joined({box({0, 0, 0}, {1, 1, 1}), box({1, 1, 1}, {2, 2, 2})}));
  EXPECT_TRUE(has(message, "1 non-manifold vertex (at (1, 1, 1))")) << message;
  EXPECT_FALSE(has(message, "intersect")) << "sharing a welded vertex is one defect, not two: " << message;
}

TEST(Polyhedron, RefusesAMeshWithoutAnInside) {
  // The seven-vertex torus of Moebius glued with a twist is hard to embed; a Klein bottle as a grid with one direction
  // reversed at the seam is enough for the combinatorics. It cannot be embedded either, so it also intersects itself.
  Mesh klein;
  const int n = 8, m = 8;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) klein.vertices.emplace_back(std::cos(i + 0.1 * j), std::sin(1.7 * j), 0.3 * i * j);
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % n) * m + (i < n ? j + m : m - j + m) % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      klein.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      klein.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const std::string message = refusal(klein);
  EXPECT_TRUE(has(message, "1 component that has no inside (not orientable)")) << message;
  EXPECT_FALSE(has(message, "open")) << message;
}

TEST(Polyhedron, RefusesAnEmptyMesh) {
  EXPECT_TRUE(has(refusal({}), "empty"));
  EXPECT_TRUE(has(refusal({{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}}}), "degenerate"));
}

TEST(Polyhedron, DropsDegenerateTrianglesWhenTheRestCloses) {
  Mesh cube = box({0, 0, 0}, {1, 1, 1});
  cube.triangles.insert(cube.triangles.begin() + 4, {1, 1, 5});
  EXPECT_EQ(make(cube)->triangles(), box({0, 0, 0}, {1, 1, 1}).triangles);
}

TEST(Polyhedron, NamesDegenerateTrianglesWhenTheRestDoesNotClose) {
  Mesh cube = box({0, 0, 0}, {1, 1, 1});
  cube.triangles[4] = {1, 1, 5};
  const std::string message = refusal(cube);
  EXPECT_TRUE(has(message, "open") && has(message, "1 degenerate triangle that repeats a vertex")) << message;
}

TEST(Polyhedron, CountsEveryKindOfDefect) {
  Mesh bad = joined({box({0, 0, 0}, {1, 1, 1}), box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}), box({5, 5, 5}, {6, 6, 6})});
  bad.triangles.pop_back();
  bad.triangles.push_back(bad.triangles[0]);
  const std::string message = refusal(bad);
  for (const char* word : {"open", "non-manifold edges", "doubled", "intersect"}) EXPECT_TRUE(has(message, word)) << word << " in " << message;
}

TEST(Polyhedron, NamesAnIndexOutOfRange) {
  try {
    Polyhedron::make(box({0, 0, 0}, {1, 1, 1}).vertices, {{0, 1, 2}, {0, 1, 99}});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(has(error.what(), "triangle 1") && has(error.what(), "99") && has(error.what(), "8 vertices")) << error.what();
  }
}

TEST(Polyhedron, CadFacesFollowTheirTriangles) {
  Mesh cube = box({0, 0, 0}, {1, 1, 1});
  cube.triangles.insert(cube.triangles.begin(), {0, 0, 1});  // dropped, and its label with it
  Provenance provenance{"cube", 0.25, {99, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
  const PolyhedronPtr made = Polyhedron::make(cube.vertices, cube.triangles, provenance);
  ASSERT_EQ(made->provenance().cad_face.size(), 12u);
  for (int t = 0; t < 12; ++t) EXPECT_EQ(made->provenance().cad_face[t], t);
  provenance.cad_face.pop_back();
  EXPECT_THROW(Polyhedron::make(cube.vertices, cube.triangles, provenance), std::invalid_argument);
}

TEST(Polyhedron, AcceptsExtremeButFiniteSizes) {
  for (double size : {1e-300, 1e-150, 1e-20, 1e20, 1e150, 1e300}) {
    const PolyhedronPtr made = make(flipped(box({0, 0, 0}, {size, size, size})));
    // Outward although given inside out: the facet through (0,0,0) with normal -z runs (0, 2, 1).
    EXPECT_EQ(made->triangles()[0], (Triangle{0, 2, 1})) << size;
  }
}

TEST(Polyhedron, AcceptsCoordinatesBeyondFloat32OnBothSides) {
  // The search tree's float32 boxes are infinite here: from -inf to inf, or from the largest float to inf.
  for (double size : {1e39, 1e200}) {
    Mesh mesh = torus(40, 30);
    for (Vec3& p : mesh.vertices) p *= size;
    EXPECT_EQ(make(mesh)->triangles(), mesh.triangles);
  }
}

TEST(Polyhedron, MixesVeryLargeAndVerySmall) {
  // Products of differences under- and overflow; the exact predicates behind the floating-point proofs must decide.
  const Mesh spike = {{{0, 0, 0}, {1e-300, 0, 0}, {0, 1e-300, 0}, {1e150, 1e150, 1e150}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  EXPECT_EQ(make(spike)->triangles(), spike.triangles);
  EXPECT_EQ(make(flipped(spike))->triangles(), spike.triangles);
}

TEST(Polyhedron, RandomTrianglesNeverCrash) {
  std::mt19937 random(7);
  int accepted = 0;
  for (int round = 0; round < 5000; ++round) {
    const std::uint32_t vertices = 4 + random() % 6, count = 1 + random() % 14;
    const auto corner = [&] { return static_cast<std::uint32_t>(random() % vertices); };
    Mesh mesh;
    for (std::uint32_t v = 0; v < vertices; ++v) mesh.vertices.emplace_back(int(random() % 3), int(random() % 3), int(random() % 3));
    for (std::uint32_t t = 0; t < count; ++t) mesh.triangles.push_back({corner(), corner(), corner()});
    accepted += refusal(mesh).empty();
  }
  EXPECT_LT(accepted, 50) << "a random heap of triangles is hardly ever a solid";
}

TEST(Polyhedron, MutatedSolidsAreRefusedOrStillSolid) {
  std::mt19937 random(11);
  const Mesh whole = joined({torus(8, 6), box({10, 0, 0}, {11, 1, 1})});
  for (int round = 0; round < 2000; ++round) {
    Mesh mesh = whole;
    for (int change = 1 + random() % 3; change > 0; --change) {
      Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
      switch (random() % 5) {
        case 0: t[random() % 3] = random() % mesh.vertices.size(); break;
        case 1: std::swap(t[0], t[1]); break;
        case 2: t = mesh.triangles[random() % mesh.triangles.size()]; break;
        case 3: mesh.vertices[random() % mesh.vertices.size()] = mesh.vertices[random() % mesh.vertices.size()]; break;
        case 4: mesh.vertices[random() % mesh.vertices.size()] *= 0.25 * (random() % 8); break;
      }
    }
    try {
      const PolyhedronPtr made = make(mesh);
      EXPECT_GT(volume(made), 0.0);  // a solid of one nesting level encloses something
      std::set<std::array<double, 3>> different;
      for (const Vec3& p : made->vertices()) different.insert({p[0], p[1], p[2]});
      EXPECT_EQ(different.size(), made->vertices().size());
    } catch (const InvalidSolidError&) {
    }
  }
}

}  // namespace
}  // namespace starcell
