// OBJ (Wavefront): the statements v and f; every other statement is skipped. Indices count from 1, negative ones back
// from the last vertex; texture and normal indices are skipped; a backslash joins lines.
#include "solids/mesh_reader.h"
#include "solids/soup_builder.h"
#include "solids/text_scanner.h"

namespace starcell {
namespace {

void read_face(TextScanner& text, SoupBuilder& soup) {
  soup.begin_polygon();
  while (text.find_word_in_line()) {
    std::string_view word = text.word();
    const std::int64_t index = text.leading_integer(word);
    if (!word.empty() && word[0] != '/') text.fail(quoted(word) + " should not follow a vertex index");
    const auto count = static_cast<std::int64_t>(soup.vertex_count());
    if (index == 0 || index < -count) text.fail("no vertex has the index " + std::to_string(index));
    // An index may run ahead of the vertices; the range is checked at the end of the file.
    if (!soup.corner(index > 0 ? index - 1 : count + index)) text.fail("no vertex has the index " + std::to_string(index));
  }
  if (!soup.end_polygon()) text.fail("a face has fewer than three corners");
}

}  // namespace

TriangleSoup read_obj(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // a byte order mark that some editors add
  TextScanner text(bytes, name);
  text.join_lines();
  SoupBuilder soup;
  while (text.find_word()) {
    const std::string_view statement = text.word();
    if (statement == "v") {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        if (!text.find_word_in_line()) text.fail("a vertex has fewer than three coordinates");
        p[axis] = text.number();
      }
      soup.vertex(p);
    } else if (statement == "f" || statement == "fo") {
      read_face(text, soup);
    }
    text.skip_line();
  }
  return soup.finish(name);
}

}  // namespace starcell
