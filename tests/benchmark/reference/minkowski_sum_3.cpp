// Times CGAL's minkowski_sum_3 (exact kernel, Nef polyhedra) of two raw meshes: A B; prints JSON.
// Raw: uint32 vertices, uint32 triangles, float64 coordinates, uint32 indices.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/minkowski_sum_3.h>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

static Nef read(const char* path) {
  std::FILE* file = std::fopen(path, "rb");
  std::uint32_t counts[2] = {0, 0};
  if (!file || std::fread(counts, 4, 2, file) != 2) std::exit(2);
  std::vector<double> points(3 * std::size_t{counts[0]});
  std::vector<std::uint32_t> triangles(3 * std::size_t{counts[1]});
  if (std::fread(points.data(), 8, points.size(), file) != points.size()) std::exit(2);
  if (std::fread(triangles.data(), 4, triangles.size(), file) != triangles.size()) std::exit(2);
  std::fclose(file);
  Mesh mesh;
  for (std::size_t i = 0; i < points.size(); i += 3) mesh.add_vertex({points[i], points[i + 1], points[i + 2]});
  using Vertex = Mesh::Vertex_index;
  for (std::size_t i = 0; i < triangles.size(); i += 3) mesh.add_face(Vertex(triangles[i]), Vertex(triangles[i + 1]), Vertex(triangles[i + 2]));
  return Nef(mesh);
}

int main(int count, char** arguments) {
  if (count != 3) return 2;
  Nef a = read(arguments[1]), b = read(arguments[2]);
  const auto start = std::chrono::steady_clock::now();
  const Nef sum = CGAL::minkowski_sum_3(a, b);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Mesh mesh;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(sum, mesh, true);
  std::printf("{\"seconds\": %.6f, \"triangles\": %zu, \"volume\": %.12g}\n", seconds, std::size_t{mesh.number_of_faces()},
              CGAL::to_double(CGAL::Polygon_mesh_processing::volume(mesh)));
}
