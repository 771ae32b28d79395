// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/monitor.hpp"

namespace mir {

/// Runs loops on another Executor and asks before every body whether to go on, so that each stage
/// of a render can be cancelled without knowing about it. Model of Executor; both references must
/// outlive it.
template <Executor E>
class CancellableExecutor {
 public:
    /// `monitor` may be null: then nothing is ever cancelled.
    CancellableExecutor(E& executor, const Monitor* monitor)
        : executor_(executor), monitor_(monitor) {}

    /// @throws Error(cancelled), besides what the bodies throw.
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        executor_.for_each(n, [&](std::size_t i) {
            if (monitor_ != nullptr) monitor_->check();
            body(i);
        });
    }
    /// That of the executor beneath.
    [[nodiscard]] std::size_t concurrency() const { return executor_.concurrency(); }

 private:
    E& executor_;
    const Monitor* monitor_;
};

}  // namespace mir
