// The checker's own counting and measuring, on meshes small enough to count by hand.
#include "certificate/checker_mesh.h"

#include <gtest/gtest.h>

#include <numbers>

namespace starcell::checker {
namespace {

void add_tetrahedron(StoredMesh& mesh, const Vec3& corner, double size, bool inward = false) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(corner);
  for (int k = 0; k < 3; ++k) mesh.vertices.push_back(corner + size * Vec3::Unit(k));
  for (Triangle t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}}) {
    if (inward) std::swap(t[0], t[1]);
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

StoredMesh tetrahedron() {
  StoredMesh mesh;
  add_tetrahedron(mesh, Vec3::Zero(), 1);
  return mesh;
}

/// A ring of n by m quadrilaterals, cut in two: V - E + F = 0.
StoredMesh torus(std::uint32_t n, std::uint32_t m) {
  StoredMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m, r = 3 + std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(v));
      const std::uint32_t a = i * m + j, b = (i + 1) % n * m + j;
      const std::uint32_t c = (i + 1) % n * m + (j + 1) % m, d = i * m + (j + 1) % m;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

TEST(CheckerMesh, ATetrahedronIsASphereOfVolumeOneSixth) {
  const StoredMesh mesh = tetrahedron();
  EXPECT_EQ(manifold_defect(mesh), "");
  const Counted counted = count(mesh);
  EXPECT_EQ(counted.genus, std::vector<int>{0});
  EXPECT_EQ(counted.euler_characteristic, 2);
  EXPECT_DOUBLE_EQ(volume(mesh), 1.0 / 6);
}

TEST(CheckerMesh, ATorusHasOneHandle) {
  const StoredMesh mesh = torus(7, 5);
  EXPECT_EQ(manifold_defect(mesh), "");
  EXPECT_EQ(count(mesh).genus, std::vector<int>{1});
  EXPECT_EQ(count(mesh).euler_characteristic, 0);
  EXPECT_GT(volume(mesh), 0);
}

TEST(CheckerMesh, ComponentsComeLargestVolumeFirst) {
  StoredMesh mesh = tetrahedron();
  const StoredMesh ring = torus(7, 5);  // far larger
  for (const Triangle& t : ring.triangles) mesh.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
  for (const Vec3& p : ring.vertices) mesh.vertices.push_back(p + Vec3(10, 0, 0));
  EXPECT_EQ(count(mesh).genus, (std::vector<int>{1, 0}));
}

TEST(CheckerMesh, ACavitysVolumeIsSubtracted) {
  StoredMesh mesh;
  add_tetrahedron(mesh, Vec3::Zero(), 2);
  add_tetrahedron(mesh, Vec3::Constant(0.1), 1, true);
  EXPECT_EQ(count(mesh).genus, (std::vector<int>{0, 0}));
  EXPECT_NEAR(volume(mesh), 8.0 / 6 - 1.0 / 6, 1e-15);
}

TEST(CheckerMesh, DefectsAreNamed) {
  StoredMesh open = tetrahedron();
  open.triangles.pop_back();
  EXPECT_NE(manifold_defect(open).find("3 edges have a triangle on one side only"), std::string::npos);
  StoredMesh reversed = tetrahedron();
  std::swap(reversed.triangles[0][0], reversed.triangles[0][1]);
  EXPECT_NE(manifold_defect(reversed).find("twice in one direction"), std::string::npos);
  // Two tetrahedra that share one vertex: every edge is fine, the vertex joins two fans.
  StoredMesh pinched = tetrahedron();
  add_tetrahedron(pinched, Vec3(-1, -1, -1), 0.5);
  for (Triangle& t : pinched.triangles)
    for (std::uint32_t& v : t) v = v == 4 ? 0 : v;
  EXPECT_NE(manifold_defect(pinched).find("1 vertices join"), std::string::npos);
}

TEST(CheckerMesh, NothingIsAManifoldWithoutComponents) {
  EXPECT_EQ(manifold_defect({}), "");
  EXPECT_TRUE(count({}).genus.empty());
}

TEST(CheckerMesh, ACollarIsSteinersFormula) {
  // One side of a convex body: V(d) - V = A d + sum of l * angle / 2 d^2 + 4/3 pi d^3. A tetrahedron with three right
  // dihedral angles on edges of length 1 (exterior angle pi/2), three with cos = 1/sqrt(3) on edges of length sqrt(2).
  const double area = 1.5 + std::sqrt(3.0) / 2, d = 0.25;
  const double bending = 3 * std::numbers::pi / 2 + 3 * std::sqrt(2.0) * (std::numbers::pi - std::acos(1 / std::sqrt(3.0)));
  EXPECT_NEAR(collar(tetrahedron(), d), area * d + bending / 2 * d * d + 4.0 / 3 * std::numbers::pi * d * d * d, 1e-12);
}

}  // namespace
}  // namespace starcell::checker
