#include "solids/mesh_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <string>

#include "solids/whole_file.h"

namespace starcell {
namespace {

using Bytes = std::string;
using Vertices = std::vector<Vec3>;
using Triangles = std::vector<Triangle>;

static_assert(std::endian::native == std::endian::little, "binary formats are written in memory order");

/// The shortest text that reads back as the same number.
template <class Number>
void put_text(Bytes& out, Number value, char end) {
  std::array<char, 32> digits;
  char* const last = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  out.append(digits.data(), last) += end;
}

template <class Number>
void put_raw(Bytes& out, Number value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

void put_point(Bytes& out, const Vec3& p) {
  put_text(out, p.x(), ' ');
  put_text(out, p.y(), ' ');
  put_text(out, p.z(), '\n');
}

void put_indices(Bytes& out, const Triangle& t, std::uint32_t first) {
  put_text(out, t[0] + first, ' ');
  put_text(out, t[1] + first, ' ');
  put_text(out, t[2] + first, '\n');
}

Bytes off(const Vertices& vertices, const Triangles& triangles) {
  Bytes out = "OFF\n" + std::to_string(vertices.size()) + ' ' + std::to_string(triangles.size()) + " 0\n";
  for (const Vec3& p : vertices) put_point(out, p);
  for (const Triangle& t : triangles) put_indices(out += "3 ", t, 0);
  return out;
}

Bytes obj(const Vertices& vertices, const Triangles& triangles) {
  Bytes out;
  for (const Vec3& p : vertices) put_point(out += "v ", p);
  for (const Triangle& t : triangles) put_indices(out += "f ", t, 1);
  return out;
}

Bytes stl(const Vertices& vertices, const Triangles& triangles) {
  Bytes out = "binary STL";
  out.resize(80, ' ');
  put_raw(out, static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    const Vec3 &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    const Vec3 normal = (b - a).cross(c - a).stableNormalized();
    for (const Vec3& row : {normal, a, b, c})
      for (int k = 0; k < 3; ++k) put_raw(out, static_cast<float>(row[k]));
    put_raw(out, std::uint16_t{0});
  }
  return out;
}

Bytes ply(const Vertices& vertices, const Triangles& triangles) {
  Bytes out = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices.size()) +
              "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(triangles.size()) +
              "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : vertices)
    for (int k = 0; k < 3; ++k) put_raw(out, p[k]);
  for (const Triangle& t : triangles) {
    put_raw(out, std::uint8_t{3});
    for (const std::uint32_t corner : t) put_raw(out, static_cast<std::int32_t>(corner));
  }
  return out;
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const Vertices& vertices, const Triangles& triangles) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  Bytes (*format)(const Vertices&, const Triangles&) = extension == ".off"   ? off
                                                       : extension == ".obj" ? obj
                                                       : extension == ".stl" ? stl
                                                       : extension == ".ply" ? ply
                                                                             : nullptr;
  if (!format) throw std::invalid_argument("path: the extension '" + extension + "' is none of .off, .obj, .stl, .ply");
  write_whole_file(path, format(vertices, triangles));
}

}  // namespace starcell
