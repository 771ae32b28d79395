// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mir {

/// For each geometric VPL the bounce that brings most of its luminance. The bounce is
/// PathVpl::bounce; the smallest of several that bring as much, the first recorded for a black VPL.
/// Thread-safe for a list that does not change.
inline std::vector<std::uint8_t> main_bounces(const VplList& list) {
    std::vector<std::uint8_t> bounces(list.size());
    std::array<float, 256> light{};
    const auto paths = list.path_vpls();
    for (std::size_t begin = 0, end = 0; begin < paths.size(); begin = end) {
        for (; end < paths.size() && paths[end].vpl == paths[begin].vpl; ++end)
            light[paths[end].bounce] += luminance(paths[end].intensity);
        std::uint8_t best = paths[begin].bounce;
        for (const PathVpl& p : paths.subspan(begin, end - begin))
            if (light[p.bounce] > light[best] ||
                (light[p.bounce] == light[best] && light[best] > 0.0f && p.bounce < best))
                best = p.bounce;
        for (const PathVpl& p : paths.subspan(begin, end - begin)) light[p.bounce] = 0.0f;
        bounces[paths[begin].vpl] = best;
    }
    return bounces;
}

}  // namespace mir
