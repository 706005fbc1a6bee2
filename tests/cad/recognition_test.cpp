// Balls, cylinders, cones and tori come out as themselves, in their places; what only looks like one does not.
#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <cmath>
#include <numbers>
#include <random>

#include "cad/recognition.h"
#include "cad/shape_import.h"
#include "operations/boolean.h"

namespace starcell::test {
namespace {

constexpr double pi = std::numbers::pi;

Expression read(const TopoDS_Shape& shape) { return import_shape(shape, "shape", 0.1); }

/// "sphere", "cylinder", ... or "tessellated".
std::string kind_of(const TopoDS_Shape& shape) {
  const Expression solid = read(shape);
  return solid.kind() == Expression::Kind::curved ? solid.curved()->name() : "tessellated";
}

/// Volume, centre of mass and inertia about it, in closed form.
struct Moments {
  double volume = 0;
  Vec3 centre = Vec3::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// Of a solid of revolution about `axis`: moments along and across it.
Eigen::Matrix3d revolved(const Vec3& axis, double along, double across) {
  const Eigen::Matrix3d a = axis * axis.transpose();
  return along * a + across * (Eigen::Matrix3d::Identity() - a);
}

Moments frustum(const Vec3& base, const Vec3& axis, double a, double b, double h) {
  // Disks of radius r(z) = a + (b - a) z / h, summed by Gauss's formula of three points, exact for polynomials of degree 5.
  const double nodes[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)}, weights[] = {5 / 18.0, 8 / 18.0, 5 / 18.0};
  double volume = 0, first = 0, second = 0, along = 0;
  for (int i = 0; i < 3; ++i) {
    const double z = nodes[i] * h, r = a + (b - a) * nodes[i], disk = pi * r * r * h * weights[i];
    volume += disk;
    first += disk * z;
    second += disk * z * z;
    along += disk * r * r / 2;
  }
  const double z = first / volume;
  return {volume, base + z * axis, revolved(axis, along, along / 2 + second - volume * z * z)};
}

Moments moments(const CurvedSolid& solid) {
  const std::vector<double>& p = solid.parameters();
  EXPECT_TRUE(solid.maps().empty()) << "placements are in the parameters";
  const Vec3 first(p[0], p[1], p[2]);
  const Vec3 axis = p.size() > 5 ? Vec3(p[3], p[4], p[5]).normalized() : Vec3::UnitZ();
  switch (solid.kind()) {
    case CurvedSolid::Kind::sphere: {
      const double r = p[3], volume = 4 * pi * r * r * r / 3;
      return {volume, first, Eigen::Matrix3d::Identity() * (0.4 * volume * r * r)};
    }
    case CurvedSolid::Kind::cylinder: return frustum(first, axis, p[6], p[6], p[7]);
    case CurvedSolid::Kind::cone: return frustum(first, axis, p[6], p[7], p[8]);
    case CurvedSolid::Kind::torus: {
      const double r = p[6], s = p[7], volume = 2 * pi * pi * r * s * s;
      return {volume, first, revolved(axis, volume * (r * r + 0.75 * s * s), volume * (0.5 * r * r + 0.625 * s * s))};
    }
    default: break;
  }
  ADD_FAILURE() << "no moments of a " << solid.name();
  return {};
}

/// The recognised solid has OpenCASCADE's volume, centre of mass, inertia and box.
void expect_same(const TopoDS_Shape& shape, const std::string& kind) {
  const Expression solid = read(shape);
  ASSERT_EQ(solid.kind(), Expression::Kind::curved) << kind << " was tessellated";
  EXPECT_EQ(solid.curved()->name(), kind);
  const Moments ours = moments(*solid.curved());
  GProp_GProps theirs;
  BRepGProp::VolumeProperties(shape, theirs);
  const double volume = std::abs(theirs.Mass()), sign = theirs.Mass() < 0 ? -1 : 1, size = std::cbrt(volume);
  EXPECT_NEAR(ours.volume, volume, 1e-6 * volume);
  const gp_Pnt centre = theirs.CentreOfMass();
  EXPECT_LE((ours.centre - Vec3(centre.X(), centre.Y(), centre.Z())).norm(), 1e-6 * size);
  GProp_GProps about(centre);
  BRepGProp::VolumeProperties(shape, about);
  const gp_Mat inertia = about.MatrixOfInertia();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(ours.inertia(i, j), sign * inertia(i + 1, j + 1), 1e-5 * volume * size * size) << i << ", " << j;
  Bnd_Box box;
  BRepBndLib::AddOptimal(shape, box, Standard_False, Standard_False);
  const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
  EXPECT_LE((solid.bounding_box().min() - Vec3(low.X(), low.Y(), low.Z())).norm(), 1e-5 * size);
  EXPECT_LE((solid.bounding_box().max() - Vec3(high.X(), high.Y(), high.Z())).norm(), 1e-5 * size);
}

gp_Trsf random_placement(std::mt19937& random, bool similar) {
  std::uniform_real_distribution<double> unit(-1, 1);
  gp_Trsf turn, move, rest;
  turn.SetRotation(gp_Ax1(gp_Pnt(unit(random), unit(random), unit(random)), gp_Dir(unit(random), unit(random), 2)), 3 * unit(random));
  move.SetTranslation(gp_Vec(20 * unit(random), 20 * unit(random), 20 * unit(random)));
  if (similar) {
    rest.SetScale(gp_Pnt(1, 2, 3), 0.3 + std::abs(unit(random)));
    gp_Trsf mirror;
    mirror.SetMirror(gp_Ax2(gp_Pnt(1, 0, 0), gp_Dir(1, unit(random), 0.3)));
    rest.Multiply(mirror);
  }
  return move * turn * rest;
}

std::vector<std::pair<std::string, TopoDS_Shape>> primitives() {
  return {{"sphere", BRepPrimAPI_MakeSphere(3).Shape()},          {"cylinder", BRepPrimAPI_MakeCylinder(2, 7).Shape()},
          {"cylinder", BRepPrimAPI_MakeCylinder(5, 0.5).Shape()}, {"cone", BRepPrimAPI_MakeCone(2, 5, 3).Shape()},
          {"cone", BRepPrimAPI_MakeCone(5, 2, 3).Shape()},        {"cone", BRepPrimAPI_MakeCone(2, 0, 7).Shape()},
          {"cone", BRepPrimAPI_MakeCone(0, 2, 7).Shape()},        {"torus", BRepPrimAPI_MakeTorus(5, 1).Shape()}};
}

TEST(Recognition, PrimitivesWhereTheyAreMade) {
  for (const auto& [kind, shape] : primitives()) {
    SCOPED_TRACE(kind);
    expect_same(shape, kind);
  }
}

TEST(Recognition, AnyPlacement) {
  std::mt19937 random(1);
  for (int i = 0; i < 10; ++i)
    for (const auto& [kind, shape] : primitives()) {
      SCOPED_TRACE(kind);
      expect_same(shape.Moved(TopLoc_Location(random_placement(random, false))), kind);
    }
}

TEST(Recognition, MirroredAndScaled) {
  std::mt19937 random(2);
  for (const auto& [kind, shape] : primitives()) {
    SCOPED_TRACE(kind);
    const gp_Trsf map = random_placement(random, true);
    expect_same(BRepBuilderAPI_Transform(shape, map, Standard_True).Shape(), kind);
    gp_Trsf mirror;
    mirror.SetMirror(gp_Ax2(gp_Pnt(1, 0, 0), gp_Dir(1, 2, 0.3)));
    expect_same(shape.Moved(TopLoc_Location(mirror), Standard_False), kind);
  }
}

TEST(Recognition, FarFromTheOrigin) {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(1e5, -2e5, 3e5));
  for (const auto& [kind, shape] : primitives()) EXPECT_EQ(kind_of(shape.Moved(TopLoc_Location(move))), kind);
}

TEST(Recognition, InsideOutIsTakenRightSideOut) {
  for (const auto& [kind, shape] : primitives()) EXPECT_EQ(kind_of(shape.Reversed()), kind);
}

// Fusing two halves leaves every face split in two; splits do not matter.
TEST(Recognition, SplitFaces) {
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), pi);
  const TopoDS_Shape wedges[] = {BRepPrimAPI_MakeCylinder(2, 7, pi).Shape(), BRepPrimAPI_MakeCone(2, 5, 3, pi).Shape(),
                                 BRepPrimAPI_MakeSphere(3, pi).Shape(), BRepPrimAPI_MakeTorus(5, 1, pi).Shape()};
  const char* const kinds[] = {"cylinder", "cone", "sphere", "torus"};
  for (int i = 0; i < 4; ++i) {
    const TopoDS_Shape whole = BRepAlgoAPI_Fuse(wedges[i], wedges[i].Moved(TopLoc_Location(turn))).Shape();
    TopExp_Explorer solids(whole, TopAbs_SOLID);
    ASSERT_TRUE(solids.More());
    SCOPED_TRACE(kinds[i]);
    expect_same(solids.Current(), kinds[i]);
  }
}

