// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <limits>

namespace mir {

/// Axis-aligned box. Empty until a point is added.
struct Bounds {
    Vec3 low{std::numeric_limits<float>::infinity()};    ///< smallest coordinates, metres
    Vec3 high{-std::numeric_limits<float>::infinity()};  ///< largest coordinates, metres

    /// Grows to hold `p`.
    void add(Vec3 p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    /// True until a point is added.
    [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
    /// Middle of the box; NaN when empty.
    [[nodiscard]] Vec3 centre() const { return 0.5f * (low + high); }
    /// Length from corner to corner; 0 when empty.
    [[nodiscard]] float diagonal() const { return empty() ? 0.0f : glm::length(high - low); }
};

}  // namespace mir
