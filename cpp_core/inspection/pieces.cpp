#include "inspection/pieces.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "solids/orientation.h"
#include "solids/triangle_hierarchy.h"
#include "solids/upward_ray.h"

namespace starcell {
namespace {

// A mesh's shells: which triangle is whose, and how large each is; a cavity's volume is negative.
struct Parts {
  explicit Parts(const Polyhedron& solid) {
    std::vector<Triangle> triangles = solid.triangles(), neighbours = solid.neighbours();
    shells = orient_consistently(solid.vertices(), triangles, neighbours);
    volume.assign(shells.first_triangle.size(), 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Vec3 &origin = solid.vertices()[triangles[shells.first_triangle[shells.of_triangle[t]]][0]];
      const Vec3 a = solid.vertices()[triangles[t][0]] - origin, b = solid.vertices()[triangles[t][1]] - origin,
                 c = solid.vertices()[triangles[t][2]] - origin;
      volume[shells.of_triangle[t]] += a.dot(b.cross(c)) / 6;
    }
  }

  bool is_cavity(std::uint32_t shell) const { return volume[shell] < 0; }

  Shells shells;
  std::vector<double> volume;
};

// The outer shell of the part of `whole` that p is in: of the shells around it the inmost, if that is no cavity. Shells around a
// point are nested, so the inmost is the one of least volume.
std::optional<std::uint32_t> part_around(const Vec3& p, const Polyhedron& whole, const Parts& parts, const TriangleHierarchy& hierarchy) {
  std::map<std::uint32_t, bool> odd;
  for_each_above(whole, hierarchy, p, [&](std::uint32_t t) { odd[parts.shells.of_triangle[t]] ^= true; });
  std::optional<std::uint32_t> inmost;
  for (const auto& [shell, is_around] : odd)
    if (is_around && (!inmost || std::abs(parts.volume[shell]) < std::abs(parts.volume[*inmost]))) inmost = shell;
  return inmost && !parts.is_cavity(*inmost) ? inmost : std::nullopt;
}

}  // namespace

std::vector<int> count_pieces(const Polyhedron& whole, const Polyhedron& inner) {
  const Parts around(whole), inside(inner);
  const TriangleHierarchy hierarchy(whole.vertices(), whole.triangles());
  std::vector<int> count(around.volume.size(), 0);
  for (std::uint32_t shell = 0; shell < inside.volume.size(); ++shell) {
    if (inside.is_cavity(shell)) continue;
    const Vec3& p = inner.vertices()[inner.triangles()[inside.shells.first_triangle[shell]][0]];
    if (const auto part = part_around(p, whole, around, hierarchy)) ++count[*part];
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t shell = 0; shell < count.size(); ++shell)
    if (!around.is_cavity(shell)) order.push_back(shell);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return around.volume[a] > around.volume[b]; });
  std::vector<int> result;
  for (const std::uint32_t shell : order) result.push_back(count[shell]);
  return result;
}

}  // namespace starcell
