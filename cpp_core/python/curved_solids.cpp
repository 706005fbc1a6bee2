// Curved solids: Sphere, Ellipsoid, Cylinder, Cone, Torus, Quadric.
#include "arrays.h"
#include "bindings.h"

namespace starcell::python {
namespace {

// One Python class a kind; none adds state.
template <CurvedSolid::Kind>
struct CurvedKind : Expression {
  using Expression::Expression;
};

using SphereSolid = CurvedKind<CurvedSolid::Kind::sphere>;
using EllipsoidSolid = CurvedKind<CurvedSolid::Kind::ellipsoid>;
using CylinderSolid = CurvedKind<CurvedSolid::Kind::cylinder>;
using ConeSolid = CurvedKind<CurvedSolid::Kind::cone>;
using TorusSolid = CurvedKind<CurvedSolid::Kind::torus>;
using QuadricSolid = CurvedKind<CurvedSolid::Kind::quadric>;

EllipsoidSolid make_ellipsoid(const py::object& center, const py::object& semi_axes, const py::object& rotation) {
  const Eigen::Matrix3d axes = rotation.is_none() ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : read_matrix3(rotation, "rotation");
  return EllipsoidSolid(CurvedSolid::ellipsoid(read_vector(center, "center"), read_vector(semi_axes, "semi_axes"), axes));
}

}  // namespace

py::object wrap_curved(const CurvedSolidPtr& solid) {
  switch (solid->kind()) {
    case CurvedSolid::Kind::sphere: return py::cast(SphereSolid(solid));
    case CurvedSolid::Kind::ellipsoid: return py::cast(EllipsoidSolid(solid));
    case CurvedSolid::Kind::cylinder: return py::cast(CylinderSolid(solid));
    case CurvedSolid::Kind::cone: return py::cast(ConeSolid(solid));
    case CurvedSolid::Kind::torus: return py::cast(TorusSolid(solid));
    case CurvedSolid::Kind::quadric: return py::cast(QuadricSolid(solid));
  }
  return py::none();
}

void bind_curved_solids(py::module_& module) {
  py::class_<SphereSolid, Expression>(
      module, "Sphere",
      "A ball, exact: no tessellation. center: (3,), radius: > 0, model units. Raises ValueError for other values. Source: "
      "T§3.5.1, T§3.5.4.")
      .def(py::init([](const py::object& center, double radius) {
             return SphereSolid(CurvedSolid::sphere(read_vector(center, "center"), radius));
           }),
           py::arg("center"), py::arg("radius"), "center: (3,), radius: > 0, model units.");
  py::class_<EllipsoidSolid, Expression>(
      module, "Ellipsoid",
      "An ellipsoid, exact. center, semi_axes: (3,), model units, semi-axes > 0. rotation: (3, 3), body to world: its columns are "
      "the directions of the semi-axes, orthonormal to 1e-6; None: along the axes. Raises ValueError for other values. Source: "
      "T§3.12.1.")
      .def(py::init(&make_ellipsoid), py::arg("center"), py::arg("semi_axes"), py::arg("rotation") = py::none(),
           "center, semi_axes: (3,), model units; rotation: (3, 3) or None.");
  py::class_<CylinderSolid, Expression>(
      module, "Cylinder",
      "A round cylinder with flat ends, exact. base: (3,), centre of one end; axis: (3,), towards the other, any positive length; "
      "radius, height: > 0, model units. Raises ValueError for other values.")
      .def(py::init([](const py::object& base, const py::object& axis, double radius, double height) {
             return CylinderSolid(CurvedSolid::cylinder(read_vector(base, "base"), read_vector(axis, "axis"), radius, height));
           }),
           py::arg("base"), py::arg("axis"), py::arg("radius"), py::arg("height"), "base, axis: (3,); radius, height: > 0, model units.");
  py::class_<ConeSolid, Expression>(
      module, "Cone",
      "A round cone or frustum with flat ends, exact. base: (3,), centre of the first end; axis: (3,), towards the other, any "
      "positive length; radius1 at the base, radius2 at the top, >= 0 and not both 0; height: > 0; model units. Raises ValueError "
      "for other values.")
      .def(py::init([](const py::object& base, const py::object& axis, double radius1, double radius2, double height) {
             return ConeSolid(CurvedSolid::cone(read_vector(base, "base"), read_vector(axis, "axis"), radius1, radius2, height));
           }),
           py::arg("base"), py::arg("axis"), py::arg("radius1"), py::arg("radius2"), py::arg("height"),
           "base, axis: (3,); radius1, radius2: >= 0; height: > 0, model units.");
  py::class_<TorusSolid, Expression>(
      module, "Torus",
      "A ring torus, exact. center, axis: (3,); major: distance of the tube's centre line from the axis; minor: the tube's radius, "
      "0 < minor < major, model units. Raises ValueError for other values.")
      .def(py::init([](const py::object& center, const py::object& axis, double major, double minor) {
             return TorusSolid(CurvedSolid::torus(read_vector(center, "center"), read_vector(axis, "axis"), major, minor));
           }),
           py::arg("center"), py::arg("axis"), py::arg("major"), py::arg("minor"), "center, axis: (3,); 0 < minor < major, model units.");
  py::class_<QuadricSolid, Expression>(
      module, "Quadric",
      "Where a quadratic function is negative: {x : (x, 1) . m (x, 1) < 0}. matrix4x4: (4, 4), symmetric. Bounded only if it is an "
      "ellipsoid; others are usable inside a bounded expression. Raises ValueError for other values.")
      .def(py::init([](const py::object& matrix4x4) { return QuadricSolid(CurvedSolid::quadric(read_matrix4(matrix4x4, "matrix4x4"))); }),
           py::arg("matrix4x4"), "matrix4x4: (4, 4), symmetric.");
}

}  // namespace starcell::python
