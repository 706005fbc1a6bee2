// Files: every format gives the same solid, and damaged ones a FileError, at every length and with any byte changed.
#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <BinTools.hxx>
#include <BinTools_LocationSet.hxx>
#include <BinTools_ShapeSet.hxx>
#include <STEPControl_Writer.hxx>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "cad/cad_import.h"
#include "measures.h"
#include "solids/errors.h"

namespace starcell::test {
namespace {

/// A drilled block of volume 60 - 5 pi, placed away from the origin.
TopoDS_Shape block() {
  const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(1.5, 2, -1), gp_Dir(0, 0, 1)), 1, 7).Shape();
  gp_Trsf move;
  move.SetTranslation(gp_Vec(1, 2, 3));
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(3, 4, 5).Shape(), drill).Shape().Moved(TopLoc_Location(move));
}

std::string text_brep() {
  std::ostringstream stream;
  BRepTools::Write(block(), stream);
  return stream.str();
}

std::string binary_brep() {
  std::ostringstream stream;
  BinTools::Write(block(), stream);
  return stream.str();
}

/// As FreeCAD's Shape.exportBinary writes it.
std::string freecad_binary() {
  std::ostringstream stream;
  BinTools_ShapeSet set;
  const TopoDS_Shape shape = block();
  const int number = set.Add(shape);
  const int location = set.Locations().Index(shape.Location());
  set.Write(stream);
  BinTools::PutInteger(stream, number);
  BinTools::PutInteger(stream, location);
  BinTools::PutInteger(stream, shape.Orientation());
  return stream.str();
}

class CadFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("starcell-cad-" + std::to_string(std::random_device()()));
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream((folder_ / name), std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  std::string step() const {
    const std::string path = (folder_ / "original.step").string();
    STEPControl_Writer writer;
    writer.Transfer(block(), STEPControl_AsIs);
    writer.Write(path.c_str());
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    return bytes.str();
  }
  void expect_block(const std::string& path) const {
    const Expression solid = read_cad(path, 0.05);
    EXPECT_EQ(euler_characteristic(leaf(solid)), 0);
    EXPECT_NEAR(volume(leaf(solid)), 60 - 5 * std::numbers::pi, leaf(solid).provenance().deflection * 10 * std::numbers::pi);
    EXPECT_NEAR((leaf(solid).bounding_box().min() - Vec3(1, 2, 3)).norm(), 0, 1e-9);
    EXPECT_EQ(leaf(solid).provenance().name, "block");
  }
  /// Accepting is fine (the damage may not matter), refusing is fine; anything else is not.
  void expect_answer(const std::string& bytes) const {
    try {
      read_cad(write("damaged", bytes), 0.5);
    } catch (const Error&) {
    }
  }
  void expect_file_errors_when_cut(const std::string& bytes) const {
    for (const double part : {0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99})
      EXPECT_THROW(read_cad(write("cut", bytes.substr(0, static_cast<std::size_t>(bytes.size() * part))), 0.5), FileError)
          << part << " of the file";
  }

  std::filesystem::path folder_;
};

TEST_F(CadFile, TextBrep) { expect_block(write("block.brep", text_brep())); }
TEST_F(CadFile, BinaryBrep) { expect_block(write("block.brp", binary_brep())); }
TEST_F(CadFile, FreeCadsBinary) { expect_block(write("block.bin", freecad_binary())); }
TEST_F(CadFile, Step) { expect_block(write("block.step", step())); }

TEST_F(CadFile, CutShort) {
  expect_file_errors_when_cut(text_brep());
  expect_file_errors_when_cut(binary_brep());
  expect_file_errors_when_cut(freecad_binary());
  expect_file_errors_when_cut(step());
}

TEST_F(CadFile, ChangedBytesNeverCrash) {
  for (const std::string& original : {text_brep(), binary_brep(), freecad_binary(), step()})
    for (unsigned seed = 0; seed < 60; ++seed) {
      std::mt19937 random(seed);
      std::string bytes = original;
      bytes[random() % bytes.size()] = static_cast<char>(32 + random() % 90);
      expect_answer(bytes);
    }
}

TEST_F(CadFile, NoCadAtAll) {
  EXPECT_THROW(read_cad((folder_ / "missing.step").string(), 0.1), FileError);
  EXPECT_THROW(read_cad(folder_.string(), 0.1), FileError);
  EXPECT_THROW(read_cad(write("empty.brep", ""), 0.1), FileError);
  EXPECT_THROW(read_cad(write("mesh.off", "OFF\n0 0 0\n"), 0.1), FileError);
  EXPECT_THROW(read_cad(write("header.step", "ISO-10303-21;\n"), 0.1), FileError);
}

}  // namespace
}  // namespace starcell::test
