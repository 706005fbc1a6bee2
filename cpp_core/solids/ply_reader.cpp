// PLY (Stanford), text and binary of either byte order. Takes x, y, z of the element "vertex" and the list
// vertex_indices (or vertex_index) of "face"; every other property and element is stepped over.
#include <bit>

#include "solids/errors.h"
#include "solids/mesh_reader.h"
#include "solids/ply_header.h"
#include "solids/soup_builder.h"
#include "solids/text_scanner.h"

namespace starcell {
namespace {

// A source of values reads one scalar of a given type, as a number or as an integer. Two models: text and binary.
class TextValues {
 public:
  TextValues(std::string_view bytes, const std::string& name, std::size_t start) : text_(bytes, name, start) {}
  double number(PlyType) { return text_.number(); }
  std::int64_t integer(PlyType) { return text_.integer(); }
  std::size_t remaining() const { return text_.remaining(); }
  static std::size_t least_size(PlyType) { return 1; }  // a digit
  [[noreturn]] void fail(const std::string& reason) const { text_.fail(reason); }

 private:
  TextScanner text_;
};

class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, const std::string& name, std::size_t start, bool big_endian)
      : bytes_(bytes), name_(name), at_(start), big_endian_(big_endian) {}

  double number(PlyType type) {
    if (type == PlyType::kFloat32) return std::bit_cast<float>(static_cast<std::uint32_t>(raw(4)));
    if (type == PlyType::kFloat64) return std::bit_cast<double>(raw(8));
    return static_cast<double>(integer(type));
  }
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::kInt8: return static_cast<std::int8_t>(raw(1));
      case PlyType::kUint8: return static_cast<std::uint8_t>(raw(1));
      case PlyType::kInt16: return static_cast<std::int16_t>(raw(2));
      case PlyType::kUint16: return static_cast<std::uint16_t>(raw(2));
      case PlyType::kInt32: return static_cast<std::int32_t>(raw(4));
      case PlyType::kUint32: return static_cast<std::uint32_t>(raw(4));
      case PlyType::kFloat32:
      case PlyType::kFloat64: break;
    }
    const double value = number(type);
    if (!(value >= -0x1p53 && value <= 0x1p53) || value != static_cast<double>(static_cast<std::int64_t>(value)))
      fail("an index is not a whole number");
    return static_cast<std::int64_t>(value);
  }
  std::size_t remaining() const { return bytes_.size() - at_; }
  static std::size_t least_size(PlyType type) { return size_of(type); }
  [[noreturn]] void fail(const std::string& reason) const {
    throw FileError(name_ + ", byte " + std::to_string(at_) + ": " + reason + ".");
  }

 private:
  std::uint64_t raw(std::size_t size) {
    if (remaining() < size) fail("the file ends before its data do");
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes_[at_ + (big_endian_ ? i : size - 1 - i)]);
    at_ += size;
    return value;
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_;
  bool big_endian_;
};

// Before anything is allocated or looped over: can the bytes that are left hold so many elements?
template <class Values>
void require_room(const Values& values, const PlyElement& element) {
  std::size_t least = 0;
  for (const PlyProperty& p : element.properties) least += Values::least_size(p.is_list ? p.count_type : p.type);
  if (least > 0 && element.count > values.remaining() / least)
    values.fail("the header announces " + std::to_string(element.count) + " elements '" + element.name + "', more than the file can hold");
}

template <class Values>
std::uint64_t list_length(Values& values, const PlyProperty& property) {
  const std::int64_t length = values.integer(property.count_type);
  if (length < 0 || static_cast<std::uint64_t>(length) > values.remaining() / Values::least_size(property.type))
    values.fail("a list of " + std::to_string(length) + " values does not fit into the file");
  return static_cast<std::uint64_t>(length);
}

template <class Values>
void step_over(Values& values, const PlyProperty& property) {
  for (std::uint64_t n = property.is_list ? list_length(values, property) : 1; n > 0; --n) values.number(property.type);
}

template <class Values>
void read_vertices(Values& values, const PlyElement& element, SoupBuilder& soup) {
  int axes = 0;
  for (const PlyProperty& p : element.properties) axes += !p.is_list && (p.name == "x" || p.name == "y" || p.name == "z");
  if (axes != 3) values.fail("the element 'vertex' must have one property x, one y and one z");
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Vec3 p = Vec3::Zero();
    for (const PlyProperty& property : element.properties) {
      const bool is_axis = !property.is_list && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
      if (is_axis) p[property.name[0] - 'x'] = values.number(property.type);
      else step_over(values, property);
    }
    soup.vertex(p);
  }
}

template <class Values>
void read_faces(Values& values, const PlyElement& element, SoupBuilder& soup) {
  const auto is_indices = [](const PlyProperty& p) { return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index"); };
  int lists = 0;
  for (const PlyProperty& p : element.properties) lists += is_indices(p);
  if (lists != 1) values.fail("the element 'face' must have one list vertex_indices");
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const PlyProperty& property : element.properties) {
      if (!is_indices(property)) {
        step_over(values, property);
        continue;
      }
      soup.begin_polygon();
      for (std::uint64_t n = list_length(values, property); n > 0; --n)
        if (const std::int64_t v = values.integer(property.type); !soup.corner(v))
          values.fail("no vertex has the number " + std::to_string(v));
      if (!soup.end_polygon()) values.fail("a face has fewer than three corners");
    }
}

template <class Values>
TriangleSoup read_elements(Values values, const PlyHeader& header, const std::string& name) {
  SoupBuilder soup;
  bool has_vertices = false, has_faces = false;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;  // nothing is stored for it, whatever its count
    require_room(values, element);
    if (element.name == "vertex") {
      if (has_vertices) values.fail("there are two elements 'vertex'");
      has_vertices = true;
      soup.expect(element.count, 0, values.remaining(), 3);
      read_vertices(values, element, soup);
    } else if (element.name == "face") {
      if (has_faces) values.fail("there are two elements 'face'");
      has_faces = true;
      soup.expect(0, element.count, values.remaining(), 1);
      read_faces(values, element, soup);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) step_over(values, property);
    }
  }
  if (!has_vertices || !has_faces) values.fail("the file must have the elements 'vertex' and 'face'");
  return soup.finish(name);
}

}  // namespace

TriangleSoup read_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = read_ply_header(bytes, name);
  if (header.encoding == PlyEncoding::kText) return read_elements(TextValues(bytes, name, header.size), header, name);
  return read_elements(BinaryValues(bytes, name, header.size, header.encoding == PlyEncoding::kBigEndian), header, name);
}

}  // namespace starcell
