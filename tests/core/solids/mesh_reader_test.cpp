// The four formats, from bytes written here; what is not a mesh is refused with the place.
#include "solids/mesh_reader.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "solids/mesh_bytes.h"
#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;
using Reader = TriangleSoup (*)(std::string_view, const std::string&);

void expect_same(const TriangleSoup& read, const Mesh& written) {
  EXPECT_EQ(read.vertices, written.vertices);
  EXPECT_EQ(read.triangles, written.triangles);
}

std::string complaint(Reader reader, const std::string& bytes) {
  try {
    reader(bytes, "part.x");
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

#define EXPECT_COMPLAINT(reader, bytes, ...)                                                \
  do {                                                                                      \
    const std::string message = complaint(reader, bytes);                                   \
    EXPECT_TRUE(has(message, "part.x")) << message;                                         \
    for (const char* part : {__VA_ARGS__}) EXPECT_TRUE(has(message, part)) << part << " in: " << message; \
  } while (false)

// Coordinates that do not come out right unless digits are parsed exactly.
Mesh awkward_mesh() {
  Mesh mesh = torus(7, 5);
  mesh.vertices[0] = {0.1, -1e-7, 123456789.123456789};
  mesh.vertices[1] = {-0.0, 5e-324, 1.7976931348623157e308};
  return mesh;
}

TEST(OffReader, ReadsWhatWasWritten) { expect_same(read_off(off_bytes(awkward_mesh()), "x"), awkward_mesh()); }

TEST(OffReader, TakesCommentsCountsOnTheFirstLineAndColours) {
  const Mesh expected = tetrahedron();
  const std::string vertices = "0 0 0\n1 0 0 # here\n\n  0\t1 0\r\n+0 -0. 1.0e0\n", faces = "3 0 2 1\n3 0 1 3 255 0 0\n# no face\n3 1 2 3 0.5 0.5 0.5 1\n3 0 3 2";
  for (const char* header : {"OFF\n4 4 6\n", "OFF 4 4 6\n", "# made by hand\nOFF\n# counts\n4 4 0\n", "4 4 6\n", "OFF\r\n4 4\r\n", "off\n4 4 6\n", "\xEF\xBB\xBFOFF\n4 4 6\n"})
    expect_same(read_off(header + vertices + faces, "x"), expected);
  expect_same(read_off("COFF\n4 4 6\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n0 1 0 0 0 0 0\n0 0 1 9 9 9 9\n" + faces, "x"), expected);
  expect_same(read_off("NOFF\n4 4 6\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n" + faces, "x"), expected);
  expect_same(read_off("STCNOFF\n4 4 6\n" + vertices + faces, "x"), expected);
}

TEST(OffReader, FansPolygons) {
  const TriangleSoup soup = read_off("OFF\n5 1 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n", "x");
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(OffReader, NamesWhatIsWrong) {
  EXPECT_COMPLAINT(read_off, "", "empty");
  EXPECT_COMPLAINT(read_off, "ply\n", "line 1", "'ply'");
  EXPECT_COMPLAINT(read_off, "4OFF\n1 1 1\n", "three dimensions");
  EXPECT_COMPLAINT(read_off, "OFF BINARY\n", "binary");
  EXPECT_COMPLAINT(read_off, "OFF\n3 1 0\n0 0 0\n1 0\nx 1 0\n", "line 5", "'x' is not a number");
  EXPECT_COMPLAINT(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "ends");
  EXPECT_COMPLAINT(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "vertex 3", "only 3 vertices");
  EXPECT_COMPLAINT(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 6", "-1");
  EXPECT_COMPLAINT(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "line 6", "three corners");
  EXPECT_COMPLAINT(read_off, "OFF\n-3 1 0\n", "negative");
  EXPECT_COMPLAINT(read_off, "OFF\n3 1 0\n0 0 1e999\n", "line 3", "range");
}

TEST(OffReader, DoesNotBelieveLyingCounts) {
  // 2^62 vertices would be 10^20 bytes; only the reader's own bytes may be asked for.
  EXPECT_COMPLAINT(read_off, "OFF\n4611686018427387904 4611686018427387904 0\n0 0 0\n", "ends");
  EXPECT_COMPLAINT(read_off, "OFF\n1 1 0\n0 0 0\n4611686018427387904 0 0 0\n", "whole number");
}

TEST(ObjReader, ReadsWhatWasWritten) { expect_same(read_obj(obj_bytes(awkward_mesh()), "x"), awkward_mesh()); }

TEST(ObjReader, TakesEveryKindOfIndex) {
  const std::string vertices = "mtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\nv 0 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\nv 0 0 1\ns off\n";
  for (const char* faces : {"f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n", "f 1/1 3/1 2/1\nf 1//1 2//1 4//1\nf 2/1/1 3/1/1 4/1/1\nf 1 4 3",
                            "f -4 -2 -3\nf -4 -3 -1 # comment\nf -3/-1 -2/-1 -1/-1\nf 1 -1 -2", "f 1 \\\n3 2\nf 1 2 \\\r\n 4\nf 2\\\n 3 4\nf 1 4 3\\\n"})
    expect_same(read_obj(vertices + faces, "x"), tetrahedron());
}

TEST(ObjReader, AnIndexCountsFromItsOwnPlaceInTheFile) {
  const TriangleSoup soup = read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n", "x");
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
}

TEST(ObjReader, NamesWhatIsWrong) {
  EXPECT_COMPLAINT(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "line 4", "three corners");
  EXPECT_COMPLAINT(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "line 4", "index 0");
  EXPECT_COMPLAINT(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "line 4", "index -4");
  EXPECT_COMPLAINT(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "vertex 3", "only 3");
  EXPECT_COMPLAINT(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n", "line 4");
  EXPECT_COMPLAINT(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4294967296\n", "line 4");
  EXPECT_COMPLAINT(read_obj, "v 0 0\nv 1 0 0\n", "line 1", "three coordinates");
  EXPECT_COMPLAINT(read_obj, "v 0 0 zero\n", "line 1", "'zero'");
  EXPECT_COMPLAINT(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3x\n", "line 4", "'x'");
}

// STL holds floats: a mesh whose coordinates are floats comes back exactly.
Mesh float_mesh() {
  Mesh mesh = torus(7, 5);
  for (Vec3& p : mesh.vertices) p = (1024 * p).array().round() / 1024;
  return mesh;
}

TEST(StlReader, ReadsWhatWasWritten) {
  for (const std::string& bytes : {stl_text(float_mesh()), stl_binary(float_mesh(), "made by a test"), stl_binary(float_mesh(), "solid of an exporter that says so")}) {
    const TriangleSoup soup = read_stl(bytes, "x");
    ASSERT_EQ(soup.triangles.size(), 70u);
    EXPECT_EQ(soup.vertices.size(), 210u);  // three a triangle; welding is Polyhedron::make's
    for (std::size_t t = 0; t < 70; ++t)
      for (int k = 0; k < 3; ++k) EXPECT_EQ(soup.vertices[soup.triangles[t][k]], float_mesh().vertices[float_mesh().triangles[t][k]]);
    EXPECT_EQ(Polyhedron::make(soup.vertices, soup.triangles)->vertices().size(), 35u);
  }
}

TEST(StlReader, TakesWhatExportersWrite) {
  EXPECT_EQ(read_stl("SOLID a # b\nFACET NORMAL -1.#IND nan 0\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID a\n", "x").triangles.size(), 1u);
  EXPECT_EQ(read_stl("  solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\nendsolid\nsolid two\nendsolid two\n", "x").triangles.size(), 1u);
  EXPECT_EQ(read_stl("solid\nendsolid\n", "x").triangles.size(), 0u);
  EXPECT_EQ(read_stl(stl_binary(float_mesh(), "padded") + std::string(100, '\0'), "x").triangles.size(), 70u);
}

TEST(StlReader, NamesWhatIsWrong) {
  EXPECT_COMPLAINT(read_stl, "", "neither");
  EXPECT_COMPLAINT(read_stl, std::string(84, '\0') + "x", "0 triangles has 84 bytes, but this one has 85");
  EXPECT_COMPLAINT(read_stl, stl_binary(float_mesh(), "cut").substr(0, 1000), "70 triangles", "truncated");
  EXPECT_COMPLAINT(read_stl, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n", "line 6", "three vertices");
  EXPECT_COMPLAINT(read_stl, "solid\nvertex 0 0 0\nendsolid\n", "line 2", "loop");
  EXPECT_COMPLAINT(read_stl, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "ends");
  EXPECT_COMPLAINT(read_stl, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0,5 0\n", "line 4", "'0,5' is not a number");
}

TEST(PlyReader, ReadsWhatWasWritten) {
  for (PlyEncoding encoding : {PlyEncoding::kText, PlyEncoding::kLittleEndian, PlyEncoding::kBigEndian})
    expect_same(read_ply(ply_bytes(awkward_mesh(), encoding), "x"), awkward_mesh());
}

TEST(PlyReader, StepsOverOtherPropertiesAndElements) {
  expect_same(read_ply("ply\r\nformat ascii 1.0\r\ncomment a face # b\r\nobj_info none\r\nelement camera 1\r\nproperty list uchar float view\r\nproperty int id\r\n"
                       "element vertex 4\r\nproperty uchar red\r\nproperty float z\r\nproperty list int short tags\r\nproperty double x\r\nproperty int8 y\r\n"
                       "element nothing 99999999999999\r\nelement face 4\r\nproperty float quality\r\nproperty list uint8 uint vertex_index\r\nproperty uchar flag\r\nend_header\r\n"
                       "2 0.5 0.5 7\r\n255 0 0 0 0\r\n255 0 2 1 2 1 0\r\n0 0 1 -3 0 1\r\n0 1 0 0 0\r\n"
                       "0.5 3 0 2 1 0\r\n0.5 3 0 1 3 0\r\n0.5 3 1 2 3 1\r\n0.5 3 0 3 2 1\r\n", "x"),
              tetrahedron());
}

TEST(PlyReader, NamesWhatIsWrong) {
  const std::string vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n", face = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string data = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_COMPLAINT(read_ply, "", "line 1", "'ply'");
  EXPECT_COMPLAINT(read_ply, "ply\nformat ascii 1.0\n" + vertex, "ends inside its header");
  EXPECT_COMPLAINT(read_ply, "ply\nformat html 1.0\n", "line 2", "'html'");
  EXPECT_COMPLAINT(read_ply, "ply\n" + vertex + face + "end_header\n" + data + "3 0 1 2\n", "format");
  EXPECT_COMPLAINT(read_ply, "ply\nformat ascii 1.0\nproperty float x\n", "line 3", "before any element");
  EXPECT_COMPLAINT(read_ply, "ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\n", "line 4", "'quad'");
  EXPECT_COMPLAINT(read_ply, "ply\nformat ascii 1.0\n" + vertex + "end_header\n" + data, "'vertex' and 'face'");
  EXPECT_COMPLAINT(read_ply, "ply\nformat ascii 1.0\n" + vertex + face + "end_header\n" + data + "3 0 1 3\n", "vertex 3");
  EXPECT_COMPLAINT(read_ply, "ply\nformat ascii 1.0\n" + vertex + face + "end_header\n" + data + "3 0 1 -2\n", "line 13", "-2");
  EXPECT_COMPLAINT(read_ply, "ply\nformat ascii 1.0\n" + vertex + face + "end_header\n" + data + "2 0 1\n", "three corners");
  EXPECT_COMPLAINT(read_ply, "ply\nformat ascii 1.0\nelement vertex 1000000000000\nproperty float x\nproperty float y\nproperty float z\n" + face + "end_header\n" + data, "more than the file can hold");
  EXPECT_COMPLAINT(read_ply, "ply\nformat ascii 1.0\n" + vertex + face + "end_header\n" + data + "2000000000 0 1 2\n", "does not fit");
  const std::string whole = ply_bytes(tetrahedron(), PlyEncoding::kLittleEndian);
  EXPECT_COMPLAINT(read_ply, whole.substr(0, whole.size() - 1), "byte");
}

TEST(MeshReader, ChoosesTheFormatByTheExtension) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "starcell mesh reader";
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return (folder / name).string();
  };
  const Mesh mesh = float_mesh();
  expect_same(read_mesh(write("a.OFF", off_bytes(mesh))), mesh);
  expect_same(read_mesh(write("b c.obj", obj_bytes(mesh))), mesh);
  expect_same(read_mesh(write("d.Ply", ply_bytes(mesh, PlyEncoding::kBigEndian))), mesh);
  EXPECT_EQ(read_mesh(write("e.stl", stl_text(mesh))).triangles.size(), mesh.triangles.size());
  EXPECT_THROW(read_mesh(write("f.xyz", off_bytes(mesh))), FileError);
  EXPECT_THROW(read_mesh(write("g.off.gz", off_bytes(mesh))), FileError);
  EXPECT_THROW(read_mesh((folder / "missing.off").string()), FileError);
  std::filesystem::create_directories(folder / "folder.off");
  EXPECT_THROW(read_mesh((folder / "folder.off").string()), FileError);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace starcell
