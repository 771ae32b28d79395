// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace mirtool {

/// Seconds between two savings of passes, unless --save-every says.
inline constexpr double default_save_every = 10.0;

/// Tells when so many seconds have passed since the last time, or since it was made.
class Alarm {
 public:
    explicit Alarm(double seconds) : period_(seconds) {}

    [[nodiscard]] bool rings() {
        const auto now = Clock::now();
        if (std::chrono::duration<double>(now - last_).count() < period_) return false;
        last_ = now;
        return true;
    }

 private:
    using Clock = std::chrono::steady_clock;

    double period_;
    Clock::time_point last_ = Clock::now();
};

}  // namespace mirtool
