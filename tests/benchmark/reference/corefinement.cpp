// Times CGAL's corefinement (EPICK, as most programs use it) on two raw meshes: OPERATION A B; prints JSON.
// Raw: uint32 vertices, uint32 triangles, float64 coordinates, uint32 indices.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

static Mesh read(const char* path) {
  std::FILE* file = std::fopen(path, "rb");
  std::uint32_t counts[2] = {0, 0};
  if (!file || std::fread(counts, 4, 2, file) != 2) std::exit(2);
  std::vector<double> points(3 * std::size_t{counts[0]});
  std::vector<std::uint32_t> triangles(3 * std::size_t{counts[1]});
  if (std::fread(points.data(), 8, points.size(), file) != points.size()) std::exit(2);
  if (std::fread(triangles.data(), 4, triangles.size(), file) != triangles.size()) std::exit(2);
  std::fclose(file);
  Mesh mesh;
  mesh.reserve(counts[0], counts[1] * 3 / 2, counts[1]);
  for (std::size_t i = 0; i < points.size(); i += 3) mesh.add_vertex({points[i], points[i + 1], points[i + 2]});
  using Vertex = Mesh::Vertex_index;
  for (std::size_t i = 0; i < triangles.size(); i += 3)
    mesh.add_face(Vertex(triangles[i]), Vertex(triangles[i + 1]), Vertex(triangles[i + 2]));
  return mesh;
}

int main(int count, char** arguments) {
  if (count != 4) return 2;
  namespace PMP = CGAL::Polygon_mesh_processing;
  Mesh a = read(arguments[2]), b = read(arguments[3]), result;
  const std::string operation = arguments[1];
  const auto start = std::chrono::steady_clock::now();
  const bool ok = operation == "union" ? PMP::corefine_and_compute_union(a, b, result)
                  : operation == "cut" ? PMP::corefine_and_compute_difference(a, b, result)
                                       : PMP::corefine_and_compute_intersection(a, b, result);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!ok) return 1;
  std::printf("{\"seconds\": %.6f, \"triangles\": %zu, \"volume\": %.12g}\n", seconds, std::size_t{result.number_of_faces()},
              CGAL::to_double(PMP::volume(result)));
}
