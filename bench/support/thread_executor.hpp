// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace mirbench {

/// Runs loops on threads of its own, which it keeps: the Executor of programs that have nothing but
/// the standard library. Threads take chunks from a counter, so that uneven bodies balance. A loop
/// inside a loop runs on the thread that asks for it. Model of Executor; may be shared by threads.
class ThreadExecutor {
 public:
    /// `threads` = 0 uses every core. The caller's thread is one of them.
    explicit ThreadExecutor(unsigned threads = 0);
    ThreadExecutor(const ThreadExecutor&) = delete;
    ThreadExecutor& operator=(const ThreadExecutor&) = delete;
    ~ThreadExecutor();

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        using Callable = std::remove_reference_t<Body>;
        Loop loop;
        loop.count = n;
        loop.grain = std::max<std::size_t>(1, n / (chunks_per_thread * concurrency()));
        // The loop gives back the type it was handed, constness included.
        loop.body = const_cast<void*>(  // NOLINT(cppcoreguidelines-pro-type-const-cast)
            static_cast<const void*>(&body));
        loop.run_chunk = [](void* b, std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) (*static_cast<Callable*>(b))(i);
        };
        run(loop);
    }
    [[nodiscard]] std::size_t concurrency() const { return workers_.size() + 1; }

 private:
    static constexpr std::size_t chunks_per_thread = 32;

    struct Loop {
        std::size_t count = 0;
        std::size_t grain = 1;
        void* body = nullptr;
        void (*run_chunk)(void*, std::size_t, std::size_t) = nullptr;
        std::atomic<std::size_t> next{0};
        std::mutex error_mutex;
        std::exception_ptr error;

        void take_chunks();
    };

    void run(Loop& loop);
    void work();

    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
    static inline thread_local bool is_in_loop = false;

    std::mutex one_loop_;
    Loop* loop_ = nullptr;
    bool stop_ = false;
    std::atomic<std::uint32_t> loops_{0};  ///< given so far; workers sleep on it
    std::atomic<std::size_t> busy_{0};     ///< workers that have not left the loop
    std::vector<std::thread> workers_;
};

inline ThreadExecutor::ThreadExecutor(unsigned threads) {
    const unsigned all = threads == 0 ? std::max(1u, std::thread::hardware_concurrency()) : threads;
    for (unsigned i = 1; i < all; ++i) workers_.emplace_back([this] { work(); });
}

inline ThreadExecutor::~ThreadExecutor() {
    stop_ = true;
    loops_.fetch_add(1);
    loops_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

inline void ThreadExecutor::Loop::take_chunks() {
    for (;;) {
        const std::size_t first = next.fetch_add(grain);
        if (first >= count) return;
        try {
            run_chunk(body, first, std::min(count, first + grain));
        } catch (...) {
            next.store(count);  // nobody takes more
            const std::lock_guard lock(error_mutex);
            if (!error) error = std::current_exception();
        }
    }
}

inline void ThreadExecutor::run(Loop& loop) {
    if (is_in_loop || workers_.empty()) {
        loop.take_chunks();
    } else {
        const std::lock_guard lock(one_loop_);
        is_in_loop = true;
        loop_ = &loop;
        busy_.store(workers_.size());
        loops_.fetch_add(1);
        loops_.notify_all();
        loop.take_chunks();
        for (std::size_t busy = busy_.load(); busy != 0; busy = busy_.load()) busy_.wait(busy);
        is_in_loop = false;
    }
    if (loop.error) std::rethrow_exception(loop.error);
}

inline void ThreadExecutor::work() {
    is_in_loop = true;
    for (std::uint32_t seen = 0;; ++seen) {
        loops_.wait(seen);
        if (stop_) return;
        loop_->take_chunks();
        if (busy_.fetch_sub(1) == 1) busy_.notify_all();
    }
}

static_assert(mir::Executor<ThreadExecutor>);

}  // namespace mirbench
