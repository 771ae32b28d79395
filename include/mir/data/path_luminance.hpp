// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cmath>
#include <cstdint>
#include <span>

namespace mir {

/// An estimate of P_c, the chain's mean image luminance, W m^-2 sr^-1.
struct PathLuminance {
    double mean = 0.0;               ///< W m^-2 sr^-1
    double standard_error = 0.0;     ///< of the mean, in the same unit; 0 for fewer than two paths
    std::uint64_t paths = 0;         ///< drawn, those without light included
    std::uint64_t contributing = 0;  ///< drawn, those with light

    /// Standard error over mean; 0 without light.
    [[nodiscard]] double relative_error() const { return mean > 0.0 ? standard_error / mean : 0.0; }
    /// Ends of the 95 % confidence interval.
    [[nodiscard]] double low() const { return mean - 1.96 * standard_error; }
    /// The upper end.
    [[nodiscard]] double high() const { return mean + 1.96 * standard_error; }
};

/// Independent weights Y(F)/p whose mean is P_c, added one by one without keeping them. Source:
/// Welford 1962; Chan, Golub, LeVeque 1979 for sums of parts.
class WeightMoments {
 public:
    /// Weights are finite and not negative.
    MIR_HD void add(double weight) {
        contributing_ += weight > 0.0 ? 1 : 0;
        const double delta = weight - mean_;
        mean_ += delta / static_cast<double>(++count_);
        squares_ += delta * (weight - mean_);
    }
    /// Adds all that `other` has seen.
    void add(const WeightMoments& other) {
        if (other.count_ == 0) return;
        const auto a = static_cast<double>(count_);
        const auto b = static_cast<double>(other.count_);
        const double delta = other.mean_ - mean_;
        mean_ += delta * (b / (a + b));
        squares_ += other.squares_ + delta * delta * (a * b / (a + b));
        count_ += other.count_;
        contributing_ += other.contributing_;
    }

    /// What they say about P_c.
    [[nodiscard]] PathLuminance estimate() const {
        PathLuminance p{mean_, 0.0, count_, contributing_};
        const auto n = static_cast<double>(count_);
        if (count_ > 1) p.standard_error = std::sqrt(squares_ / (n - 1.0) / n);
        return p;
    }

 private:
    std::uint64_t count_ = 0;
    std::uint64_t contributing_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

/// The estimate from weights in the order given.
inline PathLuminance path_luminance(std::span<const double> weights) {
    WeightMoments moments;
    for (double w : weights) moments.add(w);
    return moments.estimate();
}

}  // namespace mir
