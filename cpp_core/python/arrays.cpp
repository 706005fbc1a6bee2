// Conversion of arrays; see arrays.h. Shapes are checked before a single value is read.
#include "arrays.h"

#include <cstring>
#include <string>

namespace starcell::python {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "points are copied and viewed as rows of three doubles");
static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t), "triangles are viewed as rows of three int32");

std::string shape_of(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i ? ", " : "") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

[[noreturn]] void wrong_shape(const char* argument, const char* wanted, const py::array& array) {
  throw py::value_error(std::string(argument) + ": expected shape " + wanted + ", got " + shape_of(array));
}

/// As numpy sees it, without a type imposed. Ragged sequences are numpy's ValueError or an array of objects.
py::array any_array(const py::handle& object, const char* argument) {
  py::array array;
  try {
    array = py::module_::import("numpy").attr("asarray")(object);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    throw py::value_error(std::string(argument) + ": its rows have different lengths, or it is no array");
  }
  const char kind = array.dtype().kind();
  if (array.size() != 0 && kind != 'f' && kind != 'i' && kind != 'u' && kind != 'b')
    throw py::type_error(std::string(argument) + ": expected real numbers, got an array of type " +
                         py::str(array.dtype()).cast<std::string>());
  return array;
}

template <class Number>
py::array_t<Number, py::array::c_style | py::array::forcecast> converted(const py::array& array, const char* argument) {
  auto result = py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!result) throw py::type_error(std::string(argument) + ": cannot be converted to numbers");
  return result;
}

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

}  // namespace

Vec3 read_vector(const py::handle& object, const char* argument) {
  const Doubles array = converted<double>(any_array(object, argument), argument);
  if (array.ndim() != 1 || array.shape(0) != 3) wrong_shape(argument, "(3,)", array);
  return {array.at(0), array.at(1), array.at(2)};
}

Eigen::Matrix3d read_matrix3(const py::handle& object, const char* argument) {
  const Doubles array = converted<double>(any_array(object, argument), argument);
  if (array.ndim() != 2 || array.shape(0) != 3 || array.shape(1) != 3) wrong_shape(argument, "(3, 3)", array);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(array.data());
}

Eigen::Matrix4d read_matrix4(const py::handle& object, const char* argument) {
  const Doubles array = converted<double>(any_array(object, argument), argument);
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) wrong_shape(argument, "(4, 4)", array);
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.data());
}

std::vector<Vec3> read_points(const py::handle& object, const char* argument) {
  const Doubles array = converted<double>(any_array(object, argument), argument);
  if (array.size() == 0) return {};
  if (array.ndim() != 2 || array.shape(1) != 3) wrong_shape(argument, "(n, 3)", array);
  std::vector<Vec3> points(static_cast<std::size_t>(array.shape(0)));
  std::memcpy(static_cast<void*>(points.data()), array.data(), points.size() * sizeof(Vec3));
  return points;
}

std::array<double, 2> read_vector2(const py::handle& object, const char* argument) {
  const Doubles array = converted<double>(any_array(object, argument), argument);
  if (array.ndim() != 1 || array.shape(0) != 2) wrong_shape(argument, "(2,)", array);
  return {array.data()[0], array.data()[1]};
}

namespace {

Ring read_ring(const py::handle& object, const char* argument) {
  const Doubles array = converted<double>(any_array(object, argument), argument);
  if (array.ndim() != 2 || array.shape(1) != 2) wrong_shape(argument, "(n, 2)", array);
  Ring ring(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t k = 0; k < ring.size(); ++k) ring[k] = {array.data()[2 * k], array.data()[2 * k + 1]};
  return ring;
}

// How deep sequences are nested, along their first items: 2 for a polygon.
int depth_of(const py::handle& object) {
  if (py::isinstance<py::array>(object)) return static_cast<int>(py::reinterpret_borrow<py::array>(object).ndim());
  if (!py::isinstance<py::sequence>(object) || py::isinstance<py::str>(object)) return 0;
  const auto sequence = py::reinterpret_borrow<py::sequence>(object);
  return sequence.empty() ? 1 : 1 + depth_of(sequence[0]);
}

}  // namespace

std::vector<PlanarPolygon> read_polygons(const py::handle& object, const char* argument) {
  const int depth = depth_of(object);
  if (depth == 0) throw py::type_error(std::string(argument) + ": must be a polygon, shape (n, 2), or a sequence of polygons");
  if (depth == 2) return {read_ring(object, argument)};
  std::vector<PlanarPolygon> polygons;
  for (const py::handle item : py::reinterpret_borrow<py::sequence>(object)) {
    if (depth_of(item) != 3) {
      polygons.emplace_back(read_ring(item, argument));
      continue;
    }
    std::vector<Ring> rings;
    for (const py::handle ring : py::reinterpret_borrow<py::sequence>(item)) rings.push_back(read_ring(ring, argument));
    Ring outer = std::move(rings.front());
    rings.erase(rings.begin());
    polygons.emplace_back(std::move(outer), std::move(rings));
  }
  return polygons;
}

std::vector<Triangle> read_triangles(const py::handle& object, const char* argument, std::size_t vertex_count) {
  const py::array raw = any_array(object, argument);
  if (raw.size() == 0) return {};
  if (raw.dtype().kind() == 'f') throw py::type_error(std::string(argument) + ": indices must be integers, not floats");
  if (raw.ndim() != 2 || raw.shape(1) != 3) wrong_shape(argument, "(m, 3)", raw);
  const auto array = converted<std::int64_t>(raw, argument);
  std::vector<Triangle> triangles(static_cast<std::size_t>(array.shape(0)));
  const std::int64_t* index = array.data();
  for (std::size_t row = 0; row < triangles.size(); ++row) {
    for (std::uint32_t& corner : triangles[row]) {
      if (*index < 0 || static_cast<std::uint64_t>(*index) >= vertex_count)
        throw py::value_error(std::string(argument) + ": row " + std::to_string(row) + " holds index " +
                              std::to_string(*index) + ", but there are " + std::to_string(vertex_count) + " vertices");
      corner = static_cast<std::uint32_t>(*index++);
    }
  }
  return triangles;
}

py::array view_points(const std::vector<Vec3>& points, const py::handle& owner) {
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(points.size()), 3};
  return read_only(py::array(py::dtype::of<double>(), shape, points.data(), owner));
}

py::array view_triangles(const std::vector<Triangle>& triangles, const py::handle& owner) {
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(triangles.size()), 3};
  return read_only(py::array(py::dtype::of<std::int32_t>(), shape, triangles.data(), owner));
}

py::array to_array(const Vec3& vector) { return py::array_t<double>(3, vector.data()); }

py::tuple to_tuple(const Box3& box) { return py::make_tuple(to_array(box.min()), to_array(box.max())); }

}  // namespace starcell::python
