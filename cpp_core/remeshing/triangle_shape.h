// How well shaped triangles are: what remeshing makes better.
#pragma once

#include <vector>

#include "isotopy/triangle_cover.h"
#include "solids/polyhedron.h"

namespace starcell {

/// In radians, at most pi/3; 0 without an area.
double least_angle(const Corners& t);

/// The longest side by the inscribed circle's diameter, by what that is for equal sides: 1 for those, infinite without an area.
double aspect_ratio(const Corners& t);

struct TriangleShapes {
  double least_angle = 0;   ///< radians
  double mean_aspect_ratio = 0, largest_aspect_ratio = 0;
};

/// All 0 without triangles.
TriangleShapes triangle_shapes(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles);

}  // namespace starcell
