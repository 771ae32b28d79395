// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cmath>

namespace mir {

/// Sizes of runs of neighbouring luxels: whether each keeps to one surface. It decides speed
/// alone.
struct RunSizes {
    float count = 0.0f;     ///< runs that are no points
    float sum = 0.0f;       ///< of their diagonals, metres
    float inverses = 0.0f;  ///< of the same, 1 / metres

    /// Adds a run by the diagonal of its box, metres.
    MIR_HD void add(float diagonal) {
        if (!(diagonal > 0.0f)) return;
        count += 1.0f;
        sum += diagonal;
        inverses += 1.0f / diagonal;
    }
    /// False when some runs reach from one surface to another. If they are few, their arithmetic
    /// mean is much larger than the harmonic one; if they are many, it is larger than for a square
    /// that is cut into n squares, which are 1 / sqrt(n) as wide. `diagonal` is that of the box
    /// around all runs, metres. What is no number counts as compact.
    [[nodiscard]] MIR_HD bool are_compact(float diagonal) const {
        // Looser bounds find fewer edges, stricter ones move luxels for nothing
        // (docs/decisions/002).
        constexpr float looseness = 1.5f;
        return !(sum * inverses > looseness * count * count ||
                 sum > looseness * diagonal * sqrtf(count));
    }
};

}  // namespace mir
