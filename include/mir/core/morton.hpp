// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cstdint>

namespace mir {

namespace detail {

/// Interleaved bits of the cells of a point of the unit cube. Each axis has 2^bits cells.
MIR_HD inline std::uint64_t morton_code(Vec3 p, int bits) {
    const auto cells = static_cast<float>(1 << bits);
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell =
            static_cast<std::uint64_t>(smaller(larger(p[axis] * cells, 0.0f), cells - 1.0f));
        for (int b = 0; b < bits; ++b) code |= (cell >> b & 1u) << (3 * b + axis);
    }
    return code;
}

}  // namespace detail

/// Place of a point of the unit cube along Morton's curve, below 2^30. Points with similar codes
/// are close to each other, and mostly the other way round. Points outside are clamped. Source:
/// Morton 1966.
MIR_HD inline std::uint64_t morton_code(Vec3 p) { return detail::morton_code(p, 10); }

/// The same in cells of 2^-21, below 2^63.
MIR_HD inline std::uint64_t fine_morton_code(Vec3 p) { return detail::morton_code(p, 21); }

}  // namespace mir
