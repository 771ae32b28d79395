// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstddef>
#include <cstdint>

namespace mir::detail {

/// Taps [begin, end) (TapTable).
struct TapRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    [[nodiscard]] MIR_HD bool holds(std::uint32_t tap) const { return begin <= tap && tap < end; }
};

/// What kernels read of a TapTable. A view; thread-safe.
struct TapView {
    // Straight lines between points h apart are off by at most h^2 / 8 max|f''|: 3e-8 for the
    // default filter, less than the rounding of its own arithmetic. Luxels at pixel centres meet a
    // point, so that zeros there stay exact.
    static constexpr std::int32_t intervals = 4096;

    std::uint32_t reach = 0;
    float half_width = 0.0f;           ///< of a box, pixels
    const float* curves = nullptr;     ///< of each tap; null for a box
    const TapRange* ranges = nullptr;  ///< of cell columns, then of cell rows
    std::uint32_t columns = 0;         ///< of cells

    /// The taps of cell column `cx` that a luxel can reach. All others have weight zero.
    [[nodiscard]] MIR_HD TapRange x(std::uint32_t cx) const { return ranges[cx]; }
    /// The same along y.
    [[nodiscard]] MIR_HD TapRange y(std::uint32_t cy) const { return ranges[columns + cy]; }

    /// Weight for `tap` of a luxel at `offset` in (0, 1) in its pixel.
    [[nodiscard]] MIR_HD double weight(std::uint32_t tap, float offset) const {
        if (curves == nullptr) return box_weight(offset - 0.5f + shift(reach, tap), half_width);
        return on_curve(curve(tap), offset);
    }
    /// Weights of a tap over offsets from 0 to 1.
    [[nodiscard]] MIR_HD const float* curve(std::uint32_t tap) const {
        return curves + std::size_t{tap} * (intervals + 1);
    }

    /// Filter::along() of a box.
    MIR_HD static double box_weight(float d, float half_width) {
        const float distance = d < 0.0f ? -d : d;
        return distance < half_width ? 1.0 : distance == half_width ? 0.5 : 0.0;
    }
    MIR_HD static double on_curve(const float* curve, float offset) {
        const float at = offset * float{intervals};
        const auto node = static_cast<std::int32_t>(at);
        const float left = curve[node], right = curve[node + 1];
        return static_cast<double>(left + (at - static_cast<float>(node)) * (right - left));
    }
    /// From a pixel's centre to that of the tap's pixel, towards the luxel.
    MIR_HD static float shift(std::uint32_t reach, std::uint32_t tap) {
        return static_cast<float>(reach) - static_cast<float>(tap);
    }
};

}  // namespace mir::detail
