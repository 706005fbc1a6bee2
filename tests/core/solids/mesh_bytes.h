// Writes meshes in the four formats, for the tests of the readers: independent of the readers, and exact, because
// std::to_chars writes the shortest digits that give the same double back.
#pragma once

#include <bit>
#include <charconv>
#include <string>

#include "solids/ply_header.h"
#include "solids/sample_meshes.h"

namespace starcell::sample {

inline std::string digits(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

inline std::string coordinates(const Vec3& p) { return digits(p[0]) + " " + digits(p[1]) + " " + digits(p[2]); }

inline std::string off_bytes(const Mesh& mesh) {
  std::string out = "OFF\n" + std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.triangles.size()) + " 0\n";
  for (const Vec3& p : mesh.vertices) out += coordinates(p) + "\n";
  for (const auto& [a, b, c] : mesh.triangles) out += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  return out;
}

inline std::string obj_bytes(const Mesh& mesh) {
  std::string out = "# a mesh\n";
  for (const Vec3& p : mesh.vertices) out += "v " + coordinates(p) + "\n";
  for (const auto& [a, b, c] : mesh.triangles) out += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  return out;
}

inline std::string stl_text(const Mesh& mesh) {
  std::string out = "solid test\n";
  for (const Triangle& t : mesh.triangles) {
    out += "facet normal 0 0 0\n outer loop\n";
    for (std::uint32_t v : t) out += "  vertex " + coordinates(mesh.vertices[v]) + "\n";
    out += " endloop\nendfacet\n";
  }
  return out + "endsolid test\n";
}

inline void put(std::string& out, std::uint64_t value, int size, bool big_endian) {
  for (int i = 0; i < size; ++i) out += static_cast<char>(value >> 8 * (big_endian ? size - 1 - i : i));
}

inline std::string stl_binary(const Mesh& mesh, std::string header) {
  header.resize(80, ' ');
  put(header, mesh.triangles.size(), 4, false);
  for (const Triangle& t : mesh.triangles) {
    header.append(12, '\0');
    for (std::uint32_t v : t)
      for (int axis = 0; axis < 3; ++axis) put(header, std::bit_cast<std::uint32_t>(float(mesh.vertices[v][axis])), 4, false);
    header.append(2, '\0');
  }
  return header;
}

inline std::string ply_bytes(const Mesh& mesh, PlyEncoding encoding) {
  const bool big = encoding == PlyEncoding::kBigEndian, text = encoding == PlyEncoding::kText;
  std::string out = std::string("ply\nformat ") + (text ? "ascii" : big ? "binary_big_endian" : "binary_little_endian") + " 1.0\nelement vertex " +
                    std::to_string(mesh.vertices.size()) + "\nproperty double x\nproperty double y\nproperty double z\nproperty short tag\nelement face " +
                    std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : mesh.vertices) {
    if (text) out += coordinates(p) + " -7\n";
    else {
      for (int axis = 0; axis < 3; ++axis) put(out, std::bit_cast<std::uint64_t>(p[axis]), 8, big);
      put(out, 7, 2, big);
    }
  }
  for (const Triangle& t : mesh.triangles) {
    if (text) out += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    else {
      out += '\3';
      for (std::uint32_t v : t) put(out, v, 4, big);
    }
  }
  return out;
}

}  // namespace starcell::sample
