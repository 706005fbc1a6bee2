// The exceptions of the module: every core error under starcell.Error; std::invalid_argument is pybind11's ValueError.
#include "bindings.h"
#include "solids/errors.h"

namespace starcell::python {
namespace {

/// The module owns the type; the translators and raise_unresolved() borrow it for the life of the interpreter.
template <class Exception>
py::handle add(py::module_& module, const char* name, const py::handle& base, const char* doc) {
  py::handle type = py::register_exception<Exception>(module, name, base);
  type.attr("__doc__") = doc;
  return type;
}

PyObject* unresolved_error = nullptr;

}  // namespace

void bind_exceptions(py::module_& module) {
  // The translator registered last is asked first, so the base comes first.
  const py::handle base = add<Error>(
      module, "Error", PyExc_Exception,
      "Base of StarCell's own errors. Each message says what, where, how many and what to do; lengths and places are in "
      "model units. Wrong arguments raise ValueError or TypeError instead.");
  add<InvalidSolidError>(
      module, "InvalidSolidError", base,
      "The input is no closed, oriented, embedded 2-manifold. The message counts open edges, non-manifold edges and "
      "vertices, self-intersections and values that are not finite, and places the first of each in model units.");
  add<UnboundedError>(
      module, "UnboundedError", base,
      "The expression has no bounded result, such as a half-space alone: it has no bounding box in model units.");
  add<CancelledError>(module, "CancelledError", base,
                      "The progress callback returned False. Nothing was returned; operands (of any shape) are unchanged.");
  add<FileError>(module, "FileError", base,
                 "A file cannot be read or written; the message names the file, the place and the reason (units: none).");

  unresolved_error = PyErr_NewExceptionWithDoc(
      "starcell.UnresolvedError",
      "A budget ran out and the call asked for on_unresolved=\"raise\". The attribute `result` is the Result, in model "
      "units, whose certificate lists the open cells as boxes of shape ((3,), (3,)).",
      base.ptr(), nullptr);
  if (!unresolved_error) throw py::error_already_set();
  module.add_object("UnresolvedError", py::reinterpret_steal<py::object>(unresolved_error));
}

void raise_unresolved(const py::object& result, const Certificate& certificate) {
  const std::string message =
      std::to_string(certificate.unresolved.size()) +
      " cells are unresolved: the budget ran out. Raise the budget or the error; the result so far is in `.result`.";
  py::object error = py::handle(unresolved_error)(message);
  error.attr("result") = result;
  PyErr_SetObject(unresolved_error, error.ptr());
  throw py::error_already_set();
}

}  // namespace starcell::python
