// Sheets that are nearer to each other than a float32 step, moved apart so that rounding keeps them apart.
//
// FreeCAD keeps float32 coordinates, and slivers of the input may be thinner than their step. Vertices are pushed along the
// normals that separate the triangles concerned, a few steps at most. Guarantees, if it succeeds: the mesh is embedded in
// double and in float32 (tested exactly), and the straight motion of all vertices is an isotopy: for any two triangles near
// each other either one normal separates them at the start and at the end, hence always, because a vertex's height along a
// fixed normal is linear in time; or, across a common edge, they never become coplanar on one side of it (Bernstein coefficients of
// their volume, or of the product of their heights, have one sign). Pairs without such a proof are first given a common motion and the rest is tried
// again; if some are left, nothing is moved.
#pragma once

#include "contouring/embedding.h"

namespace starcell {

struct FloatGaps {
  double moved = 0;     ///< farthest motion of a vertex
  bool opened = false;  ///< false: the vertices are as they were
};

/// `most`: how far a vertex may be moved. Throws CancelledError.
FloatGaps open_float_gaps(std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, double most, const GoOn& go_on = {});

}  // namespace starcell
