// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>

namespace mir {

/// Runs loops on oneTBB. Model of Executor; may be shared by threads.
class TbbExecutor {
 public:
    /// `threads` = 0 uses every core. Loops of so many `callers` at a time begin at once; those of
    /// more may wait for a thread.
    explicit TbbExecutor(unsigned threads = 0, unsigned callers = 1)
        : arena_(slots(threads, callers), callers), callers_(callers) {}

    /// Calls body(i) once for each i in [0, n), on the arena's threads. The order is free; it
    /// returns when all are done. An exception of a body reaches the caller; bodies that have not
    /// begun by then may be left out.
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        HandOver edge;
        edge.give();
        const TakeAtEnd bodies_are_done(edge);
        arena_.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 1),
                              [&](const tbb::blocked_range<std::size_t>& range) {
                                  edge.take();
                                  const GiveAtEnd body_is_done(edge);
                                  for (std::size_t i = range.begin(); i != range.end(); ++i)
                                      body(i);
                              });
        });
    }
    /// Threads of the arena, at least 1.
    [[nodiscard]] std::size_t concurrency() const {
        return static_cast<std::size_t>(arena_.max_concurrency()) - (callers_ - 1);
    }

 private:
    static int slots(unsigned threads, unsigned callers) {
        if (threads == 0 && callers == 1) return tbb::task_arena::automatic;
        const int cores =
            threads == 0 ? tbb::info::default_concurrency() : static_cast<int>(threads);
        return cores + static_cast<int>(callers) - 1;
    }

    /// Tells thread sanitizers how oneTBB orders caller and bodies. oneTBB orders the caller before
    /// the bodies and the bodies before the return, also when they throw. They cannot see into its
    /// binary.
    class HandOver {
     public:
        void give() { edge_.fetch_add(1, std::memory_order_release); }
        void take() const { static_cast<void>(edge_.load(std::memory_order_acquire)); }

     private:
        std::atomic<std::size_t> edge_{0};
    };
    class GiveAtEnd {
     public:
        explicit GiveAtEnd(HandOver& edge) : edge_(edge) {}
        GiveAtEnd(const GiveAtEnd&) = delete;
        GiveAtEnd& operator=(const GiveAtEnd&) = delete;
        ~GiveAtEnd() { edge_.give(); }

     private:
        HandOver& edge_;
    };
    class TakeAtEnd {
     public:
        explicit TakeAtEnd(const HandOver& edge) : edge_(edge) {}
        TakeAtEnd(const TakeAtEnd&) = delete;
        TakeAtEnd& operator=(const TakeAtEnd&) = delete;
        ~TakeAtEnd() { edge_.take(); }

     private:
        const HandOver& edge_;
    };

    tbb::task_arena arena_;
    unsigned callers_;
};

static_assert(Executor<TbbExecutor>);

}  // namespace mir
