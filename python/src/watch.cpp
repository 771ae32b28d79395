// SPDX-License-Identifier: MIT
#include "watch.hpp"

#include "mir/runtime/render_pace.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace nb = nanobind;

namespace mirpy {
namespace {

using Clock = std::chrono::steady_clock;

/// A thread that does one thing, and its end.
class Worker {
 public:
    explicit Worker(const std::function<void()>& work) : thread_([this, &work] { run(work); }) {}

    /// Waits for the end, but no longer than so; true when it has come.
    [[nodiscard]] bool ends_within(std::chrono::milliseconds time) {
        std::unique_lock lock(mutex_);
        return ended_.wait_for(lock, time, [this] { return is_done_; });
    }
    /// Waits for the end.
    /// @throws What the work threw.
    void finish() {
        thread_.join();
        if (failure_) std::rethrow_exception(failure_);
    }

 private:
    void run(const std::function<void()>& work) {
        try {
            work();
        } catch (...) {
            failure_ = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        is_done_ = true;
        ended_.notify_one();
    }

    std::exception_ptr failure_;
    bool is_done_ = false;
    std::mutex mutex_;
    std::condition_variable ended_;
    std::thread thread_;
};

/// Tells Python how far a render is.
class Teller {
 public:
    Teller(const mir::Monitor& monitor, nb::handle progress)
        : monitor_(monitor), progress_(progress) {}

    /// @throws nb::python_error for signals and what the callback raises.
    void tell(bool done) {
        if (PyErr_CheckSignals() != 0) nb::raise_python_error();
        if (progress_.is_none()) return;
        if (monitor_.passes != told_.passes) pace_ = {};
        const mir::RenderWork work = mir::work_of(monitor_);
        told_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        pace_.look(work, told_.seconds);
        told_.stage = work.stage != nullptr ? work.stage : "preparing";
        told_.share = done ? 1.0 : work.unit_share();
        told_.seconds_left = done ? 0.0 : pace_.seconds_left();
        told_.passes = monitor_.passes;
        told_.done = done;
        progress_(told_);
    }

 private:
    const mir::Monitor& monitor_;
    nb::handle progress_;
    mir::RenderPace pace_;
    PyProgress told_;
    Clock::time_point start_ = Clock::now();
};

}  // namespace

void watched(mir::Monitor& monitor, nb::handle progress, const std::function<void()>& work) {
    Teller teller(monitor, progress);
    Worker worker(work);
    const auto has_ended = [&worker] {
        const nb::gil_scoped_release release;
        return worker.ends_within(std::chrono::milliseconds(100));
    };
    std::exception_ptr raised;
    while (!has_ended()) {
        if (raised) continue;
        try {
            teller.tell(false);
        } catch (...) {
            raised = std::current_exception();
            monitor.cancelled = true;
        }
    }
    if (!raised) {
        worker.finish();
        return teller.tell(true);
    }
    try {
        worker.finish();
    } catch (const mir::Error&) {
        // That it was cancelled is no news.
    }
    std::rethrow_exception(raised);
}

void bind_watch(nb::module_& m) {
    nb::class_<PyProgress>(m, "Progress", "How far a render is; what progress callbacks get.")
        .def_ro("stage", &PyProgress::stage, "What is done at present.")
        .def_ro("share", &PyProgress::share, "Of the pass, 0..1; None where it is not known.")
        .def_ro("seconds", &PyProgress::seconds, "Since it began.")
        .def_ro("seconds_left", &PyProgress::seconds_left,
                "Of the pass; None where it cannot be told.")
        .def_ro("passes", &PyProgress::passes, "Passes that are done.")
        .def_ro("done", &PyProgress::done, "True at the last call.");
}

}  // namespace mirpy
