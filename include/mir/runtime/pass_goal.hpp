// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace mir {

/// Most passes of a progressive render.
inline constexpr std::uint32_t max_passes = 1'000'000;

/// When a progressive render ends: whatever is reached first. Looked at between passes: none is
/// ever cut, and there is always one.
struct PassGoal {
    std::uint32_t passes = 1;                                  ///< 1..max_passes
    double seconds = std::numeric_limits<double>::infinity();  ///< wall time from the start on
    double relative_error = 0.0;  ///< PassSums::relative_error(), from two passes on; 0: no goal

    /// @throws Error(invalid_argument) that names the first bad value.
    void validate() const {
        expects(passes >= 1 && passes <= max_passes,
                "the passes of a progressive render must be 1 to 1000000");
        expects(seconds > 0.0, "the time of a progressive render must be positive (in seconds)");
        expects(relative_error >= 0.0 && std::isfinite(relative_error),
                "the target error must be positive and finite; 0.01 means one percent");
        expects(relative_error == 0.0 || passes >= 2,
                "a target error and a single pass were asked for (the error is known from the "
                "spread of the passes, at least two of them); ask for more passes or leave their "
                "number out");
    }

    /// True when a render that has got so far may end.
    [[nodiscard]] bool is_reached(std::uint32_t done, double elapsed,
                                  std::optional<double> error) const {
        if (done == 0) return false;
        return done >= passes || elapsed >= seconds ||
               (relative_error > 0.0 && error && *error <= relative_error);
    }
};

}  // namespace mir
