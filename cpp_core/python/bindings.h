// What the bindings of the module `starcell` share: one bind_* function a concept, and the Python face of a solid.
//
// Python's Solid is the core's Expression itself, so other modules (starcell_cad) can return one without knowing these
// files. Its Python subclasses add no state; wrap() picks the subclass that fits.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// Python's Result: the core's, with what its certificate's file has to say beside it.
struct ResultRecord {
  Result result;
  std::optional<Expression> expression;  ///< none: the operation is no Boolean
  std::optional<double> error;           ///< as asked for
  std::optional<double> contact;
  std::vector<std::pair<std::string, Box3>> findings{};  ///< what repair() found wrong, and where
};

/// Python's Certificate. Keeps the record, and so the mesh and the operands, for save().
struct CertificateHandle {
  std::shared_ptr<const ResultRecord> record;
  const Certificate& get() const { return record->result.certificate; }
};

struct HalfSpaceSolid : Expression {
  using Expression::Expression;
};

/// The expression as the most special Python class: Polyhedron, HalfSpace, Sphere, ..., or Solid.
py::object wrap(const Expression& expression);
py::object wrap_curved(const CurvedSolidPtr& solid);

void bind_exceptions(py::module_& module);
void bind_solids(py::module_& module);
void bind_curved_solids(py::module_& module);
void bind_expressions(py::class_<Expression>& solid, py::module_& module);
void bind_certificate(py::module_& module);
void bind_operations(py::module_& module);
void bind_configuration_space(py::module_& module);
void bind_inspection(py::module_& module);
void bind_penetration_depth(py::module_& module);

/// Raises UnresolvedError with the result as its attribute.
[[noreturn]] void raise_unresolved(const py::object& result, const Certificate& certificate);

}  // namespace starcell::python
