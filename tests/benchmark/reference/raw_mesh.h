// Raw meshes, as the benchmarks hand them to peers: uint32 vertices, uint32 triangles, float64 coordinates, uint32 indices.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

struct RawMesh {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;

  /// As a CGAL::Surface_mesh.
  template <class Mesh>
  Mesh surface() const {
    Mesh mesh;
    mesh.reserve(points.size() / 3, points.size(), triangles.size() / 3);
    for (std::size_t i = 0; i < points.size(); i += 3) mesh.add_vertex({points[i], points[i + 1], points[i + 2]});
    using Vertex = typename Mesh::Vertex_index;
    for (std::size_t i = 0; i < triangles.size(); i += 3) mesh.add_face(Vertex(triangles[i]), Vertex(triangles[i + 1]), Vertex(triangles[i + 2]));
    return mesh;
  }
};

/// Ends the program with status 2 if the file is not there or too short.
inline RawMesh read_raw(const char* path) {
  std::FILE* file = std::fopen(path, "rb");
  std::uint32_t counts[2] = {0, 0};
  if (!file || std::fread(counts, 4, 2, file) != 2) std::exit(2);
  RawMesh mesh{std::vector<double>(3 * std::size_t{counts[0]}), std::vector<std::uint32_t>(3 * std::size_t{counts[1]})};
  if (std::fread(mesh.points.data(), 8, mesh.points.size(), file) != mesh.points.size()) std::exit(2);
  if (std::fread(mesh.triangles.data(), 4, mesh.triangles.size(), file) != mesh.triangles.size()) std::exit(2);
  std::fclose(file);
  return mesh;
}
