// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/monitor.hpp"

namespace mir {

/// Runs loops on another Executor that can be watched and stopped. It asks before every body
/// whether to go on, and counts it after, so that no stage of a render has to know about that.
/// Model of Executor; both references must outlive it.
template <Executor E>
class CancellableExecutor {
 public:
    /// `monitor` may be null: then nothing is counted or cancelled.
    CancellableExecutor(E& executor, Monitor* monitor) : executor_(executor), monitor_(monitor) {}

    /// @throws Error(cancelled), besides what the bodies throw.
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        if (monitor_ == nullptr) return executor_.for_each(n, body);
        monitor_->begin_loop(n);
        executor_.for_each(n, [&](std::size_t i) {
            monitor_->check();
            body(i);
            monitor_->blocks.fetch_add(1, std::memory_order_relaxed);
        });
    }
    /// That of the executor beneath.
    [[nodiscard]] std::size_t concurrency() const { return executor_.concurrency(); }

 private:
    E& executor_;
    Monitor* monitor_;
};

}  // namespace mir
