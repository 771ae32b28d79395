// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace mir {

/// Width and height in luxels or pixels.
struct Extent {
    std::uint32_t width = 0;   ///< columns
    std::uint32_t height = 0;  ///< rows

    /// Width times height; cannot overflow.
    [[nodiscard]] constexpr std::uint64_t area() const { return std::uint64_t{width} * height; }
    /// Equal in both directions.
    friend constexpr bool operator==(Extent, Extent) = default;
};

}  // namespace mir
