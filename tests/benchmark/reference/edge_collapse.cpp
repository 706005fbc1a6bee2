// Times CGAL's edge collapse with its polyhedral-envelope filter: MESH ERROR [OUT]; prints JSON. Lindstrom-Turk's cost and placement, normals kept.
// The filter keeps the new mesh near the old one, not the old one near the new.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Polyhedral_envelope_filter.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "raw_mesh.h"

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace SMS = CGAL::Surface_mesh_simplification;

int main(int count, char** arguments) {
  if (count < 3) return 2;
  Mesh mesh = read_raw(arguments[1]).surface<Mesh>();
  const std::size_t before = mesh.number_of_faces();
  const double error = std::atof(arguments[2]);
  const auto start = std::chrono::steady_clock::now();
  using Placement = SMS::LindstromTurk_placement<Mesh>;
  using Filter = SMS::Polyhedral_envelope_filter<Kernel, SMS::Bounded_normal_change_filter<>>;
  SMS::edge_collapse(mesh, SMS::Count_stop_predicate<Mesh>(0), CGAL::parameters::filter(Filter(error, SMS::Bounded_normal_change_filter<>())).get_cost(SMS::LindstromTurk_cost<Mesh>()).get_placement(Placement()));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  mesh.collect_garbage();
  if (count > 3) CGAL::IO::write_polygon_mesh(arguments[3], mesh);
  std::printf("{\"seconds\": %.6f, \"triangles\": %zu, \"from\": %zu, \"embedded\": %s}\n", seconds, std::size_t{mesh.number_of_faces()}, before,
              CGAL::Polygon_mesh_processing::does_self_intersect(mesh) ? "false" : "true");
}
