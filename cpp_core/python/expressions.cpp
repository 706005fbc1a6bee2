// Boolean operators on solids, and the n-ary union() and intersection().
#include <pybind11/stl.h>

#include "bindings.h"

namespace starcell::python {

void bind_expressions(py::class_<Expression>& solid, py::module_& module) {
  // is_operator: what is no Solid makes Python raise TypeError after asking the other operand.
  solid
      .def(
          "__or__",
          [](const Expression& a, const Expression& b) {
            return wrap(Expression::set_union({a, b}));
          },
          py::is_operator(),
          "a | b: the regularised union of two Solids, model units. Nothing is computed until evaluate().")
      .def(
          "__and__",
          [](const Expression& a, const Expression& b) {
            return wrap(Expression::intersection({a, b}));
          },
          py::is_operator(), "a & b: the regularised intersection of two Solids, model units.")
      .def(
          "__sub__", [](const Expression& a, const Expression& b) { return wrap(Expression::difference(a, b)); },
          py::is_operator(), "a - b: the regularised difference of two Solids, model units.")
      .def(
          "__invert__", [](const Expression& a) { return wrap(a.complement()); },
          "~a: everything outside a, model units. Unbounded, so only usable inside a bounded expression.");

  module.def(
      "union", [](const std::vector<Expression>& solids) { return wrap(Expression::set_union(solids)); }, py::arg("solids"),
      "The union of one or more Solids (a sequence of any length, model units) as one n-ary expression: cheaper than a "
      "chain "
      "of pairs. Raises ValueError for an empty sequence, TypeError for what is no Solid. Source: T§3.10.2.");
  module.def(
      "intersection", [](const std::vector<Expression>& solids) { return wrap(Expression::intersection(solids)); },
      py::arg("solids"),
      "The intersection of one or more Solids (a sequence of any length, model units) as one n-ary expression. Raises "
      "ValueError for an empty sequence, TypeError for what is no Solid. Source: T§3.10.2.");
}

}  // namespace starcell::python
