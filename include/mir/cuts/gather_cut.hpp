// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/lit_vpls.hpp"
#include "mir/cuts/cut_picks.hpp"
#include "mir/cuts/cut_policy.hpp"

#include <algorithm>

namespace mir {

/// Watches no picks.
struct NoSpread {
    static constexpr std::uint32_t capacity = ~0u;  ///< nodes that it takes at a time
    void start(std::uint32_t /*group*/) {}
    void add(std::uint32_t /*node*/, const Vpl& /*vpl*/, const BlockMask& /*lit*/) {}
    void finish(std::uint32_t /*nodes*/) {}
};

/// Some nodes of a cut that come one after the other.
struct CutPart {
    std::uint32_t first = 0;  ///< in the cut
    std::uint32_t last = 0;   ///< behind them
};

/// Adds the light of a part of a cut to the luxels of a block. For each group and node one pick,
/// traced to the luxels that face it and weighed by the inverse of its probability. `sums` has a
/// place for each group. `spread`, a PickSpread or NoSpread, is told the picks of nodes with
/// several VPLs.
template <InstructionSet Set, Shading F, PacketVisibility V, class Spread>
void gather_cut(const CutBlock<F>& block, const VplTree& tree, const VplCut& cut, CutPart part,
                CutPicks& picks, const V& visibility, const F& shading, blocks::GroupRadiance* sums,
                Spread& spread) {
    using namespace blocks;
    LitVpls batch;
    for (std::uint32_t group = 0; group < groups_per_block; ++group) {
        if (block.candidates[group] == 0) continue;
        const auto hits = starting_at(block.hits, group * group_size);
        PointPacket points;
        load_points(hits, points);
        picks.start(group);
        spread.start(group);
        for (std::uint32_t i = part.first; i < part.last; ++i) {
            const std::uint32_t leaf = tree.pick(cut[i], picks(i));
            Vpl vpl = tree.leaves()[leaf];
            std::uint32_t lit = facing_mask(hits, vpl) & block.candidates[group];
            if (lit != 0) lit = visibility.visible_packet(vpl.position, points, lit);
            if (lit == 0) continue;
            vpl.intensity = vpl.intensity * tree.inverse_probability(cut[i], leaf);
            BlockMask mask;
            mask.packet[group] = lit;
            if (!cut[i].is_leaf()) spread.add(i - part.first, vpl, mask);
            batch.add(vpl, mask);
            if (batch.is_full()) batch.template shade<Set>(block, shading, sums);
        }
        batch.template shade<Set>(block, shading, sums);
    }
}

/// The same for a whole cut.
template <InstructionSet Set, Shading F, PacketVisibility V, class Spread>
void gather_cut(const CutBlock<F>& block, const VplTree& tree, const VplCut& cut, CutPicks& picks,
                const V& visibility, const F& shading, blocks::GroupRadiance* sums,
                Spread& spread) {
    const auto nodes = static_cast<std::uint32_t>(cut.size());
    for (CutPart part; part.last < nodes;) {
        part = {part.last, part.last + std::min(Spread::capacity, nodes - part.last)};
        gather_cut<Set>(block, tree, cut, part, picks, visibility, shading, sums, spread);
        spread.finish(part.last - part.first);
    }
}

}  // namespace mir
