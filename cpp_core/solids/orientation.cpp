// Flood fill for consistency. For the outward side, per shell: the sign of its volume, and the parity of the other
// shells' facets above one of its points. Both are decided by a floating-point value with a proven error bound, or
// else exactly (CGAL's dyadic numbers, and upward_ray.h, whose condition holds: a point of one shell is on no other).
#include "solids/orientation.h"

#include <CGAL/Mpzf.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "solids/triangle_hierarchy.h"
#include "solids/upward_ray.h"

namespace starcell {
namespace {

int next(int k) { return k == 2 ? 0 : k + 1; }

void turn_round(Triangle& triangle, Triangle& neighbours) {
  std::swap(triangle[1], triangle[2]);    // (a, b, c) becomes (a, c, b),
  std::swap(neighbours[0], neighbours[2]);  // edges ab, bc, ca become ac, cb, ba
}

// Do both triangles run through the edge from u to v in this direction?
bool runs_through(const Triangle& t, std::uint32_t u, std::uint32_t v) {
  for (int k = 0; k < 3; ++k)
    if (t[k] == u && t[next(k)] == v) return true;
  return false;
}

// Sign of the volume from the doubles, or 0 for "don't know". Six times the volume is the sum of det(a-o, b-o, c-o).
// A difference, product or sum adds a relative error of at most u = 2^-53; each term passes through fewer than 16 of
// them, the running sum through one a triangle, so the error is below (n + 16) u S, S the sum of the absolute products.
struct VolumeSum {
  Vec3 origin;
  double value = 0.0, magnitude = 0.0, extent = 0.0;
  std::size_t count = 0;

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 p = a - origin, q = b - origin, r = c - origin;
    value += p.dot(q.cross(r));
    const Vec3 aq = q.cwiseAbs(), ar = r.cwiseAbs();
    magnitude += p.cwiseAbs().dot(Vec3(aq[1] * ar[2] + aq[2] * ar[1], aq[2] * ar[0] + aq[0] * ar[2], aq[0] * ar[1] + aq[1] * ar[0]));
    extent = std::max({extent, p.cwiseAbs().maxCoeff(), aq.maxCoeff(), ar.maxCoeff()});
    ++count;
  }
  int sign() const {
    const double bound = magnitude * (double(count) + 16.0) * 0x1.1p-53;  // a sixteenth more covers the rounding of the bound
    // A product that underflows loses 2^-1074, times 1e50 still far below the bound.
    if (!(magnitude > 1e-200 && extent < 1e50) || !(std::abs(value) > bound)) return 0;
    return value > 0 ? 1 : -1;
  }
};

int exact_volume_sign(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, const Shells& shells,
                      std::uint32_t shell) {
  using Exact = CGAL::Mpzf;
  Exact sum(0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (shells.of_triangle[t] != shell) continue;
    Exact m[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[i][j] = Exact(vertices[triangles[t][i]][j]);
    sum = sum + m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) + m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }
  return CGAL::sign(sum);
}

}  // namespace

Shells orient_consistently(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles,
                           std::vector<Triangle>& neighbours) {
  Shells shells;
  shells.of_triangle.assign(triangles.size(), kNoTriangle);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (shells.of_triangle[first] != kNoTriangle) continue;
    const auto shell = static_cast<std::uint32_t>(shells.first_triangle.size());
    shells.first_triangle.push_back(first);
    bool consistent = true;
    shells.of_triangle[first] = shell;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t other = neighbours[t][k];
        if (other == kNoTriangle) continue;
        const bool opposed = runs_through(triangles[other], triangles[t][k], triangles[t][next(k)]);
        if (shells.of_triangle[other] == kNoTriangle) {
          if (opposed) turn_round(triangles[other], neighbours[other]);
          shells.of_triangle[other] = shell;
          stack.push_back(other);
        } else if (opposed) {
          consistent = false;
        }
      }
    }
    if (!consistent && shells.non_orientable.count++ == 0) shells.non_orientable.first = place(vertices[triangles[first][0]]);
  }
  return shells;
}

void orient_outward(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles,
                    std::vector<Triangle>& neighbours, const Shells& shells, const TriangleHierarchy& hierarchy) {
  const std::size_t count = shells.first_triangle.size();
  std::vector<VolumeSum> volumes(count);
  for (std::size_t s = 0; s < count; ++s) volumes[s].origin = vertices[triangles[shells.first_triangle[s]][0]];
  for (std::size_t t = 0; t < triangles.size(); ++t)
    volumes[shells.of_triangle[t]].add(vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]);

  std::vector<char> turn(count, 0);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t s) {
    const auto shell = static_cast<std::uint32_t>(s);
    int sign = volumes[s].sign();
    if (sign == 0) sign = exact_volume_sign(vertices, triangles, shells, shell);
    bool inside_odd = false;
    if (count > 1) {
      const Vec3& p = vertices[triangles[shells.first_triangle[s]][0]];
      hierarchy.above(p, [&](std::uint32_t t) {
        if (shells.of_triangle[t] != shell && is_above(vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]], p))
          inside_odd = !inside_odd;
      });
    }
    turn[s] = (sign < 0) != inside_odd;
  });
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (turn[shells.of_triangle[t]]) turn_round(triangles[t], neighbours[t]);
}

}  // namespace starcell
