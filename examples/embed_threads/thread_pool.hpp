// SPDX-License-Identifier: MIT
//
// The thread pool that was there before: a queue of jobs. It knows nothing of mir.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

namespace host {

/// Threads that run jobs in the order in which they came. Jobs must not throw.
class ThreadPool {
 public:
    explicit ThreadPool(std::size_t threads, std::size_t most_waiting = 1000)
        : most_waiting_(most_waiting) {
        for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
    }
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;
    ~ThreadPool() {
        {
            const std::lock_guard lock(mutex_);
            stop_ = true;
        }
        wake_.notify_all();
        for (std::thread& t : threads_) t.join();
    }

    /// @throws std::runtime_error when as many jobs wait as may.
    void post(std::function<void()> job) {
        {
            const std::lock_guard lock(mutex_);
            if (jobs_.size() >= most_waiting_) throw std::runtime_error("the pool is full");
            jobs_.push_back(std::move(job));
        }
        wake_.notify_one();
    }
    [[nodiscard]] std::size_t size() const { return threads_.size(); }

 private:
    void serve() {
        for (;;) {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
            if (jobs_.empty()) return;
            const std::function<void()> job = std::move(jobs_.front());
            jobs_.pop_front();
            lock.unlock();
            job();
        }
    }

    const std::size_t most_waiting_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> jobs_;
    bool stop_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace host
