#include "remeshing/triangle_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

namespace starcell {

double least_angle(const Corners& t) {
  const std::array<double, 3> squares{(t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm(), (t[1] - t[0]).squaredNorm()};
  double largest = -1;   // of the cosines
  for (std::size_t k = 0; k < 3; ++k) {
    const double p = squares[(k + 1) % 3], q = squares[(k + 2) % 3];
    largest = p > 0 && q > 0 ? std::max(largest, (p + q - squares[k]) / (2 * std::sqrt(p * q))) : 1;
  }
  return std::acos(std::min(largest, 1.0));
}

double aspect_ratio(const Corners& t) {
  const double a = (t[2] - t[1]).norm(), b = (t[0] - t[2]).norm(), c = (t[1] - t[0]).norm(), twice_area = (t[1] - t[0]).cross(t[2] - t[0]).norm();
  return twice_area > 0 ? std::max({a, b, c}) * (a + b + c) / (2 * std::sqrt(3.0) * twice_area) : std::numeric_limits<double>::infinity();
}

TriangleShapes triangle_shapes(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  TriangleShapes shapes;
  if (triangles.empty()) return shapes;
  shapes.least_angle = M_PI;
  for (const Triangle& t : triangles) {
    const Corners corners{vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    const double ratio = aspect_ratio(corners);
    shapes.least_angle = std::min(shapes.least_angle, least_angle(corners));
    shapes.mean_aspect_ratio += ratio / static_cast<double>(triangles.size());
    shapes.largest_aspect_ratio = std::max(shapes.largest_aspect_ratio, ratio);
  }
  return shapes;
}

}  // namespace starcell
