#include "certificate/checker_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <unordered_map>

namespace starcell::checker {
namespace {

using Edges = std::unordered_map<std::uint64_t, std::uint32_t>;  // directed edge -> its triangle

std::uint64_t edge(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; }

std::string vertex_text(const StoredMesh& mesh, std::uint32_t v) {
  const Vec3& p = mesh.vertices[v];
  return "vertex " + std::to_string(v) + " (" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ", " +
         std::to_string(p.z()) + ")";
}

/// Counts defects of one kind and remembers the first.
struct Defects {
  std::size_t count = 0;
  std::uint32_t first = 0;
  void add(std::uint32_t vertex) {
    if (count++ == 0) first = vertex;
  }
  std::string text(const StoredMesh& mesh, const char* what) const {
    return std::to_string(count) + " " + what + ", the first at " + vertex_text(mesh, first);
  }
};

Edges directed_edges(const StoredMesh& mesh, Defects& repeated) {
  Edges edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Triangle& c = mesh.triangles[t];
      if (c[k] == c[(k + 1) % 3] || !edges.emplace(edge(c[k], c[(k + 1) % 3]), t).second) repeated.add(c[k]);
    }
  return edges;
}

/// On a mesh whose edges pair up, the triangles around v fall into cycles; more than one is a pinched vertex.
Defects pinched_vertices(const StoredMesh& mesh, const Edges& edges) {
  std::vector<std::uint32_t> degree(mesh.vertices.size(), 0);
  std::vector<std::uint32_t> some_triangle(mesh.vertices.size(), 0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) ++degree[v], some_triangle[v] = t;
  Defects pinched;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (degree[v] == 0) continue;
    std::uint32_t t = some_triangle[v], steps = 0;
    do {
      const Triangle& c = mesh.triangles[t];
      const int k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
      t = edges.at(edge(v, c[(k + 2) % 3]));  // across the edge that enters v
    } while (++steps < degree[v] && t != some_triangle[v]);
    if (steps != degree[v] || t != some_triangle[v]) pinched.add(v);
  }
  return pinched;
}

double signed_volume(const StoredMesh& mesh, const Triangle& t, const Vec3& origin) {
  const Vec3 a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin, c = mesh.vertices[t[2]] - origin;
  return a.dot(b.cross(c)) / 6;
}

Vec3 area_vector(const StoredMesh& mesh, const Triangle& t) {
  return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]) / 2;
}

/// The component of every vertex, numbered by its smallest vertex.
std::vector<std::uint32_t> components_of(const StoredMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : mesh.triangles)
    for (int k = 1; k < 3; ++k) {
      const std::uint32_t a = root(t[0]), b = root(t[k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = root(v);
  return parent;
}

}  // namespace

std::string manifold_defect(const StoredMesh& mesh) {
  Defects repeated, open;
  const Edges edges = directed_edges(mesh, repeated);
  if (repeated.count > 0)
    return repeated.text(mesh, "edges are used twice in one direction (not manifold, or not oriented)");
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      if (!edges.contains(edge(t[(k + 1) % 3], t[k]))) open.add(t[k]);
  if (open.count > 0) return open.text(mesh, "edges have a triangle on one side only");
  const Defects pinched = pinched_vertices(mesh, edges);
  if (pinched.count > 0) return pinched.text(mesh, "vertices join several fans of triangles");
  return "";
}

Counted count(const StoredMesh& mesh) {
  struct Component {
    int chi = 0;
    int directed_edges = 0;
    double volume = 0;
  };
  std::map<std::uint32_t, Component> found;
  if (mesh.triangles.empty()) return {};
  const std::vector<std::uint32_t> component = components_of(mesh);
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& t : mesh.triangles) {
    Component& c = found[component[t[0]]];
    c.chi += 1;
    c.directed_edges += 3;
    c.volume += signed_volume(mesh, t, mesh.vertices[component[t[0]]]);
    for (const std::uint32_t v : t) used[v] = true;
  }
  for (std::uint32_t v = 0; v < used.size(); ++v)
    if (used[v]) ++found[component[v]].chi;
  std::vector<Component> sorted;
  for (const auto& [root, c] : found) sorted.push_back(c);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Component& a, const Component& b) { return std::abs(a.volume) > std::abs(b.volume); });
  Counted counted;
  for (const Component& c : sorted) {
    const int chi = c.chi - c.directed_edges / 2;
    counted.genus.push_back(1 - chi / 2);
    counted.volume.push_back(std::abs(c.volume));
    counted.euler_characteristic += chi;
  }
  return counted;
}

double volume(const StoredMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += signed_volume(mesh, t, mesh.vertices.front());
  return sum;
}

double collar(const StoredMesh& mesh, double distance) {
  Defects ignored;
  const Edges edges = directed_edges(mesh, ignored);
  double area = 0, bending = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 n = area_vector(mesh, t);
    area += n.norm();
    for (int k = 0; k < 3; ++k) {
      const auto other = edges.find(edge(t[(k + 1) % 3], t[k]));
      if (other == edges.end() || t[k] > t[(k + 1) % 3]) continue;
      const Vec3 m = area_vector(mesh, mesh.triangles[other->second]);
      bending += (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm() * std::atan2(n.cross(m).norm(), n.dot(m));
    }
  }
  const double components = static_cast<double>(count(mesh).genus.size());
  const double square = distance * distance;
  return area * distance + bending * square / 2 + components * 4 / 3 * std::numbers::pi * square * distance;
}

double largest_coordinate(const StoredMesh& mesh) {
  double largest = 0;
  for (const Vec3& p : mesh.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

bool in_range(const Vec3& p) {
  return std::all_of(p.data(), p.data() + 3,
                     [](double x) { return x == 0 || (std::abs(x) >= 1e-30 && std::abs(x) <= 1e30); });
}

bool in_range(const StoredMesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Vec3& p) { return in_range(p); });
}

}  // namespace starcell::checker
