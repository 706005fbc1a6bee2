// How far a raw mesh is from the offset of another: offset_deviation SOLID RADIUS MESH. Prints the largest | distance - RADIUS | over
// corners, middles of edges and of triangles (CGAL): one side of the Hausdorff distance, for meshes without parts of their own.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

static Triangles read(const char* path) {
  std::FILE* file = std::fopen(path, "rb");
  std::uint32_t counts[2] = {0, 0};
  if (!file || std::fread(counts, 4, 2, file) != 2) std::exit(2);
  std::vector<double> raw(3 * std::size_t{counts[0]});
  std::vector<std::uint32_t> corners(3 * std::size_t{counts[1]});
  if (std::fread(raw.data(), 8, raw.size(), file) != raw.size() || std::fread(corners.data(), 4, corners.size(), file) != corners.size()) std::exit(2);
  std::fclose(file);
  const auto point = [&](std::uint32_t v) { return Kernel::Point_3(raw[3 * v], raw[3 * v + 1], raw[3 * v + 2]); };
  Triangles all;
  for (std::size_t t = 0; t < counts[1]; ++t) all.emplace_back(point(corners[3 * t]), point(corners[3 * t + 1]), point(corners[3 * t + 2]));
  return all;
}

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  Triangles solid = read(argv[1]);
  std::erase_if(solid, [](const auto& t) { return t.is_degenerate(); });
  const double radius = std::atof(argv[2]);
  const Tree tree(solid.begin(), solid.end());
  double worst = 0;
  for (const auto& t : read(argv[3])) {
    const auto look = [&](const Kernel::Point_3& p) { worst = std::max(worst, std::abs(std::sqrt(tree.squared_distance(p)) - radius)); };
    look(t[0]), look(CGAL::midpoint(t[0], t[1])), look(CGAL::midpoint(t[1], t[2])), look(CGAL::midpoint(t[2], t[0])), look(CGAL::centroid(t));
  }
  std::printf("%.9g\n", worst);
}
