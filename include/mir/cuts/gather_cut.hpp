// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/lit_vpls.hpp"
#include "mir/cuts/cut_picks.hpp"
#include "mir/cuts/cut_policy.hpp"

namespace mir {

/// Adds the light of a cut to the luxels of a block. For each group and node one pick, traced to
/// the luxels that face it and weighed by the inverse of its probability. `sums` has a place for
/// each group.
template <InstructionSet Set, Shading F, PacketVisibility V>
void gather_cut(const CutBlock<F>& block, const VplTree& tree, const VplCut& cut, CutPicks& picks,
                const V& visibility, const F& shading, blocks::GroupRadiance* sums) {
    using namespace blocks;
    LitVpls batch;
    for (std::uint32_t group = 0; group < groups_per_block; ++group) {
        if (block.candidates[group] == 0) continue;
        const auto hits = starting_at(block.hits, group * group_size);
        PointPacket points;
        load_points(hits, points);
        picks.start(group);
        for (std::uint32_t i = 0; i < cut.size(); ++i) {
            const std::uint32_t leaf = tree.pick(cut[i], picks(i));
            Vpl vpl = tree.leaves()[leaf];
            std::uint32_t lit = facing_mask(hits, vpl) & block.candidates[group];
            if (lit != 0) lit = visibility.visible_packet(vpl.position, points, lit);
            if (lit == 0) continue;
            vpl.intensity = vpl.intensity * tree.inverse_probability(cut[i], leaf);
            BlockMask mask;
            mask.packet[group] = lit;
            batch.add(vpl, mask);
            if (batch.is_full()) batch.template shade<Set>(block, shading, sums);
        }
        batch.template shade<Set>(block, shading, sums);
    }
}

}  // namespace mir
