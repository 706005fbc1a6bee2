// Any byte sequence gives a mesh, with its indices in range, or a FileError: valid files are cut, overwritten,
// spliced and repeated at random, a few thousand times a format. The seeds are fixed, so that a failure repeats.
#include <gtest/gtest.h>

#include "solids/mesh_bytes.h"
#include "solids/mesh_reader.h"
#include "solids/sample_meshes.h"

namespace starcell {
namespace {

using namespace sample;
using Reader = TriangleSoup (*)(std::string_view, const std::string&);

std::string mutated(std::string bytes, std::mt19937& random) {
  const auto at = [&] { return bytes.empty() ? 0 : random() % bytes.size(); };
  // Words that matter to some format; with them random edits reach further than with random bytes.
  static const std::string words[] = {"0", "-1", "4294967295", "4294967296", "99999999999999999999", "1e999", "nan", "-inf", "\\\n", "#", "\n", " ",
                                      "element vertex 1000000000000\n", "property list uchar int vertex_indices\n", "property list int float x\n", "end_header\n", "vertex", "outer loop",
                                      "endsolid", "solid", "f 1 2 3 4 5\n", "v 1 2 3\n", "OFF", "\xff\xff\xff\xff", std::string(4, '\0')};
  for (int change = 1 + random() % 4; change > 0; --change) {
    switch (random() % 6) {
      case 0: if (!bytes.empty()) bytes[at()] = static_cast<char>(random()); break;
      case 1: bytes.resize(at()); break;
      case 2: bytes.erase(at(), random() % 20); break;
      case 3: bytes.insert(at(), words[random() % std::size(words)]); break;
      case 4: bytes.insert(at(), bytes.substr(at(), random() % 100)); break;
      case 5: if (!bytes.empty()) bytes[at()] ^= static_cast<char>(1 << random() % 8); break;
    }
  }
  return bytes;
}

void fuzz(Reader reader, const std::string& valid, unsigned seed) {
  std::mt19937 random(seed);
  int read = 0, refused = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::string bytes = mutated(valid, random);
    // A copy of exactly this size on the heap, so that the sanitizer sees any byte read past the end.
    const std::vector<char> exact(bytes.begin(), bytes.end());
    try {
      const TriangleSoup soup = reader({exact.data(), exact.size()}, "fuzz");
      ++read;
      for (const Triangle& t : soup.triangles)
        for (std::uint32_t v : t) ASSERT_LT(v, soup.vertices.size());
      ASSERT_LE(soup.vertices.size(), bytes.size());  // nothing is made of nothing
      try {
        Polyhedron::make(soup.vertices, soup.triangles);
      } catch (const InvalidSolidError&) {
      }
    } catch (const FileError& error) {
      ++refused;
      ASSERT_TRUE(has(error.what(), "fuzz")) << error.what();
    }
  }
  EXPECT_GT(read, 100);     // otherwise the mutations are too coarse to test anything
  EXPECT_GT(refused, 100);  // or too fine
}

Mesh fuzz_mesh() { return torus(4, 4); }

TEST(MeshReaderFuzz, Off) { fuzz(read_off, off_bytes(fuzz_mesh()), 1); }
TEST(MeshReaderFuzz, Obj) { fuzz(read_obj, obj_bytes(fuzz_mesh()), 2); }
TEST(MeshReaderFuzz, StlText) { fuzz(read_stl, stl_text(fuzz_mesh()), 3); }
TEST(MeshReaderFuzz, StlBinary) { fuzz(read_stl, stl_binary(fuzz_mesh(), "fuzz"), 4); }
TEST(MeshReaderFuzz, PlyText) { fuzz(read_ply, ply_bytes(fuzz_mesh(), PlyEncoding::kText), 5); }
TEST(MeshReaderFuzz, PlyLittleEndian) { fuzz(read_ply, ply_bytes(fuzz_mesh(), PlyEncoding::kLittleEndian), 6); }
TEST(MeshReaderFuzz, PlyBigEndian) { fuzz(read_ply, ply_bytes(fuzz_mesh(), PlyEncoding::kBigEndian), 7); }

TEST(MeshReaderFuzz, RandomBytes) {
  std::mt19937 random(8);
  for (int round = 0; round < 2000; ++round) {
    std::string bytes(random() % 300, '\0');
    for (char& c : bytes) c = static_cast<char>(random() % 4 ? "0123456789 .-\nvfOFplysolid"[random() % 26] : random());
    for (Reader reader : {read_off, read_obj, read_stl, read_ply}) {
      try {
        reader(bytes, "fuzz");
      } catch (const FileError&) {
      }
    }
  }
}

}  // namespace
}  // namespace starcell
