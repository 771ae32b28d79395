// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/lit_vpls.hpp"
#include "mir/cuts/vpl_tree.hpp"

#include <algorithm>
#include <cmath>

namespace mir {

/// Estimates how far one pick's light lies from that of its node. For the luxels of one group of a
/// block, with nothing in between: root of the mean variance of luminance, in the unit of the
/// shading. Few VPLs of the node tell it, those at fixed fractions of its weight; all of them where
/// they are few. `batch` must be empty, and is again afterwards.
template <InstructionSet Set, Shading F, class Hits>
[[gnu::always_inline]] inline float node_deviation(const blocks::LuxelBlock<F, Hits>& block,
                                                   std::uint32_t group, const VplTree& tree,
                                                   const VplNode& node, const F& shading,
                                                   blocks::LitVpls& batch) {
    constexpr std::uint32_t samples = 8;
    const bool all = node.count <= samples;
    const std::uint32_t count = all ? node.count : samples;
    float share[samples];
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint64_t u = (std::uint64_t{k} << 61) | std::uint64_t{1} << 60;
        const std::uint32_t leaf = all ? node.first + k : tree.pick(node, u);
        Vpl vpl = tree.leaves()[leaf];
        const float inverse = tree.inverse_probability(node, leaf);
        share[k] = all ? 1.0f / inverse : 1.0f / samples;
        vpl.intensity = vpl.intensity * inverse;
        BlockMask lit;
        lit.packet[group] = block.candidates[group];
        batch.add(vpl, lit);
    }
    blocks::GroupRadiance light[samples];
    batch.template shade_each<Set>(block, shading, light);
    float variance = 0.0f;
    for (std::uint32_t lane = 0; lane < blocks::group_size; ++lane) {
        float mean = 0.0f;
        float square = 0.0f;
        for (std::uint32_t k = 0; k < count; ++k) {
            const float y = luminance(Rgb{light[k].r[lane], light[k].g[lane], light[k].b[lane]});
            mean += share[k] * y;
            square += share[k] * y * y;
        }
        variance += square - mean * mean;
    }
    return std::sqrt(std::max(variance, 0.0f) / blocks::group_size);
}

}  // namespace mir
