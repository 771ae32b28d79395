// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace mir::validation::detail {

/// Count, mean and variance of a stream of numbers (Welford).
class Moments {
 public:
    void add(double x) {
        ++count_;
        const double delta = x - mean_;
        mean_ += delta / static_cast<double>(count_);
        squares_ += delta * (x - mean_);
    }
    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] double mean() const { return mean_; }
    /// Of one number, unbiased; needs two numbers.
    [[nodiscard]] double variance() const { return squares_ / static_cast<double>(count_ - 1); }
    /// Standard deviation of the mean.
    [[nodiscard]] double standard_error() const {
        return std::sqrt(variance() / static_cast<double>(count_));
    }

 private:
    std::uint64_t count_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

/// By how many standard deviations the mean of `m` misses `expected`, as a normal variable. It is
/// as unlikely as Student's t, made normal by Wallace, "Bounds on normal approximations to
/// Student's and the chi-square distributions", Ann. Math. Statist. 30, 1959. `rounding` is an
/// error of the mean that is no noise; it is added to the standard error. NaN when the mean is.
inline double deviation(const Moments& m, double expected, double rounding) {
    const double difference = m.mean() - expected;
    if (difference == 0.0) return 0.0;
    const double t = difference / std::hypot(m.standard_error(), rounding);
    const double n = static_cast<double>(m.count()) - 1.0;
    return (8.0 * n + 1.0) / (8.0 * n + 3.0) * std::sqrt(n * std::log1p(t * t / n));
}

}  // namespace mir::validation::detail
