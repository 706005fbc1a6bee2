#include "run_operation.h"

#include <cmath>

namespace starcell::python {
namespace {

Criterion read_criterion(const std::string& name) {
  if (name == "trace") return Criterion::trace;
  if (name == "complex-cell") return Criterion::complex_cell;
  throw py::value_error("criterion: '" + name + "' is neither 'trace' nor 'complex-cell'");
}

}  // namespace

bool read_raises(const std::string& name) {
  if (name == "return") return false;
  if (name == "raise") return true;
  throw py::value_error("on_unresolved: '" + name + "' is neither 'return' nor 'raise'");
}

Options read_options(std::optional<double> error, std::optional<double> contact, const std::string& criterion, int threads,
                     const std::optional<Budget>& budget) {
  if (error && !(*error > 0)) throw py::value_error("error: must be greater than 0, infinite, or None");
  if (contact && !(*contact > 0 && std::isfinite(*contact)))
    throw py::value_error("contact: must be a finite number greater than 0, or None");
  if (error && contact && !(*contact < *error)) throw py::value_error("contact: must be smaller than error");
  if (threads < 0) throw py::value_error("threads: must not be negative; 0 takes all");
  Options options;
  options.error = error;
  options.contact = contact;
  options.criterion = read_criterion(criterion);
  options.threads = threads;
  if (budget) options.budget = *budget;
  return options;
}

}  // namespace starcell::python