TEST(Recognition, EachSolidOfACompound) {
  TopoDS_Compound both;
  BRep_Builder().MakeCompound(both);
  BRep_Builder().Add(both, BRepPrimAPI_MakeSphere(gp_Pnt(9, 0, 0), 3).Shape());
  BRep_Builder().Add(both, BRepPrimAPI_MakeBox(1, 1, 1).Shape());
  const Expression solid = read(both);
  ASSERT_EQ(solid.operands().size(), 2u);
  EXPECT_EQ(solid.operands()[0].kind(), Expression::Kind::curved);
  EXPECT_EQ(solid.operands()[1].kind(), Expression::Kind::polyhedron);
}

TEST(Recognition, NothingIsTessellated) {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(0.1, 0.2, 0.3));
  for (const auto& [kind, shape] : primitives()) {
    Options options;
    options.error = 0.5;
    const Result result = evaluate(read(shape.Moved(TopLoc_Location(move))), options);
    EXPECT_TRUE(result.certificate.tessellated.empty()) << kind;
    EXPECT_EQ(result.certificate.verdict, Verdict::exact) << kind;
    EXPECT_EQ(result.certificate.euler_characteristic, kind == "torus" ? 0 : 2) << kind;
  }
}

TEST(NotRecognised, PartsOfPrimitives) {
  EXPECT_EQ(kind_of(BRepPrimAPI_MakeSphere(3, 0.0, pi / 2).Shape()), "tessellated") << "half a ball";
  EXPECT_EQ(kind_of(BRepPrimAPI_MakeSphere(3, -pi / 2, pi / 2, 6.0).Shape()), "tessellated") << "a slice is missing";
  EXPECT_EQ(kind_of(BRepPrimAPI_MakeCylinder(2, 7, 6.28).Shape()), "tessellated") << "0.003 radians are missing";
  EXPECT_EQ(kind_of(BRepPrimAPI_MakeCone(2, 5, 3, 5.0).Shape()), "tessellated");
  EXPECT_EQ(kind_of(BRepPrimAPI_MakeTorus(5, 1, 3.0).Shape()), "tessellated");
  EXPECT_EQ(kind_of(BRepPrimAPI_MakeTorus(5, 1, 0.0, pi).Shape()), "tessellated") << "half the tube";
}

