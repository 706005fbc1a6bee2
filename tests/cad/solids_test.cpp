// Which solids come out of which shapes: exact ones, cavities, Booleans, compounds, placements.
#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "cad/shape_import.h"
#include "measures.h"
#include "solids/errors.h"

namespace starcell::test {
namespace {

constexpr double pi = std::numbers::pi;

TopoDS_Shape box(double x, double y, double z) { return BRepPrimAPI_MakeBox(x, y, z).Shape(); }

TopoDS_Shape moved(const TopoDS_Shape& shape, double x, double y, double z) {
  gp_Trsf move;
  move.SetTranslation(gp_Vec(x, y, z));
  return shape.Moved(TopLoc_Location(move));
}

/// A ball of radius 1 without its poles: curved, and nothing that the import knows by name.
TopoDS_Shape barrel() { return BRepPrimAPI_MakeSphere(1, -1.0, 1.0).Shape(); }

TopoDS_Compound compound(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound all;
  BRep_Builder().MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes) BRep_Builder().Add(all, shape);
  return all;
}

double occ_volume(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

double occ_area(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties);
  return properties.Mass();
}

TEST(ExactSolid, BoxIsTwelveTriangles) {
  const Expression solid = import_shape(box(3, 4, 5), "box", 1e-6);
  const Polyhedron& mesh = leaf(solid);
  EXPECT_EQ(mesh.vertices().size(), 8u);
  EXPECT_EQ(mesh.triangles().size(), 12u);
  EXPECT_EQ(mesh.provenance().deflection, 0);
  EXPECT_EQ(mesh.provenance().name, "box");
  EXPECT_EQ(volume(mesh), 60);  // small integers: every product is exact
  std::map<std::int32_t, int> triangles_of_face;
  for (const std::int32_t face : mesh.provenance().cad_face) ++triangles_of_face[face];
  EXPECT_EQ(triangles_of_face.size(), 6u);
  for (const auto& [face, triangles] : triangles_of_face) EXPECT_EQ(triangles, 2) << "face " << face;
}

TEST(ExactSolid, RotatedBoxesWithAPocketStayExact) {
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 2, 2)), 0.7);
  const TopoDS_Shape pocket = BRepAlgoAPI_Cut(box(4, 4, 4), moved(box(2, 2, 5), 1, 1, 1)).Shape();
  const Expression solid = import_shape(pocket.Moved(TopLoc_Location(turn)), "pocket", 0.1);
  EXPECT_EQ(leaf(solid).provenance().deflection, 0);
  EXPECT_EQ(leaf(solid).vertices().size(), 16u);
  EXPECT_NEAR(volume(leaf(solid)), 64 - 12, 1e-12);
}

TEST(ExactSolid, InfiniteErrorAsksForTheTopologyOnly) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(leaf(import_shape(box(1, 1, 1), "box", infinity)).triangles().size(), 12u);
  const Expression round = import_shape(barrel(), "barrel", infinity);
  EXPECT_EQ(euler_characteristic(leaf(round)), 2);
  EXPECT_GT(leaf(round).provenance().deflection, 0);
}

TEST(CadSolid, DrilledBlockHasGenusOne) {
  const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(2, 2, -1), gp_Dir(0, 0, 1)), 1, 6).Shape();
  const TopoDS_Shape block = BRepAlgoAPI_Cut(box(4, 4, 4), drill).Shape();
  const Expression solid = import_shape(block, "block", 0.05);
  EXPECT_EQ(euler_characteristic(leaf(solid)), 0);
  const double deflection = leaf(solid).provenance().deflection;
  EXPECT_LE(std::abs(volume(leaf(solid)) - (64 - 4 * pi)), deflection * 2 * pi * 4);  // only the bore is curved
}

