// Results of operations, measured on the mesh alone: nothing that a certificate says is used to judge it.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <random>
#include <set>

#include "operations/boolean.h"
#include "solids/sample_meshes.h"

namespace starcell::sample {

/// How many directed edges lack their opposite or occur twice: 0 for a closed oriented mesh.
inline std::size_t bad_edges(const Result& r) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : r.triangles)
    for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  std::size_t bad = 0;
  for (const auto& [edge, times] : edges) bad += times != 1 || !edges.contains({edge.second, edge.first});
  return bad;
}

struct Topology {
  int components = 0;
  std::multiset<int> genus;
  friend bool operator==(const Topology&, const Topology&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Topology& t) {
    out << t.components << " components of genus";
    for (int g : t.genus) out << ' ' << g;
    return out;
  }
};

/// Components by union-find over vertices, genus of each from V - E + F = 2 - 2g.
inline Topology topology(const Result& r) {
  std::vector<std::uint32_t> parent(r.vertices.size());
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = v;
  const auto find = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : r.triangles)
    for (int k = 1; k < 3; ++k) parent[find(t[0])] = find(t[k]);
  std::map<std::uint32_t, std::set<std::uint32_t>> used;
  std::map<std::uint32_t, int> faces;
  for (const Triangle& t : r.triangles) {
    ++faces[find(t[0])];
    used[find(t[0])].insert(t.begin(), t.end());
  }
  Topology result;
  for (const auto& [root, n] : faces) {
    const int euler = static_cast<int>(used[root].size()) - n / 2;  // E = 3F/2
    ++result.components;
    result.genus.insert((2 - euler) / 2);
  }
  return result;
}

inline Topology solid_ball() { return {1, {0}}; }

inline double volume(const Result& r) { return volume(r.vertices, r.triangles); }

/// Closed, manifold, embedded: in double, and on float32 coordinates as FreeCAD keeps them.
inline void expect_sound(const Result& r, const std::string& what = "") {
  ASSERT_EQ(bad_edges(r), 0u) << what;
  if (r.triangles.empty()) return;
  EXPECT_EQ(refusal({r.vertices, r.triangles}), "") << what;
  std::vector<Vec3> rounded;
  for (const Vec3& p : r.vertices) {
    volatile float x = float(p.x()), y = float(p.y()), z = float(p.z());  // g++ 12 may drop a plain round trip
    rounded.emplace_back(x, y, z);
  }
  EXPECT_EQ(refusal({rounded, r.triangles}), "") << what << " (float32)";
}

inline Eigen::Matrix3d random_rotation(std::mt19937& random) {
  std::normal_distribution<double> gauss;
  return Eigen::Quaterniond(gauss(random), gauss(random), gauss(random), gauss(random)).normalized().toRotationMatrix();
}

inline Mesh turned(Mesh mesh, const Eigen::Matrix3d& rotation, const Vec3& shift = Vec3::Zero()) {
  for (Vec3& p : mesh.vertices) p = rotation * p + shift;
  return mesh;
}

/// A star-shaped solid with bumps and dents that depend on the seed.
inline Mesh pebble(std::mt19937& random, int level, double roughness = 0.35) {
  std::uniform_real_distribution<double> phase(0, 6.28), turns(1, 4);
  const Vec3 k(turns(random), turns(random), turns(random));
  const double a = phase(random), b = phase(random), c = phase(random);
  return star_shape(level, [=](const Vec3& d) {
    return 1 + roughness * std::sin(k.x() * d.x() + a) * std::cos(k.y() * d.y() + b) * std::sin(k.z() * d.z() + c);
  });
}

inline Expression solid(const Mesh& mesh) { return Expression(make(mesh)); }
inline Expression operator|(const Expression& a, const Expression& b) { return Expression::set_union({a, b}); }
inline Expression operator&(const Expression& a, const Expression& b) { return Expression::intersection({a, b}); }
inline Expression operator-(const Expression& a, const Expression& b) { return Expression::difference(a, b); }

inline Options with_error(double error, double contact = 0) {
  Options options;
  options.error = error;
  if (contact > 0) options.contact = contact;
  return options;
}

/// The same numbers, bit for bit.
inline bool identical(const Result& a, const Result& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles;
}

inline double area(const Result& r) {
  double sum = 0;
  for (const Triangle& t : r.triangles)
    sum += 0.5 * (r.vertices[t[1]] - r.vertices[t[0]]).cross(r.vertices[t[2]] - r.vertices[t[0]]).norm();
  return sum;
}

/// The certificate keeps the error, the mesh is sound, and topology and volume are what is expected.
inline void expect_result(const Result& r, const Topology& topology, double expected_volume, double error, const std::string& what) {
  EXPECT_NE(r.certificate.verdict, Verdict::unresolved) << what;
  EXPECT_LE(r.certificate.error_bound, error) << what;
  expect_sound(r, what);
  EXPECT_EQ(sample::topology(r), topology) << what;
  EXPECT_NEAR(volume(r), expected_volume, r.certificate.error_bound * area(r) + 1e-9) << what;
}

}  // namespace starcell::sample
