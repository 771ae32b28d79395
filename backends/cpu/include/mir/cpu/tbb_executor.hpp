// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>

namespace mir::cpu {

/// Runs loops on oneTBB. Model of Executor; may be shared by threads.
class TbbExecutor {
 public:
    /// `threads` = 0 uses every core.
    explicit TbbExecutor(unsigned threads = 0)
        : arena_(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads)) {}

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        // oneTBB orders the caller before the bodies and the bodies before the return. Thread
        // sanitizers cannot see into its binary; the counter tells them the same.
        std::atomic<std::size_t> edge{0};
        edge.store(1, std::memory_order_release);
        arena_.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 1),
                              [&](const tbb::blocked_range<std::size_t>& range) {
                                  static_cast<void>(edge.load(std::memory_order_acquire));
                                  for (std::size_t i = range.begin(); i != range.end(); ++i)
                                      body(i);
                                  edge.fetch_add(1, std::memory_order_release);
                              });
        });
        static_cast<void>(edge.load(std::memory_order_acquire));
    }
    [[nodiscard]] std::size_t concurrency() const {
        return static_cast<std::size_t>(arena_.max_concurrency());
    }

 private:
    tbb::task_arena arena_;
};

static_assert(Executor<TbbExecutor>);

}  // namespace mir::cpu