TEST(CadSolid, FusedAndFilleted) {
  const TopoDS_Shape fused = BRepAlgoAPI_Fuse(box(4, 4, 2), moved(BRepPrimAPI_MakeCylinder(1, 3).Shape(), 2, 2, 1)).Shape();
  BRepFilletAPI_MakeFillet fillet(fused);
  for (TopExp_Explorer edges(fused, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    GProp_GProps length;
    BRepGProp::LinearProperties(edge, length);
    if (std::abs(length.CentreOfMass().Z() - 2) < 1e-9) fillet.Add(0.3, edge);  // the rim of the plate, the boss's foot
  }
  const TopoDS_Shape shape = fillet.Shape();
  for (const double error : {0.2, 0.02}) {
    const Expression solid = import_shape(shape, "boss", error);
    const double deflection = leaf(solid).provenance().deflection;
    EXPECT_EQ(euler_characteristic(leaf(solid)), 2);
    EXPECT_LE(deflection, error / 2);
    EXPECT_LE(std::abs(volume(leaf(solid)) - occ_volume(shape)), deflection * occ_area(shape));
  }
}

TEST(CadSolid, CavityIsAnInnerShell) {
  const TopoDS_Shape hollow = BRepAlgoAPI_Cut(box(4, 4, 4), moved(BRepPrimAPI_MakeSphere(1).Shape(), 2, 2, 2)).Shape();
  const Expression solid = import_shape(hollow, "hollow", 0.05);
  EXPECT_EQ(euler_characteristic(leaf(solid)), 4);  // two spheres
  EXPECT_NEAR(volume(leaf(solid)), 64 - 4 * pi / 3, leaf(solid).provenance().deflection * 4 * pi);
}

TEST(CadSolid, CompoundIsTheUnionOfItsSolids) {
  const Expression both = import_shape(compound({box(1, 1, 1), moved(box(1, 1, 1), 1, 0, 0)}), "pair", 0.1);
  ASSERT_EQ(both.kind(), Expression::Kind::set_union);
  ASSERT_EQ(both.operands().size(), 2u);
  EXPECT_EQ(leaf(both.operands()[0]).provenance().name, "pair#1");
  EXPECT_EQ(leaf(both.operands()[1]).provenance().name, "pair#2");
  EXPECT_EQ(leaf(both.operands()[1]).bounding_box().max(), Vec3(2, 1, 1));
}

// One shape placed twice shares its triangulation: the second must not come out where the first is.
TEST(CadSolid, InstancesKeepTheirPlaces) {
  const TopoDS_Shape round = barrel();
  gp_Trsf turn;
  turn.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 1, 0)), 1);
  const Expression both = import_shape(
      compound({compound({moved(round, 5, 0, 0)}), compound({moved(round, -5, 0, 0)}).Moved(TopLoc_Location(turn))}), "two",
      0.1);
  ASSERT_EQ(both.operands().size(), 2u);
  EXPECT_NEAR(leaf(both.operands()[0]).bounding_box().center().x(), 5, 0.1);
  const gp_Pnt centre = gp_Pnt(-5, 0, 0).Transformed(turn);
  EXPECT_NEAR(leaf(both.operands()[1]).bounding_box().center().x(), centre.X(), 0.1);
  EXPECT_NEAR(leaf(both.operands()[1]).bounding_box().center().z(), centre.Z(), 0.1);
}

TEST(CadSolid, MirroredSolidsFaceOutward) {
  gp_Trsf mirror;
  mirror.SetMirror(gp_Ax2(gp_Pnt(10, 0, 0), gp_Dir(1, 0, 0)));
  const TopoDS_Shape block = BRepAlgoAPI_Cut(box(4, 4, 4), moved(BRepPrimAPI_MakeCylinder(1, 6).Shape(), 2, 2, -1)).Shape();
  const Expression copied = import_shape(BRepBuilderAPI_Transform(block, mirror).Shape(), "copied", 0.05);
  const Expression placed = import_shape(block.Moved(TopLoc_Location(mirror), Standard_False), "placed", 0.05);
  for (const Expression& solid : {copied, placed}) {
    EXPECT_NEAR(volume(leaf(solid)), 64 - 4 * pi, 0.05 * 8 * pi);  // positive: outward
    EXPECT_NEAR(leaf(solid).bounding_box().min().x(), 16, 1e-9);
  }
}

