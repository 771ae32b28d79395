// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cstdint>

namespace mir {

/// What a ray met.
struct TriangleHit {
    static constexpr std::uint32_t none = 0xFFFFFFFFu;  ///< no index: nothing was met

    float t = 1.0f;                 ///< along the segment, 0 at its start and 1 at its end
    Vec2 barycentrics{0};           ///< weights of the second and third corner
    std::uint32_t triangle = none;  ///< index, or `none`
    bool by_edge = false;           ///< so near an edge that rounding may have decided
};

}  // namespace mir
