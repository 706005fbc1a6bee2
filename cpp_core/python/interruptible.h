// Runs long core work so that Python stays responsive: progress callbacks, their exceptions, and Ctrl-C.
//
// The work runs on a thread of its own without the GIL; the calling thread waits, looks for signals (which Python only
// delivers to its main thread) and makes the callbacks. So no engine thread ever takes the GIL, and none can deadlock on
// it. A callback blocks the one engine thread that reports, so an answer of False is never overtaken by the end.
// Guarantees: a cancelled run has ended before this returns. How soon that is, is up to how often the work reports.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "operations/options.h"

namespace starcell::python {

/// Calls work(progress). `callback` is None or callable(fraction, stage) -> bool; None as an
/// answer means go on. Throws what work throws, CancelledError after False, the callback's own exception after one.
void run_interruptible(const pybind11::object& callback, const std::function<void(const Progress&)>& work);

}  // namespace starcell::python