TEST(CadSolid, ReversedSolidFacesOutward) {
  EXPECT_EQ(volume(leaf(import_shape(box(1, 2, 3).Reversed(), "reversed", 0.1))), 6);
}

TEST(CadSolid, SameShapeSameBytes) {
  const TopoDS_Shape round = barrel();
  const Expression first = import_shape(round, "barrel", 0.05), second = import_shape(round, "barrel", 0.05);
  EXPECT_EQ(leaf(first).vertices(), leaf(second).vertices());
  EXPECT_EQ(leaf(first).triangles(), leaf(second).triangles());
  EXPECT_EQ(leaf(first).provenance().deflection, leaf(second).provenance().deflection);
}

TEST(CadSolid, ClosedShellIsTakenAsASolidAndSaysSo) {
  TopExp_Explorer shells(box(1, 1, 1), TopAbs_SHELL);
  const Expression solid = import_shape(shells.Current(), "shell", 0.1);
  EXPECT_EQ(leaf(solid).provenance().name, "shell (closed shell taken as a solid)");
  EXPECT_EQ(volume(leaf(solid)), 1);
}

TEST(CadSolid, LooseFacesThatShareTheirEdgesAreTakenAsASolid) {
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer walk(box(1, 1, 1), TopAbs_FACE); walk.More(); walk.Next()) faces.push_back(walk.Current());
  EXPECT_EQ(volume(leaf(import_shape(compound(faces), "faces", 0.1))), 1);
}

std::string refusal(const TopoDS_Shape& shape, double error = 0.1) {
  try {
    import_shape(shape, "shape", error);
  } catch (const InvalidSolidError& refused) {
    return refused.what();
  }
  return "accepted";
}

TEST(Refusal, OpenShellCountsItsFreeEdges) {
  TopoDS_Shell shell;
  BRep_Builder().MakeShell(shell);
  int faces = 0;
  for (TopExp_Explorer walk(box(1, 1, 1), TopAbs_FACE); walk.More() && faces < 5; walk.Next(), ++faces)
    BRep_Builder().Add(shell, walk.Current());
  EXPECT_NE(refusal(shell).find("open shell of 5 faces with 4 free edges"), std::string::npos) << refusal(shell);
  TopoDS_Solid solid;
  BRep_Builder().MakeSolid(solid);
  BRep_Builder().Add(solid, shell);
  EXPECT_NE(refusal(solid).find("4 free edges among its 5 faces"), std::string::npos) << refusal(solid);
}

TEST(Refusal, ShapesWithoutVolume) {
  TopExp_Explorer faces(box(1, 1, 1), TopAbs_FACE), edges(box(1, 1, 1), TopAbs_EDGE);
  EXPECT_NE(refusal(faces.Current()).find("1 face without a shell, with 4 free edges"), std::string::npos);
  EXPECT_NE(refusal(edges.Current()).find("contains no solid"), std::string::npos);
  EXPECT_NE(refusal(compound({})).find("contains no solid"), std::string::npos);
  EXPECT_NE(refusal(TopoDS_Shape()).find("empty shape"), std::string::npos);
}

TEST(Refusal, BoxesThatShareOnlyAnEdgeAreNoManifold) {
  const TopoDS_Shape fused = BRepAlgoAPI_Fuse(box(1, 1, 1), moved(box(1, 1, 1), 1, 1, 0)).Shape();
  TopExp_Explorer solids(fused, TopAbs_SOLID);
  int n = 0;
  for (; solids.More(); solids.Next()) ++n;
  EXPECT_EQ(n, 2) << "OpenCASCADE keeps them apart: a union of two leaves, each valid";
  EXPECT_EQ(import_shape(fused, "edge", 0.1).operands().size(), 2u);
}

TEST(Refusal, ErrorMustBePositive) {
  for (const double error : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(import_shape(box(1, 1, 1), "box", error), std::invalid_argument) << error;
}

}  // namespace
}  // namespace starcell::test
