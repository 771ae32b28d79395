// SPDX-License-Identifier: MIT
//
// The host's pool as mir sees it.
#pragma once

#include "thread_pool.hpp"

#include <mir/concepts/executor.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>

namespace host {

// region: executor
/// Loops on a pool. The caller works too, and returns when all bodies are done, whether or not the
/// pool ever came to help: so loops may be nested, and a pool that is busy elsewhere holds nothing
/// up. Model of mir::Executor; may be shared by threads.
class PoolExecutor {
 public:
    explicit PoolExecutor(ThreadPool& pool) : pool_(pool) {}

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        // Helpers that come late find no index left, when this function may have returned: what
        // they look at is theirs too.
        const auto loop = std::make_shared<Loop>(n);
        const auto work = [loop, &body] {
            for (std::size_t i = loop->next++; i < loop->size; i = loop->next++) {
                try {
                    if (!loop->failed) body(i);
                } catch (...) {
                    const std::lock_guard lock(loop->mutex);
                    if (!loop->failed.exchange(true)) loop->failure = std::current_exception();
                }
                loop->count_one();
            }
        };
        try {
            for (std::size_t k = 1; k < std::min(n, concurrency()); ++k) pool_.post(work);
        } catch (...) {
            // Helpers that were posted may run `body` already: go on with those, or alone.
        }
        work();
        loop->wait();
        if (loop->failure) std::rethrow_exception(loop->failure);
    }

    /// The threads of the pool and the caller.
    [[nodiscard]] std::size_t concurrency() const { return pool_.size() + 1; }

 private:
    struct Loop {
        explicit Loop(std::size_t n) : size(n) {}

        void count_one() {
            const std::lock_guard lock(mutex);
            if (++done == size) all_done.notify_all();
        }
        void wait() {
            std::unique_lock lock(mutex);
            all_done.wait(lock, [this] { return done == size; });
        }

        const std::size_t size;
        std::atomic<std::size_t> next{0};
        std::atomic<bool> failed{false};
        std::exception_ptr failure;
        std::size_t done = 0;
        std::mutex mutex;
        std::condition_variable all_done;
    };

    ThreadPool& pool_;
};
static_assert(mir::Executor<PoolExecutor>);
// endregion: executor

}  // namespace host
