// Meshes as CAD solids: the faces, edges and vertices that a person would draw, the same volume, and nothing to complain of.
#include <gtest/gtest.h>

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "cad/mesh_to_solid.h"
#include "measures.h"
#include "operations/boolean.h"
#include "solids/box.h"
#include "solids/errors.h"

namespace starcell::test {
namespace {

constexpr double exact = 1e-9;

int count(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape all;
  TopExp::MapShapes(shape, kind, all);
  return all.Extent();
}

/// A valid shape with this many faces, edges and vertices, and the mesh's volume.
TopoDS_Shape expect_solid(const PolyhedronPtr& mesh, double tolerance, int faces, int edges, int vertices) {
  const cad::MeshSolid solid = cad::mesh_to_solid(*mesh, tolerance);
  EXPECT_TRUE(BRepCheck_Analyzer(solid.shape).IsValid());
  EXPECT_EQ(static_cast<int>(solid.faces), faces);
  EXPECT_EQ(count(solid.shape, TopAbs_FACE), faces);
  EXPECT_EQ(count(solid.shape, TopAbs_EDGE), edges);
  EXPECT_EQ(count(solid.shape, TopAbs_VERTEX), vertices);
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid.shape, properties);
  EXPECT_NEAR(properties.Mass(), volume(*mesh), 1e-6 * volume(*mesh));
  return solid.shape;
}

Expression box(const Vec3& low, const Vec3& high) { return Expression(make_box(low, high)); }

PolyhedronPtr mesh_of(const Expression& solid) {
  const Result result = evaluate(solid, {});
  return Polyhedron::make(result.vertices, result.triangles);
}

/// The boundary of the unit cubes in a grid for which `full` holds, two triangles a square.
PolyhedronPtr cubes(int nx, int ny, int nz, const std::function<bool(int, int, int)>& full) {
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  const auto inside = [&](std::array<int, 3> c) {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < nx && c[1] < ny && c[2] < nz && full(c[0], c[1], c[2]);
  };
  const auto number = [&](const std::array<int, 3>& at) {
    const auto [it, fresh] = numbers.emplace(at, static_cast<std::uint32_t>(points.size()));
    if (fresh) points.emplace_back(at[0], at[1], at[2]);
    return it->second;
  };
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z)
        for (std::size_t axis = 0; axis < 3 && inside({x, y, z}); ++axis)
          for (const int side : {0, 1}) {
            std::array<int, 3> beyond{x, y, z};
            beyond[axis] += side ? 1 : -1;
            if (inside(beyond)) continue;
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            std::array<std::uint32_t, 4> corner;
            for (int k = 0; k < 4; ++k) {
              std::array<int, 3> at{x, y, z};
              at[axis] += side;
              at[u] += k == 1 || k == 2;
              at[v] += k >= 2;
              corner[static_cast<std::size_t>(side ? k : 3 - k)] = number(at);
            }
            triangles.push_back({corner[0], corner[1], corner[2]});
            triangles.push_back({corner[0], corner[2], corner[3]});
          }
  return Polyhedron::make(points, triangles);
}

PolyhedronPtr turned(const PolyhedronPtr& mesh) {
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  map.topLeftCorner<3, 3>() = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  map.topRightCorner<3, 1>() = Vec3(10, -20, 30);
  return mesh->transformed(map);
}

/// As FreeCAD's meshes hold it.
PolyhedronPtr rounded(const PolyhedronPtr& mesh) {
  std::vector<Vec3> points = mesh->vertices();
  for (Vec3& p : points) p = p.cast<float>().cast<double>();
  return Polyhedron::make(points, mesh->triangles());
}

TEST(MeshToSolid, BoxHasSixFaces) { expect_solid(make_box({0, 0, 0}, {3, 4, 5}), exact, 6, 12, 8); }

// Four hundred squares a side, and still twelve edges: what lies straight between two faces goes.
TEST(MeshToSolid, FinelyTriangulatedBoxHasSixFaces) {
  expect_solid(cubes(20, 20, 20, [](int, int, int) { return true; }), exact, 6, 12, 8);
}

TEST(MeshToSolid, TurnedBoxKeepsItsFaces) {
  const PolyhedronPtr mesh = turned(cubes(7, 5, 3, [](int, int, int) { return true; }));
  expect_solid(mesh, 1e-9, 6, 12, 8);
  // Rounded to floats, coordinates up to 64 are wrong by up to 2e-6 each.
  expect_solid(rounded(mesh), 64 * 0x1p-22, 6, 12, 8);
}

