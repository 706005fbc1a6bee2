// What the bindings of all operations share: their options as Python gives them, and a run that Python can watch and end.
#pragma once

#include <pybind11/stl.h>

#include "bindings.h"
#include "interruptible.h"
#include "operations/options.h"

namespace starcell::python {

/// Raises ValueError, which names the argument.
Options read_options(std::optional<double> error, std::optional<double> contact, const std::string& criterion, int threads,
                     const std::optional<Budget>& budget);
bool read_raises(const std::string& on_unresolved);

/// Runs one operation and hands its record over: `run` takes the options, with a progress that asks Python.
template <class Record = ResultRecord, class Run>
py::object run_operation(Options options, const py::object& progress, const std::string& on_unresolved, const Run& run) {
  const bool raises = read_raises(on_unresolved);
  if (!progress.is_none() && !PyCallable_Check(progress.ptr())) throw py::type_error("progress: must be callable, or None");
  const auto record = std::make_shared<Record>();
  record->error = options.error;
  record->contact = options.contact;
  run_interruptible(progress, [&](const Progress& report) {
    options.progress = report;
    run(options, *record);
  });
  const Certificate& certificate = record->result.certificate;
  py::object object = py::cast(record);
  if (certificate.verdict == Verdict::unresolved && raises) raise_unresolved(object, certificate);
  return object;
}

}  // namespace starcell::python
