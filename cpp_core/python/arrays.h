// Between numpy (or nested sequences) and the core's vectors. Every reader names the argument in its errors.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <vector>

#include "configuration_space/convex_pieces.h"
#include "numerics/vector.h"
#include "solids/polyhedron.h"

namespace starcell::python {

namespace py = pybind11;

/// Shape (3,). Throws ValueError for another shape, TypeError for what is no number.
Vec3 read_vector(const py::handle& object, const char* argument);

/// Shape (3, 3), row by row.
Eigen::Matrix3d read_matrix3(const py::handle& object, const char* argument);

/// Shape (4, 4), row by row.
Eigen::Matrix4d read_matrix4(const py::handle& object, const char* argument);

/// Shape (n, 3), float64. Not finite values pass: the solid's own validation counts and places them.
std::vector<Vec3> read_points(const py::handle& object, const char* argument);

/// Shape (2,).
std::array<double, 2> read_vector2(const py::handle& object, const char* argument);

/// One polygon, shape (n, 2), or a sequence of such; one of them may be a sequence itself, of its outer ring and holes.
std::vector<PlanarPolygon> read_polygons(const py::handle& object, const char* argument);

/// Shape (m, 3), integers in [0, vertex_count), checked as 64-bit numbers before they are narrowed.
std::vector<Triangle> read_triangles(const py::handle& object, const char* argument, std::size_t vertex_count);

/// Read-only views of memory that `owner` keeps alive.
py::array view_points(const std::vector<Vec3>& points, const py::handle& owner);
py::array view_triangles(const std::vector<Triangle>& triangles, const py::handle& owner);

py::array to_array(const Vec3& vector);
py::tuple to_tuple(const Box3& box);  ///< (lower, upper)

}  // namespace starcell::python
