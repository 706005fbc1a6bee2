// Times CGAL's minkowski_sum_3 (exact kernel, Nef polyhedra) of two raw meshes: A B; prints JSON.
#include <chrono>
#include <cstdio>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/minkowski_sum_3.h>

#include "raw_mesh.h"

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

static Nef read(const char* path) { return Nef(read_raw(path).surface<Mesh>()); }

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
