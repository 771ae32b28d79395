// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mir {

/// How exactly P_c is to be known, and at what cost.
struct BootstrapOptions {
    /// Standard error of P_c asked for, over P_c. 0: what the number of chains deserves.
    double relative_error = 0.0;
    std::uint64_t min_paths = 1u << 14;  ///< always drawn, > 0
    std::uint64_t max_paths = 1u << 22;  ///< never passed

    /// The same with the relative error that `starts` chains deserve, unless one was asked for.
    /// Starts are drawn from as many paths, in effect, as 1 / error^2, and some are drawn twice:
    /// the variance of the VPLs' light grows by 1 + starts error^2, which is kept at 1.33
    /// (docs/decisions/046).
    [[nodiscard]] BootstrapOptions for_starts(std::uint32_t starts) const {
        BootstrapOptions o = *this;
        if (o.relative_error == 0.0) o.relative_error = std::min(0.05, std::sqrt(0.33 / starts));
        return o;
    }

    /// Chains to start when the paths know P_c to a relative `error`. There are at most `wanted`.
    /// As many as are wanted when that is what was asked for; else as many as deserve no less, but
    /// some hundred at least: where starts would come many times, mutations are worth more.
    [[nodiscard]] std::uint32_t starts_at(double error, std::uint32_t wanted) const {
        constexpr double fewest = 256.0;
        if (error <= for_starts(wanted).relative_error) return wanted;
        const double deserved = std::max(fewest, 0.33 / (error * error));
        return deserved < wanted ? static_cast<std::uint32_t>(deserved) : wanted;
    }
};

}  // namespace mir
