// See interruptible.h. One mutex guards the hand-over; `cancelled` is read without it on the engine's hot path.
#include "interruptible.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "solids/errors.h"

namespace starcell::python {
namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;

constexpr auto signal_interval = std::chrono::milliseconds(50);
constexpr auto report_interval = std::chrono::milliseconds(40);

struct Report {
  double fraction;
  std::string stage;
};

class Desk {
 public:
  explicit Desk(bool wants_reports) : wants_reports_(wants_reports) {}

  /// Engine side: the Progress that the work calls.
  bool report(double fraction, const std::string& stage) {
    if (cancelled_) return false;
    if (!wants_reports_) return true;
    std::unique_lock lock(mutex_);
    const auto now = Clock::now();
    if (stage == last_stage_ && now < last_time_ + report_interval) return true;
    pending_ = Report{fraction, stage};
    changed_.notify_all();
    changed_.wait(lock, [&] { return !pending_; });
    last_stage_ = stage;
    last_time_ = Clock::now();
    return !cancelled_;
  }

  void finish() {
    const std::lock_guard lock(mutex_);
    finished_ = true;
    changed_.notify_all();
  }

  /// Caller side, without the GIL: waits for a report, the end, or the time to look for signals.
  std::optional<Report> wait() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, signal_interval, [&] { return pending_ || finished_; });
    return pending_;
  }

  void answer(bool go_on) {
    const std::lock_guard lock(mutex_);
    if (!go_on) cancelled_ = true;
    pending_.reset();
    changed_.notify_all();
  }

  bool finished() {
    const std::lock_guard lock(mutex_);
    return finished_;
  }

 private:
  const bool wants_reports_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> cancelled_ = false;
  bool finished_ = false;
  std::optional<Report> pending_;
  std::string last_stage_;
  Clock::time_point last_time_;
};

bool ask(const py::object& callback, const Report& report) {
  const py::object answer = callback(report.fraction, report.stage);
  return answer.is_none() || py::bool_(answer);
}

}  // namespace

void run_interruptible(const py::object& callback, const std::function<void(const Progress&)>& work) {
  const bool has_callback = !callback.is_none();
  // Asked once before the work begins, so that also a run too short to report can be refused.
  bool refused = has_callback && !ask(callback, {0.0, "start"});
  if (refused) throw CancelledError("The run was cancelled: the progress callback returned False.");

  Desk desk(has_callback);
  std::exception_ptr failure;    // of the work
  std::exception_ptr interrupt;  // of Python: a callback's exception or a signal's; outranks the work's
  std::thread worker([&] {
    try {
      work([&desk](double fraction, const std::string& stage) { return desk.report(fraction, stage); });
    } catch (...) {
      failure = std::current_exception();
    }
    desk.finish();
  });

  {
    const py::gil_scoped_release release;
    while (!desk.finished()) {
      const std::optional<Report> report = desk.wait();
      if (interrupt) {  // already cancelled: only the answer is still owed
        desk.answer(false);
        continue;
      }
      bool go_on = true;
      const py::gil_scoped_acquire acquire;
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (report) go_on = ask(callback, *report);
      } catch (...) {
        interrupt = std::current_exception();
        go_on = false;
      }
      if (!go_on) refused = true;
      if (report || !go_on) desk.answer(go_on);
    }
    worker.join();
  }
  if (interrupt) std::rethrow_exception(interrupt);
  if (failure) std::rethrow_exception(failure);
  if (refused) throw CancelledError("The run was cancelled: the progress callback returned False.");
}

}  // namespace starcell::python
