// Sheets that are nearer to each other than a float32 step, moved apart so that rounding keeps them apart.
//
// FreeCAD keeps float32 coordinates, and slivers of the input may be thinner than their step. Vertices are pushed along the
// normals that separate the triangles concerned, a few steps at most. Guarantees, if it succeeds: the mesh is embedded in
// double and in float32 (tested exactly), and the straight motion of all vertices is an isotopy: for any two triangles near
// each other either one normal separates them at the start and at the end, hence always, because a vertex's height along a
// fixed normal is linear in time; or, across a common edge, they never become coplanar on one side of it (Bernstein coefficients of
// their volume, or of the product of their heights, have one sign). If some pair has no such proof, nothing is moved.
#pragma once

#include "solids/polyhedron.h"

namespace starcell {

struct FloatGaps {
  double moved = 0;     ///< farthest motion of a vertex
  bool opened = false;  ///< false: the vertices are as they were
};

/// `most`: how far a vertex may be moved.
FloatGaps open_float_gaps(std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double most);

}  // namespace starcell
