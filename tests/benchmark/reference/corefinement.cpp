// Times CGAL's corefinement (EPICK, as most programs use it) on two raw meshes: OPERATION A B; prints JSON.
#include <chrono>
#include <cstdio>
#include <string>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

#include "raw_mesh.h"

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

static Mesh read(const char* path) { return read_raw(path).surface<Mesh>(); }

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
