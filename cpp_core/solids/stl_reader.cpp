// STL, binary and text. A file is binary if its length is what its triangle count asks for (84 + 50 n bytes), because
// many binary files begin with "solid", as text does; one that does not begin so may have more bytes, which are ignored.
// Normals and attributes are skipped; every triangle brings its own three vertices, which Polyhedron::make welds.
#include <algorithm>
#include <bit>

#include "solids/errors.h"
#include "solids/mesh_reader.h"
#include "solids/soup_builder.h"
#include "solids/text_scanner.h"

namespace starcell {
namespace {

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

TriangleSoup read_binary(std::string_view bytes, std::uint32_t count) {
  TriangleSoup soup;
  soup.vertices.resize(3 * std::size_t(count));
  soup.triangles.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const char* corner = bytes.data() + 84 + 50 * std::size_t(t) + 12;
    for (std::uint32_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis, corner += 4)
        soup.vertices[3 * std::size_t(t) + k][axis] = std::bit_cast<float>(little_endian(corner));
      soup.triangles[t][k] = 3 * t + k;
    }
  }
  return soup;
}

TriangleSoup read_text(std::string_view bytes, const std::string& name) {
  TextScanner text(bytes, name);
  SoupBuilder soup;
  bool in_solid = false, in_loop = false;
  while (text.find_word()) {
    const std::string_view word = text.word();
    if (is_word(word, "vertex")) {
      if (!in_loop) text.fail("a vertex stands outside a loop");
      const double x = text.number(), y = text.number(), z = text.number();
      if (!soup.corner(static_cast<std::int64_t>(soup.vertex_count()))) text.fail("there are too many vertices");
      soup.vertex({x, y, z});
    } else if (is_word(word, "normal")) {
      for (int i = 0; i < 3 && text.find_word_in_line(); ++i) text.word();  // often no numbers at all, such as -1.#IND
    } else if (is_word(word, "outer")) {
      if (in_loop) text.fail("a loop begins inside a loop");
      in_loop = true;
      soup.begin_polygon();
    } else if (is_word(word, "endloop")) {
      if (!in_loop || !soup.end_polygon()) text.fail("a loop has fewer than three vertices");
      in_loop = false;
    } else if (is_word(word, "solid") || is_word(word, "endsolid")) {
      in_solid = is_word(word, "solid");
      text.skip_line();  // its name
    } else if (!is_word(word, "facet") && !is_word(word, "loop") && !is_word(word, "endfacet")) {
      text.fail(quoted(word) + " is not a word of an STL file");
    }
  }
  if (in_loop || in_solid) text.fail("the file ends before its solid does");
  return soup.finish(name);
}

}  // namespace

TriangleSoup read_stl(std::string_view bytes, const std::string& name) {
  std::string_view start = bytes.substr(0, 200);
  start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
  const bool text = is_word(start.substr(0, 5), "solid");
  if (bytes.size() >= 84) {
    const std::uint32_t count = little_endian(bytes.data() + 80);
    const std::uint64_t length = 84 + 50 * std::uint64_t(count);
    if (length == bytes.size() || (length < bytes.size() && count > 0 && !text)) {
      if (count > 0xffffffffu / 3) throw FileError(name + ": there are too many triangles.");
      return read_binary(bytes, count);
    }
    if (!text)
      throw FileError(name + ", byte 80: a binary STL file of " + std::to_string(count) + " triangles has " + std::to_string(length) +
                      " bytes, but this one has " + std::to_string(bytes.size()) + "; it is truncated or no STL file.");
  }
  if (!text) throw FileError(name + ", byte 0: the file is neither a text nor a binary STL file.");
  return read_text(bytes, name);
}

}  // namespace starcell
