// Curved solids with closed forms, tessellated: the measured deflection holds, in both directions, and the volume follows from
// it. They go to the tessellation directly, as the import would recognise them and tessellate nothing.
#include <gtest/gtest.h>

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <TopoDS.hxx>
#include <cmath>
#include <numbers>

#include "cad/solid_import.h"
#include "measures.h"

namespace starcell::test {
namespace {

constexpr double pi = std::numbers::pi;

/// A shape with what is known about it.
struct Known {
  TopoDS_Shape shape;
  double volume, area;
  std::function<double(const Vec3&)> distance;       ///< to its boundary, for points near it
  std::function<Vec3(double u, double v)> boundary;  ///< u, v in [0, 1]
  int euler = 2;
};

Known sphere(double r) {
  return {BRepPrimAPI_MakeSphere(r).Shape(), 4 * pi * r * r * r / 3, 4 * pi * r * r,
          [=](const Vec3& p) { return std::abs(p.norm() - r); },
          [=](double u, double v) {
            const double z = 2 * v - 1, s = std::sqrt(1 - z * z);
            return Vec3(r * s * std::cos(2 * pi * u), r * s * std::sin(2 * pi * u), r * z);
          }};
}

/// A cone frustum around z from radius a at 0 to radius b at h; a cylinder if they are equal.
Known frustum(const TopoDS_Shape& shape, double a, double b, double h) {
  const double slant = std::hypot(a - b, h);
  const auto distance = [=](const Vec3& p) {
    const double radius = std::hypot(p.x(), p.y());
    const double side = std::abs((radius - a) * h + (a - b) * p.z()) / slant;
    return std::min({side, std::abs(p.z()), std::abs(p.z() - h)});
  };
  const auto boundary = [=](double u, double v) {
    const double radius = a + (b - a) * v;
    return Vec3(radius * std::cos(2 * pi * u), radius * std::sin(2 * pi * u), h * v);
  };
  return {shape, pi * h * (a * a + a * b + b * b) / 3, pi * (a + b) * slant + pi * (a * a + b * b), distance, boundary};
}

Known torus(double major, double minor) {
  return {BRepPrimAPI_MakeTorus(major, minor).Shape(),
          2 * pi * pi * major * minor * minor,
          4 * pi * pi * major * minor,
          [=](const Vec3& p) { return std::abs(std::hypot(std::hypot(p.x(), p.y()) - major, p.z()) - minor); },
          [=](double u, double v) {
            const double radius = major + minor * std::cos(2 * pi * v);
            return Vec3(radius * std::cos(2 * pi * u), radius * std::sin(2 * pi * u), minor * std::sin(2 * pi * v));
          },
          0};
}

void check(const Known& known, double error) {
  const PolyhedronPtr solid = cad::import_solid({TopoDS::Solid(known.shape), "known"}, error);
  const Polyhedron& mesh = *solid;
  const double deflection = mesh.provenance().deflection;
  EXPECT_LE(deflection, error / 2) << "the budget";
  EXPECT_EQ(euler_characteristic(mesh), known.euler);
  EXPECT_LE(std::abs(volume(mesh) - known.volume), deflection * known.area) << "volume within deflection times area";
  // Rounding apart, no point of the mesh, and no point of the true boundary, may be farther than was measured.
  EXPECT_LE(largest_on(mesh, known.distance), deflection + 1e-12);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit;
  double farthest = 0;
  for (int i = 0; i < 400; ++i) {
    const double u = unit(random);
    farthest = std::max(farthest, distance_to(mesh, known.boundary(u, unit(random))));
  }
  EXPECT_LE(farthest, deflection + 1e-12);
  EXPECT_GE(farthest, deflection / 4) << "nor may the measure be idle";
}

TEST(CurvedSolid, Sphere) {
  for (const double error : {0.5, 0.05, 0.01}) check(sphere(3), error);
}

TEST(CurvedSolid, Cylinder) {
  for (const double error : {0.5, 0.01, 0.001}) check(frustum(BRepPrimAPI_MakeCylinder(2, 7).Shape(), 2, 2, 7), error);
}

TEST(CurvedSolid, ConeWithAnApex) {
  for (const double error : {0.5, 0.01}) check(frustum(BRepPrimAPI_MakeCone(2, 0, 7).Shape(), 2, 0, 7), error);
}

TEST(CurvedSolid, ConeFrustum) {
  for (const double error : {0.5, 0.01}) check(frustum(BRepPrimAPI_MakeCone(2, 5, 3).Shape(), 2, 5, 3), error);
}

TEST(CurvedSolid, Torus) {
  for (const double error : {0.5, 0.02}) check(torus(5, 1), error);
}

// The same sphere and torus without a closed form: the samples with their margin must hold, too.
TEST(CurvedSolid, FreeFormSphereAndTorus) {
  for (Known known : {sphere(3), torus(5, 1)}) {
    known.shape = BRepBuilderAPI_NurbsConvert(known.shape).Shape();
    check(known, 0.05);
  }
}

TEST(CurvedSolid, FarFromTheOrigin) {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(1e6, -2e6, 3e6));
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(3).Shape().Moved(TopLoc_Location(move));
  const PolyhedronPtr solid = cad::import_solid({TopoDS::Solid(ball), "far"}, 0.1);
  const double deflection = solid->provenance().deflection;
  const Vec3 centre(1e6, -2e6, 3e6);
  EXPECT_LE(largest_on(*solid, [&](const Vec3& p) { return std::abs((p - centre).norm() - 3); }), deflection + 1e-8);
}

}  // namespace
}  // namespace starcell::test
