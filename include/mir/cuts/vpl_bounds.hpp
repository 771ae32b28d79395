// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <limits>

namespace mir {

/// Bounds of some VPLs: a box around their places, and their largest intensity.
struct VplBounds {
    Vec3 low{std::numeric_limits<float>::max()};      ///< least corner, metres
    Vec3 high{std::numeric_limits<float>::lowest()};  ///< largest corner, metres
    float most = 0.0f;                                ///< largest luminance of J, W sr^-1

    /// Bounds of both.
    [[nodiscard]] VplBounds with(const VplBounds& other) const {
        return {glm::min(low, other.low), glm::max(high, other.high), larger(most, other.most)};
    }
};

}  // namespace mir
