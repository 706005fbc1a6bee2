// OFF (Geomview's Object File Format), text form: an optional header word, three counts, a vertex a line, a polygon a
// line. Of the variants it reads those in 3D: normals, colours and texture coordinates (the prefixes N, C, ST) follow
// the coordinates and are skipped with the rest of the line. Refuses OFF BINARY and other dimensions by name.
#include "solids/errors.h"
#include "solids/mesh_reader.h"
#include "solids/soup_builder.h"
#include "solids/text_scanner.h"

namespace starcell {
namespace {

void read_header_word(TextScanner& text) {
  if (!text.find_word()) text.fail("the file is empty");
  TextScanner ahead = text;
  std::string_view word = ahead.word();
  if (word.empty() || (word[0] >= '0' && word[0] <= '9' && word.find_first_not_of("0123456789") == std::string_view::npos)) return;
  const std::string_view whole = word;
  for (std::string_view prefix : {"ST", "C", "N"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  if (!is_word(word, "off")) {
    const bool known = word == "4OFF" || word == "nOFF" || word == "4nOFF";
    text.fail(known ? quoted(whole) + " is not in three dimensions" : quoted(whole) + " does not begin an OFF file");
  }
  text = ahead;
  if (ahead.find_word_in_line() && ahead.word() == "BINARY")
    text.fail("binary OFF is not supported, save it as text");
}

}  // namespace

TriangleSoup read_off(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // a byte order mark that some editors add
  TextScanner text(bytes, name);
  read_header_word(text);
  const std::int64_t vertices = text.integer(), polygons = text.integer();
  if (vertices < 0 || polygons < 0) text.fail("a count is negative");
  text.skip_line();  // the number of edges, which some files leave out

  SoupBuilder soup;
  soup.expect(vertices, polygons, text.remaining(), 6);
  for (std::int64_t i = 0; i < vertices; ++i) {
    const double x = text.number(), y = text.number(), z = text.number();
    soup.vertex({x, y, z});
    text.skip_line();
  }
  for (std::int64_t i = 0; i < polygons; ++i) {
    const std::int64_t corners = text.integer();
    soup.begin_polygon();
    for (std::int64_t k = 0; k < corners; ++k)
      if (const std::int64_t v = text.integer(); !soup.corner(v)) text.fail("no vertex has the number " + std::to_string(v));
    if (!soup.end_polygon()) text.fail("a polygon has fewer than three corners");
    text.skip_line();
  }
  return soup.finish(name);
}

}  // namespace starcell