TEST(MeshToSolid, VerticesAreTheMeshesOwn) {
  const PolyhedronPtr mesh = turned(make_box({0, 0, 0}, {3, 4, 5}));
  const TopoDS_Shape shape = expect_solid(mesh, 1e-9, 6, 12, 8);
  for (TopExp_Explorer walk(shape, TopAbs_VERTEX); walk.More(); walk.Next()) {
    const gp_Pnt p = BRep_Tool::Pnt(TopoDS::Vertex(walk.Current()));
    EXPECT_EQ(std::count(mesh->vertices().begin(), mesh->vertices().end(), Vec3(p.X(), p.Y(), p.Z())), 1);
  }
}

// A square hole right through: six sides and four walls; two of the sides have two wires.
TEST(MeshToSolid, ThroughHole) {
  const Expression part = Expression::difference(box({0, 0, 0}, {4, 4, 4}), box({1, 1, -1}, {3, 3, 5}));
  const TopoDS_Shape shape = expect_solid(mesh_of(part), exact, 10, 24, 16);
  EXPECT_EQ(count(shape, TopAbs_WIRE), 12);
  EXPECT_EQ(shape.ShapeType(), TopAbs_SOLID);
}

TEST(MeshToSolid, CavityIsAnInnerShell) {
  const Expression part = Expression::difference(box({0, 0, 0}, {4, 4, 4}), box({1, 1, 1}, {3, 3, 3}));
  const TopoDS_Shape shape = expect_solid(mesh_of(part), exact, 12, 24, 16);
  EXPECT_EQ(count(shape, TopAbs_SOLID), 1);
  EXPECT_EQ(count(shape, TopAbs_SHELL), 2);
}

// Boxes one in another, the second and the fourth hollow out the ones around them, and one more aside: three solids.
TEST(MeshToSolid, NestedComponents) {
  const auto cube = [](double a) { return box({a, a, a}, {20 - a, 20 - a, 20 - a}); };
  const auto shell = [&](double a, double b) { return Expression::difference(cube(a), cube(b)); };
  const Expression part = Expression::set_union({shell(0, 1), shell(2, 3), box({30, 0, 0}, {31, 1, 1})});
  const TopoDS_Shape shape = expect_solid(mesh_of(part), exact, 30, 60, 40);
  EXPECT_EQ(shape.ShapeType(), TopAbs_COMPOUND);
  EXPECT_EQ(count(shape, TopAbs_SOLID), 3);
  EXPECT_EQ(count(shape, TopAbs_SHELL), 5);
  for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    GProp_GProps properties;
    BRepGProp::VolumeProperties(solids.Current(), properties);
    EXPECT_GT(properties.Mass(), 0);
  }
}

// A pyramid is taken out of a cube's top so that its rim touches the top's edge in the one point (2, 0, 4).
TEST(MeshToSolid, FaceTouchesItselfInAVertex) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 4}, {4, 0, 4}, {4, 4, 4},
                                 {0, 4, 4}, {2, 0, 4}, {3, 1, 4}, {2, 2, 4}, {1, 1, 4}, {2, 1, 3}};
  const std::vector<Triangle> triangles{{8, 5, 9}, {5, 6, 9}, {6, 10, 9}, {6, 7, 10}, {7, 11, 10}, {7, 4, 11}, {4, 8, 11},
                                        {8, 9, 12}, {9, 10, 12}, {10, 11, 12}, {11, 8, 12}, {0, 1, 8}, {0, 8, 4}, {1, 5, 8},
                                        {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {0, 3, 2}, {0, 2, 1}};
  const PolyhedronPtr mesh = Polyhedron::make(points, triangles);
  EXPECT_NEAR(volume(*mesh), 64 - 2 / 3.0, 1e-12);
  expect_solid(mesh, exact, 10, 21, 13);
  expect_solid(turned(mesh), 1e-9, 10, 21, 13);
}

