// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/lit_vpls.hpp"
#include "mir/cuts/node_light.hpp"
#include "mir/cuts/vpl_tree.hpp"

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
    const std::uint32_t count = NodeSample::count_of(node);
    float share[NodeSample::most];
    for (std::uint32_t k = 0; k < count; ++k) {
        const NodeSample sample = NodeSample::of(tree.view(), node, k);
        share[k] = sample.share;
        BlockMask lit;
        lit.packet[group] = block.candidates[group];
        batch.add(sample.vpl, lit);
    }
    blocks::GroupRadiance light[NodeSample::most];
    batch.template shade_each<Set>(block, shading, light);
    float variance = 0.0f;
    for (std::uint32_t lane = 0; lane < blocks::group_size; ++lane) {
        SampleMoments moments;
        for (std::uint32_t k = 0; k < count; ++k)
            moments.add(share[k], {light[k].r[lane], light[k].g[lane], light[k].b[lane]});
        variance += moments.variance();
    }
    return root_of_mean(variance, blocks::group_size);
}

}  // namespace mir
