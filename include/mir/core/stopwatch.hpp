// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace mir {

/// Adds the wall time of its own life to a counter, in seconds.
class Stopwatch {
 public:
    /// Starts. `seconds` must outlive it.
    explicit Stopwatch(double& seconds) : seconds_(seconds) {}
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_ = Clock::now();
};

}  // namespace mir
