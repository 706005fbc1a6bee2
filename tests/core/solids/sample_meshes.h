// Small closed meshes for the tests, as plain vertices and triangles, built without the code under test.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "solids/errors.h"
#include "solids/polyhedron.h"

namespace starcell::sample {

struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

inline Mesh box(const Vec3& lower, const Vec3& upper) {
  Mesh m;
  for (int i = 0; i < 8; ++i) m.vertices.emplace_back((i & 1 ? upper : lower)[0], (i & 2 ? upper : lower)[1], (i & 4 ? upper : lower)[2]);
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

inline Mesh tetrahedron() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}}; }

inline Mesh torus(int n, int m, double major = 3.0, double minor = 1.0) {
  Mesh mesh;
  const double turn = 2 * std::numbers::pi;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double a = turn * i / n, b = turn * j / m, r = major + minor * std::cos(b);
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), minor * std::sin(b));
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((i % n) * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// An octahedron, every triangle split in four `level` times, its vertices at `radius(direction)`: star-shaped about 0.
template <class Radius>
Mesh star_shape(int level, const Radius& radius) {
  Mesh mesh = {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
               {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int l = 0; l < level; ++l) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, mesh.vertices.size());
      if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) finer.push_back(t);
    }
    mesh.triangles = finer;
  }
  for (Vec3& p : mesh.vertices) p *= radius(p);
  return mesh;
}

inline Mesh sphere(int level, double r = 1.0) {
  return star_shape(level, [r](const Vec3&) { return r; });
}

/// Two (or more) meshes in one, sharing no vertex numbers.
inline Mesh joined(std::initializer_list<Mesh> parts) {
  Mesh all;
  for (const Mesh& part : parts) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& [a, b, c] : part.triangles) all.triangles.push_back({a + first, b + first, c + first});
  }
  return all;
}

inline Mesh flipped(Mesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline Mesh moved(Mesh mesh, const Vec3& shift) {
  for (Vec3& p : mesh.vertices) p += shift;
  return mesh;
}

inline double volume(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  double six = 0.0;
  for (const auto& [a, b, c] : triangles) six += vertices[a].dot(vertices[b].cross(vertices[c]));
  return six / 6;
}
inline double volume(const PolyhedronPtr& p) { return volume(p->vertices(), p->triangles()); }

inline PolyhedronPtr make(const Mesh& mesh) { return Polyhedron::make(mesh.vertices, mesh.triangles); }

/// The sentence with which the mesh is refused; empty if it is accepted.
inline std::string refusal(const Mesh& mesh) {
  try {
    make(mesh);
  } catch (const InvalidSolidError& error) {
    return error.what();
  }
  return "";
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace starcell::sample
