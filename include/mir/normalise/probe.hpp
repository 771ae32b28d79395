// SPDX-License-Identifier: MIT
#pragma once

#include "mir/normalise/response.hpp"

#include <span>

namespace mir {

/// Luxels that must be lit before a mean over probes is trusted: with fewer the quotient R / S
/// is badly biased, without any it has no meaning.
inline constexpr std::uint64_t min_lit_probes = 64;

/// VPLs that too few probes see; their responses need the whole image.
inline std::vector<VplIndex> poorly_probed(std::span<const ImageResponse> responses) {
    std::vector<VplIndex> poor;
    for (VplIndex j = 0; j < responses.size(); ++j)
        if (responses[j].lit_luxels < min_lit_probes) poor.push_back(j);
    return poor;
}

}  // namespace mir
