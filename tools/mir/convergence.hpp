// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/pass_sums.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace mirtool {

/// How near a picture of several passes is, after some of them.
struct ConvergencePoint {
    std::uint32_t passes = 0;
    std::uint32_t vpls = 0;              ///< of all these passes; 0 where none are placed
    double seconds = 0.0;                ///< of rendering, all these passes
    std::optional<double> spread_error;  ///< PassSums::relative_error()
    /// Root of the mean square difference of luminance from the reference, over its mean luminance.
    /// What spread_error estimates, and the bias.
    std::optional<double> reference_error;
};

/// Remembers how a picture converges. Every pass up to 16, then passes that are a tenth more than
/// the last one looked at, and the last of all.
class Convergence {
 public:
    /// `reference`, which may be empty, must outlive it.
    explicit Convergence(const mir::Image<mir::Rgb>& reference) : reference_(reference) {}

    /// Looks at the passes so far, none or more. `last`: no more will come.
    void look_at(const mir::PassSums& sums, bool last);

    /// In the order of their passes. Of a resumed picture, none before it was resumed.
    [[nodiscard]] const std::vector<ConvergencePoint>& points() const { return points_; }

 private:
    const mir::Image<mir::Rgb>& reference_;
    std::vector<ConvergencePoint> points_;
};

}  // namespace mirtool
