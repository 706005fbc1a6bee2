// Solids, table, grid and restriction for tests of the subdivision's parts, on a grid whose unit is 1.
#pragma once

#include <algorithm>
#include <numeric>
#include <random>

#include "operations/operands.h"
#include "solids/sample_meshes.h"
#include "subdivision/cell_problem.h"
#include "subdivision/facets.h"
#include "subdivision/grid_line.h"

namespace starcell::sample {

/// The solids' expression in a root cell [0, 2^depth]^3.
struct Scene {
  Scene(const std::vector<Mesh>& meshes, LocalExpression::Op op, int depth = 5)
      : table(gather_facets(solids(meshes), 1e-9)), grid{.unit = 1.0, .step = 1.0, .origin = {0, 0, 0}, .depth = depth}, restriction(table, grid) {
    std::vector<LocalExpression::Step> program;
    std::vector<std::uint32_t> names;
    for (std::uint32_t s = 0; s < meshes.size(); ++s) {
      program.push_back({LocalExpression::Op::leaf, s});
      names.push_back(s);
    }
    if (meshes.size() > 1) program.push_back({op, static_cast<std::uint32_t>(meshes.size())});
    expression = LocalExpression(program, names);
  }
  Scene(const Scene&) = delete;

  static std::vector<PolyhedronPtr> solids(const std::vector<Mesh>& meshes) {
    std::vector<PolyhedronPtr> made;
    for (const Mesh& m : meshes) made.push_back(make(m));
    return made;
  }

  /// The problem of the cell with this lower corner and size, by descent from the root.
  CellProblem at(const GridPoint& lower, std::uint32_t size) const {
    CellProblem problem = restriction.root(expression);
    while (problem.cell.size > size) {
      const std::uint32_t half = problem.cell.size / 2;
      int index = 0;
      for (int k = 0; k < 3; ++k)
        if (lower[k] >= problem.cell.lower[k] + half) index |= 1 << k;
      problem = restriction.children(problem)[index];
    }
    return problem;
  }

  FacetTable table;
  Grid grid;
  Restriction restriction;
  LocalExpression expression;
};

/// A pebble with irregular coordinates in the middle of [0, 32]^3.
inline Mesh stone(std::mt19937& random, int level = 2, double size = 9) {
  std::uniform_real_distribution<double> phase(0, 6.28), shift(12, 20);
  const double a = phase(random), b = phase(random);
  const Vec3 centre(shift(random), shift(random), shift(random));
  return moved(star_shape(level, [=](const Vec3& d) { return size * (1 + 0.3 * std::sin(3 * d.x() + a) * std::cos(2 * d.y() + b)); }),
               centre);
}

/// How often the surface winds around x, by solid angles (Van Oosterom & Strackee 1983): 1 inside, 0 outside.
inline double winding(const Mesh& mesh, const Vec3& x) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - x, b = mesh.vertices[t[1]] - x, c = mesh.vertices[t[2]] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace starcell::sample
