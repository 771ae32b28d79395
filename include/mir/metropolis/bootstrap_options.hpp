// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mir {

/// How exactly P_c is to be known, and at what cost.
struct BootstrapOptions {
    /// Standard error of P_c asked for, over P_c. 0: what the number of VPLs deserves, so that the
    /// bootstrap costs no more beside the chains where light is rare.
    double relative_error = 0.0;
    std::uint64_t min_paths = 1u << 14;  ///< always drawn, > 0
    std::uint64_t max_paths = 1u << 22;  ///< never passed

    /// The same with the relative error that `states` recorded states deserve unless one was asked
    /// for: about a tenth of the error that so many VPLs leave in a picture (docs/convergence.md),
    /// and never so large that the picture would be called badly scaled.
    [[nodiscard]] BootstrapOptions for_states(std::uint32_t states) const {
        BootstrapOptions o = *this;
        if (o.relative_error == 0.0)
            o.relative_error = std::min(0.05, 0.8 / std::sqrt(static_cast<double>(states)));
        return o;
    }
};

}  // namespace mir