TEST(NotRecognised, Boxes) { EXPECT_EQ(kind_of(BRepPrimAPI_MakeBox(1, 2, 3).Shape()), "tessellated"); }

TEST(NotRecognised, ChamferedCylinder) {
  const TopoDS_Shape cylinder = BRepPrimAPI_MakeCylinder(2, 7).Shape();
  BRepFilletAPI_MakeChamfer chamfer(cylinder);
  TopTools_IndexedDataMapOfShapeListOfShape edges;
  TopExp::MapShapesAndAncestors(cylinder, TopAbs_EDGE, TopAbs_FACE, edges);
  for (int i = 1; i <= edges.Extent(); ++i)
    if (edges(i).First() != edges(i).Last()) {  // no seam
      chamfer.Add(0.01, TopoDS::Edge(edges.FindKey(i)));
      break;
    }
  EXPECT_EQ(kind_of(chamfer.Shape()), "tessellated");
}

TEST(NotRecognised, SlantedEnd) {
  gp_Trsf tilt;
  tilt.SetRotation(gp_Ax1(gp_Pnt(0, 0, 5), gp_Dir(1, 0, 0)), 1e-4);
  const TopoDS_Shape lid = BRepPrimAPI_MakeBox(gp_Pnt(-9, -9, 5), 18.0, 18.0, 9.0).Shape().Moved(TopLoc_Location(tilt));
  EXPECT_EQ(kind_of(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(2, 7).Shape(), lid).Shape()), "tessellated");
}

TEST(NotRecognised, HolesHoweverSmall) {
  const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0.5, 0.5, -9), gp_Dir(0, 0, 1)), 0.002, 18).Shape();
  EXPECT_EQ(kind_of(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(2, 7).Shape(), drill).Shape()), "tessellated");
  EXPECT_EQ(kind_of(BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(2).Shape(), drill).Shape()), "tessellated");
}

TEST(NotRecognised, Pipes) {
  const TopoDS_Shape bore = BRepPrimAPI_MakeCylinder(1, 7).Shape();
  EXPECT_EQ(kind_of(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(2, 7).Shape(), bore).Shape()), "tessellated");
}

TEST(NotRecognised, HollowBalls) {
  const TopoDS_Shape hollow = BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(2).Shape(), BRepPrimAPI_MakeSphere(1).Shape()).Shape();
  EXPECT_EQ(kind_of(hollow), "tessellated");
}

// A tube wider than its circle meets itself: no ring.
TEST(NotRecognised, SpindleTorus) {
  EXPECT_EQ(cad::recognise(TopoDS::Solid(BRepPrimAPI_MakeTorus(1, 2).Shape())), nullptr);
}

TEST(NotRecognised, FreeForms) {
  EXPECT_EQ(kind_of(BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeSphere(3).Shape()).Shape()), "tessellated");
}

TEST(NotRecognised, LooseTolerances) {
  const TopoDS_Shape cylinder = BRepPrimAPI_MakeCylinder(2, 7).Shape();
  for (TopExp_Explorer edges(cylinder, TopAbs_EDGE); edges.More(); edges.Next())
    BRep_Builder().UpdateEdge(TopoDS::Edge(edges.Current()), 1e-3);
  EXPECT_EQ(kind_of(cylinder), "tessellated") << "by its own account its faces may be 1e-3 apart";
}

}  // namespace
}  // namespace starcell::test
