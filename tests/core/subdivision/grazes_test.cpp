// Where operands touch without a common plane.
#include "subdivision/grazes.h"

#include <gtest/gtest.h>

#include "operations/results.h"

namespace starcell {
namespace {

using namespace sample;

std::size_t grazes(const Mesh& a, const Mesh& b) { return gather_facets({make(a), make(b)}, 1e-9).grazes.size(); }

// A turned cube, moved so that the middle of an edge of its lies on the middle of an edge of the unit cube.
TEST(Grazes, AnEdgeAcrossAnEdgeIsFound) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const Mesh cube = box({0, 0, 0}, {1, 1, 1});
    Mesh other = turned(cube, random_rotation(random));
    const Vec3 p(0.4, 1, 1), q = 0.45 * other.vertices[cube.triangles[0][0]] + 0.55 * other.vertices[cube.triangles[0][1]];
    Mesh apart = other;
    for (Vec3& v : other.vertices) v += p - q;
    for (Vec3& v : apart.vertices) v += p - q + Vec3(1e-6, 2e-6, 3e-6);
    const bool diagonal = std::abs((cube.vertices[cube.triangles[0][0]] - cube.vertices[cube.triangles[0][1]]).norm() - 1) > 1e-9;
    EXPECT_EQ(grazes(cube, other) > 0, !diagonal) << "a diagonal is no edge: its facets are coplanar";
    EXPECT_EQ(grazes(cube, apart), 0u);
  }
}

TEST(Grazes, AVertexOnAForeignFacetIsFoundButNotBesideIt) {
  Mesh tip = box({0, 0, 0}, {1, 1, 1});
  std::mt19937 random(4);
  tip = turned(tip, random_rotation(random));
  Vec3 lowest = tip.vertices[0];
  for (const Vec3& v : tip.vertices)
    if (v.z() < lowest.z()) lowest = v;
  Mesh on = tip, beside = tip;
  for (Vec3& v : on.vertices) v += Vec3(0.3, 0.4, 1) - lowest;
  for (Vec3& v : beside.vertices) v += Vec3(1.5, 0.4, 1) - lowest;   // in the facet's plane, but not on it
  EXPECT_GT(grazes(box({0, 0, 0}, {1, 1, 1}), on), 0u);
  EXPECT_EQ(grazes(box({0, 0, 0}, {1, 1, 1}), beside), 0u);
}

TEST(Grazes, SharedPlanesAreNoGrazes) { EXPECT_EQ(grazes(box({0, 0, 0}, {1, 1, 1}), box({0.2, 0.3, 1}, {0.7, 0.8, 2})), 0u); }

// Moved apart, operands do not graze, and what they share they go on sharing.
TEST(Grazes, ShiftsKeepSharedPlanes) {
  Mesh tip = box({0, 0, 0}, {1, 1, 1});
  const Mesh base = box({0, 0, 0}, {1, 1, 1});
  // Turned about z it keeps z = 1 in common with nothing but its bottom; an edge of it then lies in the side x = 1.
  tip = turned(tip, Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix());
  Vec3 leftmost = tip.vertices[0];
  for (const Vec3& v : tip.vertices)
    if (v.x() < leftmost.x()) leftmost = v;
  for (Vec3& v : tip.vertices) v += Vec3(1 - leftmost.x(), 0.5 - leftmost.y(), 0);
  const std::vector<PolyhedronPtr> solids{make(base), make(tip)};
  const FacetTable table = gather_facets(solids, 1e-9);
  ASSERT_FALSE(table.grazes.empty());
  const std::vector<Vec3> shifts = shifts_off_grazes(table, table.grazes, 1e-4);
  EXPECT_GT(shifts[1].norm(), 1e-5);
  EXPECT_EQ(shifts[1].z(), 0) << "z = 0 and z = 1 are shared";
  EXPECT_TRUE(gather_facets(solids, 1e-9, shifts).grazes.empty());
}

}  // namespace
}  // namespace starcell
