#include "contouring/flat_regions.h"

#include <gtest/gtest.h>

#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;

/// A box whose sides are cut into 4^level times two triangles; triangles know which of the six sides carries them.
SurfaceMesh fine_box(int level) {
  Mesh m = box({0, 0, 0}, {3, 2, 1});
  std::vector<std::uint32_t> side;
  for (std::uint32_t t = 0; t < 12; ++t) side.push_back(t / 2);
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, m.vertices.size());
      if (is_new) m.vertices.push_back((m.vertices[a] + m.vertices[b]) / 2);
      return found->second;
    };
    std::vector<Triangle> finer;
    std::vector<std::uint32_t> finer_side;
    for (std::size_t k = 0; k < m.triangles.size(); ++k) {
      const auto [a, b, c] = m.triangles[k];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
        finer.push_back(t);
        finer_side.push_back(side[k]);
      }
    }
    m.triangles = finer, side = finer_side;
  }
  return {m.vertices, m.triangles, side};
}

// Six flat sides, eight corners: twelve triangles whatever the mesh was before.
TEST(FlatRegions, AFinelyMeshedBoxBecomesTwelveTriangles) {
  SurfaceMesh mesh = fine_box(3);
  merge_flat_regions(mesh, 1e-12);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_NEAR(volume(mesh.vertices, mesh.triangles), 6, 1e-12);
  EXPECT_EQ(refusal({mesh.vertices, mesh.triangles}), "");
}

// Triangles that lie on no known plane are nobody's region.
TEST(FlatRegions, WhatIsNotKnownToBeFlatStays) {
  SurfaceMesh mesh = fine_box(1);
  mesh.surface.assign(mesh.triangles.size(), no_surface);
  const auto before = mesh.triangles.size();
  merge_flat_regions(mesh, 1e-12);
  EXPECT_EQ(mesh.triangles.size(), before);
}

// With a triangle missing there is nothing to promise: neither is it merged nor called embedded.
TEST(FlatRegions, AnOpenMeshStaysAsItIs) {
  SurfaceMesh mesh = fine_box(1);
  mesh.triangles.pop_back(), mesh.surface.pop_back();
  const std::vector<Triangle> before = mesh.triangles;
  EXPECT_FALSE(merge_flat_regions(mesh, 1e-12).embedded);
  EXPECT_EQ(mesh.triangles, before);
}

// A convex mesh without two coplanar neighbours: nothing to merge.
TEST(FlatRegions, ACurvedMeshIsLeftAlone) {
  const Mesh ball = sphere(2);
  SurfaceMesh mesh{ball.vertices, ball.triangles, {}};
  for (std::uint32_t t = 0; t < ball.triangles.size(); ++t) mesh.surface.push_back(t);
  merge_flat_regions(mesh, 1e-12);
  EXPECT_EQ(mesh.triangles.size(), ball.triangles.size());
  EXPECT_NEAR(volume(mesh.vertices, mesh.triangles), volume(ball.vertices, ball.triangles), 1e-12);
}

}  // namespace
}  // namespace starcell
