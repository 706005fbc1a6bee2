// Normals point outward, and nested shells alternate, however the mesh was given.
#include <gtest/gtest.h>

#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;

Mesh cube_of_side(double side) { return box(Vec3::Constant(-side / 2), Vec3::Constant(side / 2)); }

TEST(Orientation, AnInvertedCubeIsTurned) {
  const PolyhedronPtr made = make(flipped(box({0, 0, 0}, {1, 1, 1})));
  EXPECT_DOUBLE_EQ(volume(made), 1.0);
  EXPECT_EQ(made->triangles(), box({0, 0, 0}, {1, 1, 1}).triangles);  // first corner kept, the others swapped back
}

TEST(Orientation, FacetsTurnedAtRandomAreMadeConsistent) {
  std::mt19937 random(3);
  const Mesh whole = torus(12, 9);
  for (int round = 0; round < 20; ++round) {
    Mesh mesh = whole;
    for (Triangle& t : mesh.triangles)
      if (random() % 2) std::swap(t[1], t[2]);
    EXPECT_EQ(make(mesh)->triangles(), whole.triangles);
  }
}

TEST(Orientation, AShellInsideAnotherIsACavity) {
  // 3^3 - 1^3 = 26, whichever way the two shells were given.
  for (int given = 0; given < 4; ++given) {
    const Mesh outer = cube_of_side(3), inner = cube_of_side(1);
    EXPECT_NEAR(volume(make(joined({given & 1 ? flipped(outer) : outer, given & 2 ? flipped(inner) : inner}))), 26.0, 1e-12);
    EXPECT_NEAR(volume(make(joined({given & 2 ? flipped(inner) : inner, given & 1 ? flipped(outer) : outer}))), 26.0, 1e-12);
  }
}

TEST(Orientation, FiveNestedShellsAlternate) {
  // 9^3 - 7^3 + 5^3 - 3^3 + 1^3 = 729 - 343 + 125 - 27 + 1 = 485
  const Mesh nested = joined({cube_of_side(5), cube_of_side(9), flipped(cube_of_side(1)), cube_of_side(3), cube_of_side(7)});
  EXPECT_NEAR(volume(make(nested)), 485.0, 1e-10);
}

TEST(Orientation, ShellsBesideOneAnotherAreAllOutward) {
  const Mesh cube = box({0, 0, 0}, {1, 1, 1});
  // Stacked along z with gaps: the upward ray from the lowest passes through both others, twice each.
  EXPECT_NEAR(volume(make(joined({cube, flipped(moved(cube, {0, 0, 2})), moved(cube, {0, 0, 4})}))), 3.0, 1e-12);
}

TEST(Orientation, ARayThroughEdgesAndVerticesIsCountedOnce) {
  // The point of the inner shell lies exactly below vertices, edges and diagonals of the outer ones.
  const Mesh octahedron = star_shape(0, [](const Vec3&) { return 4.0; });
  const Mesh inner = moved(tetrahedron(), {0, 0, 0});  // its first vertex (0,0,0) is straight below the apex (0,0,4)
  EXPECT_LT(volume(make(joined({inner, octahedron}))), volume(octahedron.vertices, octahedron.triangles));
  for (const Vec3& at : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1.5, 0), Vec3(1, 1, 0), Vec3(-1, -1, 0)}) {
    // Straight below an edge of the octahedron, or inside a facet.
    const Mesh small = moved(star_shape(0, [](const Vec3&) { return 0.25; }), at);
    EXPECT_NEAR(volume(make(joined({small, octahedron}))), volume(octahedron.vertices, octahedron.triangles) - 0.25 * 0.25 * 0.25 * 4 / 3, 1e-9);
  }
}

TEST(Orientation, CubesInAGridInsideABox) {
  // All vertices share coordinates, so that every vertical ray runs through vertices and edges of the others.
  Mesh all = box({-1, -1, -1}, {20, 20, 20});
  for (int i = 0; i < 64; ++i) {
    const Vec3 at(2 * (i % 4), 2 * (i / 4 % 4), 2 * (i / 16));
    all = joined({i % 3 ? box(at, at + Vec3::Ones()) : flipped(box(at, at + Vec3::Ones())), all});
  }
  EXPECT_NEAR(volume(make(all)), 21.0 * 21 * 21 - 64, 1e-9);
}

TEST(Orientation, TheSignOfATinyVolumeIsExact) {
  // A tetrahedron of height 2^-52 far from the origin: its volume is lost in floating-point sums over absolute coordinates.
  const double h = std::nextafter(1.0, 2.0);
  const Mesh thin = {{{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1.25, 1.25, h}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  EXPECT_EQ(make(thin)->triangles(), thin.triangles);
  EXPECT_EQ(make(flipped(thin))->triangles(), thin.triangles);
}

}  // namespace
}  // namespace starcell