// Twelve faces in space have no two coplanar neighbours: nothing merges, and the tolerance moves nothing.
TEST(MeshToSolid, CurvedMeshKeepsEveryTriangle) {
  const int n = 24;  // latitudes and longitudes of a ball
  std::vector<Vec3> points{{0, 0, 1}, {0, 0, -1}};
  std::vector<Triangle> triangles;
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(2 + (i - 1) * n + j % n); };
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double latitude = M_PI * i / n, longitude = 2 * M_PI * (j + 0.3 * i) / n;
      points.emplace_back(std::sin(latitude) * std::cos(longitude), std::sin(latitude) * std::sin(longitude), std::cos(latitude));
      if (i == 1) triangles.push_back({0, at(1, j), at(1, j + 1)});
      if (i == n - 1) triangles.push_back({1, at(i, j + 1), at(i, j)});
      if (i < n - 1) {
        triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  const PolyhedronPtr mesh = Polyhedron::make(points, triangles);
  const int m = static_cast<int>(triangles.size());
  expect_solid(mesh, exact, m, 3 * m / 2, m / 2 + 2);
}

/// A plate with n x n square holes: 4 n n walls and six sides.
PolyhedronPtr perforated_plate(int n) {
  return turned(cubes(2 * n + 1, 2 * n + 1, 1, [](int x, int y, int) { return x % 2 == 0 || y % 2 == 0; }));
}

TEST(MeshToSolid, PerforatedPlate) { expect_solid(perforated_plate(12), 1e-7, 6 + 4 * 144, 12 + 12 * 144, 8 + 8 * 144); }

// OpenCASCADE's own check of a face takes a time quadratic in its wires: seconds here, and it is left out.
TEST(MeshToSolid, ManyHolesAreQuick) {
  for (const int n : {18, 41}) {
    const PolyhedronPtr mesh = perforated_plate(n);
    const auto start = std::chrono::steady_clock::now();
    const cad::MeshSolid solid = cad::mesh_to_solid(*mesh, 1e-7);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::cout << mesh->triangles().size() << " triangles to a solid of " << solid.faces << " faces: " << seconds << " s\n";
    EXPECT_EQ(solid.faces, 6u + 4u * static_cast<unsigned>(n * n));
    EXPECT_EQ(count(solid.shape, TopAbs_EDGE), 12 + 12 * n * n);
  }
}

// A cube smaller than the tolerance has no sides worth merging: it keeps its triangles.
TEST(MeshToSolid, ComponentSmallerThanTheTolerance) {
  const PolyhedronPtr large = make_box({0, 0, 0}, {1, 1, 1}), small = make_box({2, 0, 0}, {2.001, 0.001, 0.001});
  std::vector<Vec3> points = large->vertices();
  std::vector<Triangle> triangles = large->triangles();
  points.insert(points.end(), small->vertices().begin(), small->vertices().end());
  for (const Triangle& t : small->triangles()) triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  expect_solid(Polyhedron::make(points, triangles), 0.01, 6 + 12, 12 + 18, 16);
}

// Random cuts of a turned block by turned blocks, as floats: thin slivers and near-coincident planes are not rare.
TEST(MeshToSolid, RandomCutsAsFloatsAreValid) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 12; ++i) {
    Expression part = box({-10, -10, -10}, {10, 10, 10});
    for (int k = 0; k < 4; ++k) {
      Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
      map.topLeftCorner<3, 3>() = Eigen::AngleAxisd(unit(random), Vec3(unit(random), unit(random), 1).normalized()).toRotationMatrix();
      map.topRightCorner<3, 1>() = 8 * Vec3(unit(random), unit(random), unit(random));
      part = Expression::difference(part, box({-4, -4, -6}, {4, 4, 6}).transformed(map));
    }
    const PolyhedronPtr mesh = rounded(turned(mesh_of(part)));
    const cad::MeshSolid solid = cad::mesh_to_solid(*mesh, 64 * 0x1p-22);
    EXPECT_TRUE(BRepCheck_Analyzer(solid.shape).IsValid());
    EXPECT_LE(solid.faces, 6u + 6 * 4 * 3) << "each plane in few pieces";
    GProp_GProps properties;
    BRepGProp::VolumeProperties(solid.shape, properties);
    EXPECT_NEAR(properties.Mass(), volume(*mesh), 1e-5 * volume(*mesh));
  }
}

TEST(MeshToSolid, EmptyMeshIsRefused) { EXPECT_THROW(cad::mesh_to_solid(*Polyhedron::trusted({}, {}), exact), InvalidSolidError); }

}  // namespace
}  // namespace starcell::test
