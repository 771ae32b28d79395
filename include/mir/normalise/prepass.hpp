// SPDX-License-Identifier: MIT
#pragma once

#include "mir/normalise/response.hpp"

#include <span>

namespace mir {

/// Luxels of a prepass that must be lit before their mean is trusted. With fewer the quotient R / S
/// is badly biased, without any it has no meaning.
inline constexpr std::uint64_t min_lit_luxels = 64;

/// VPLs that light too few luxels of a prepass; their responses need the whole image.
inline std::vector<VplIndex> poorly_measured(std::span<const ImageResponse> responses) {
    std::vector<VplIndex> poor;
    for (VplIndex j = 0; j < responses.size(); ++j)
        if (responses[j].lit_luxels < min_lit_luxels) poor.push_back(j);
    return poor;
}

}  // namespace mir
