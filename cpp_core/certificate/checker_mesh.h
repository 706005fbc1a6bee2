// What the checker counts and measures on a triangle mesh by itself. None of it shares code with the engine.
#pragma once

#include <string>
#include <vector>

#include "certificate/certificate_file.h"

namespace starcell::checker {

/// Empty if every edge has two triangles that run through it in opposite directions and the triangles around every vertex
/// form one cycle; otherwise what is wrong, how often and where first.
std::string manifold_defect(const StoredMesh& mesh);

struct Counted {
  std::vector<int> genus;      ///< per connected component, largest volume first
  std::vector<double> volume;  ///< absolute, in the same order
  int euler_characteristic = 0;
};

/// Only for a mesh without manifold_defect().
Counted count(const StoredMesh& mesh);

/// By the divergence theorem, about the first vertex.
double volume(const StoredMesh& mesh);

/// Volume within `distance` of one side of the mesh to second order (Steiner): area d + sum over edges of length times
/// angle d^2 / 2 + 4/3 pi d^3 per component.
double collar(const StoredMesh& mesh, double distance);

double largest_coordinate(const StoredMesh& mesh);

/// Every coordinate is 0 or of a size in [1e-30, 1e30]: beyond, GMP's exact numbers end the process with a signal.
bool in_range(const Vec3& p);
bool in_range(const StoredMesh& mesh);

}  // namespace starcell::checker
