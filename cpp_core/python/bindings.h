// What the bindings of the module `starcell` share: one bind_* function a concept, and the Python face of a solid.
//
// Python's Solid is the core's Expression itself, so other modules (starcell_cad) can return one without knowing these
// files. Its Python subclasses add no state; wrap() picks the subclass that fits.
#pragma once

#include <pybind11/pybind11.h>

#include "expression/expression.h"
#include "operations/boolean.h"

namespace starcell::python {

namespace py = pybind11;

struct PolyhedronSolid : Expression {
  explicit PolyhedronSolid(PolyhedronPtr solid) : Expression(std::move(solid)) {}
};

struct BoxSolid : PolyhedronSolid {
  using PolyhedronSolid::PolyhedronSolid;
};

struct HalfSpaceSolid : Expression {
  using Expression::Expression;
};

/// The expression as the most special Python class: Polyhedron, HalfSpace, or Solid.
py::object wrap(const Expression& expression);

void bind_exceptions(py::module_& module);
void bind_solids(py::module_& module);
void bind_expressions(py::class_<Expression>& solid, py::module_& module);
void bind_certificate(py::module_& module);
void bind_operations(py::module_& module);

/// Raises UnresolvedError with the result as its attribute.
[[noreturn]] void raise_unresolved(const py::object& result, const Certificate& certificate);

}  // namespace starcell::python
