// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/path_luminance.hpp"
#include "mir/sampling/caustic_paths.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

namespace mir {

/// Upper limit of the share of indirect light that all light paths of caustics bring, 97.5 % sure,
/// from the first `traced` of them. Splats count as independent, none of them brighter than the
/// brightest found or than ten usual light paths of `indirect`: Bernstein's inequality. Few paths
/// therefore never say that nothing is there. Rare splats beyond that are not covered. None where
/// `indirect` knows no light.
/// @param splats of the paths that were traced, with their power shared out over `paths`
/// @param indirect mean luminance of indirect light by light paths, W m^-2 sr^-1
/// @param luxels of the whole image
[[nodiscard]] inline std::optional<double> faint_share(std::span<const CausticSplat> splats,
                                                       std::uint64_t traced, std::uint64_t paths,
                                                       const PathLuminance& indirect,
                                                       std::uint64_t luxels) {
    if (!(indirect.mean > 0.0) || indirect.contributing == 0) return std::nullopt;
    const double scale = static_cast<double>(paths) / static_cast<double>(traced) /
                         static_cast<double>(luxels) / indirect.mean;
    // What one of `traced` light paths brings that lights the image at all.
    const double usual = static_cast<double>(indirect.paths) /
                         static_cast<double>(indirect.contributing) / static_cast<double>(traced);
    double brightest = 10.0 * usual;
    double sum = 0.0;
    double squares = 0.0;
    for (const CausticSplat& s : splats) {
        const double share = scale * static_cast<double>(luminance(s.radiance));
        sum += share;
        squares += share * share;
        brightest = std::max(brightest, share);
    }
    const double log_odds = -std::log(0.025);
    const double jump = brightest * log_odds / 3.0;
    return sum + jump + std::sqrt(jump * jump + 2.0 * squares * log_odds);
}

}  // namespace mir
