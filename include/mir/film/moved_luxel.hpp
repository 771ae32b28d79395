// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cstdint>

namespace mir {

/// Place of a pixel's only luxel in pass `pass` of a progressive render, (0, 1)^2. The same in all
/// pixels: `first`, which is in (0, 1)^2 too, in the first pass, then the points of a sequence that
/// fills the pixel evenly, however many passes there are. So the mean over passes sees edges as
/// many luxels of one pass would. Source: Roberts, "The Unreasonable Effectiveness of Quasirandom
/// Sequences", 2018 (R2).
constexpr Vec2 moved_luxel(Vec2 first, std::uint64_t pass) {
    if (pass == 0) return first;
    // Multiples of the inverse of the plastic number and of its square, as fractions of 2^32. The
    // upper 16 bits count, so that no luxel lies on a border.
    constexpr std::uint32_t alpha_x = 3242174889u;
    constexpr std::uint32_t alpha_y = 2447445414u;
    const auto place = [pass](float from, std::uint32_t alpha) {
        const std::uint32_t at = static_cast<std::uint32_t>(double{from} * 0x1p32) +
                                 static_cast<std::uint32_t>(pass) * alpha;
        return (static_cast<float>(at >> 16) + 0.5f) * 0x1p-16f;
    };
    return {place(first.x, alpha_x), place(first.y, alpha_y)};
}

}  // namespace mir
