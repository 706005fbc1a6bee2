// Line by line, the first word of each deciding. Names of types come in two generations ("uchar" and "uint8").
#include "solids/ply_header.h"

#include <utility>

#include "solids/text_scanner.h"

namespace starcell {
namespace {

std::string_view next_word(TextScanner& text) {
  // '#' is no comment in a PLY header, but no valid header has one either: the empty word is then refused.
  return text.find_word_in_line() ? text.word() : std::string_view();
}

PlyType read_type(TextScanner& text) {
  constexpr std::pair<std::string_view, PlyType> kNames[] = {
      {"char", PlyType::kInt8},     {"int8", PlyType::kInt8},     {"uchar", PlyType::kUint8},    {"uint8", PlyType::kUint8},
      {"short", PlyType::kInt16},   {"int16", PlyType::kInt16},   {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},
      {"int", PlyType::kInt32},     {"int32", PlyType::kInt32},   {"uint", PlyType::kUint32},    {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat32}, {"float32", PlyType::kFloat32}, {"double", PlyType::kFloat64}, {"float64", PlyType::kFloat64}};
  const std::string_view word = next_word(text);
  for (const auto& [name, type] : kNames)
    if (name == word) return type;
  text.fail(quoted(word) + " is not a type of PLY files");
}

PlyProperty read_property(TextScanner& text) {
  PlyProperty property;
  TextScanner ahead = text;
  if (next_word(ahead) == "list") {
    text = ahead;
    property.is_list = true;
    property.count_type = read_type(text);
    if (property.count_type == PlyType::kFloat32 || property.count_type == PlyType::kFloat64)
      text.fail("a list's length must be a whole number");
  }
  property.type = read_type(text);
  property.name = next_word(text);
  return property;
}

PlyEncoding read_encoding(TextScanner& text) {
  const std::string_view word = next_word(text);
  if (word == "ascii") return PlyEncoding::kText;
  if (word == "binary_little_endian") return PlyEncoding::kLittleEndian;
  if (word == "binary_big_endian") return PlyEncoding::kBigEndian;
  text.fail(quoted(word) + " is not a format of PLY files");
}

}  // namespace

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  TextScanner text(bytes, name);
  if (next_word(text) != "ply") text.fail("the file does not begin with 'ply'");
  text.skip_line();
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    const std::string_view word = next_word(text);
    if (word == "end_header") break;
    if (word == "format") {
      header.encoding = read_encoding(text);
      has_format = true;
    } else if (word == "element") {
      PlyElement element;
      element.name = next_word(text);
      if (!text.find_word_in_line()) text.fail("an element has no count");
      const std::int64_t count = text.integer();
      if (count < 0) text.fail("an element's count is negative");
      element.count = static_cast<std::uint64_t>(count);
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      if (header.elements.empty()) text.fail("a property stands before any element");
      header.elements.back().properties.push_back(read_property(text));
    } else if (word != "comment" && word != "obj_info" && !(word.empty() && text.remaining() > 0)) {
      text.fail(text.remaining() == 0 ? "the file ends inside its header" : quoted(word) + " is not a word of a PLY header");
    }
    text.skip_line();
  }
  if (!has_format) text.fail("the header does not say the format");
  text.skip_line();
  header.size = text.position();
  return header;
}

}  // namespace starcell
