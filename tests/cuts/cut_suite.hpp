// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuts/cut_policy.hpp"
#include "mir/cuts/interleaved_block.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"

namespace mirtest {

/// True when the nodes of a cut hold every leaf of a tree once, in leaf order.
inline bool covers(const mir::VplCut& cut, const mir::VplTree& tree) {
    std::uint32_t next = 0;
    for (const mir::VplNode& node : cut) {
        if (node.first != next || node.count == 0) return false;
        next += node.count;
    }
    return next == tree.size();
}

/// The axioms of CutPolicy, for every block of a G-buffer that has luxels.
template <class Stage, class Shading, class Policy>
void cut_suite(const Stage& stage, const mir::VplTree& tree, const Shading& shading,
               const Policy& policy, std::size_t most) {
    static_assert(mir::CutPolicy<Policy, Shading>);
    std::uint32_t asked = 0;
    for (mir::TileIndex t = 0; t < stage.gbuffer().tiles().size(); ++t) {
        const auto view = stage.gbuffer().view(t);
        const auto layout = mir::BlockedLayout::of(stage.gbuffer().tiles()[t]);
        for (std::uint32_t b = 0; b < layout.blocks(); ++b) {
            const mir::blocks::InterleavedBlock<Shading> luxels(view.hits, view.surfaces, {t, b});
            const mir::CutBlock<Shading> block(luxels.hits(), luxels.surfaces(), {}, shading);
            if (block.none_counts) continue;
            ++asked;
            const mir::VplCut cut =
                policy.template choose<mir::InstructionSet::baseline>(block, tree, shading);
            CHECK(covers(cut, tree));
            CHECK(cut.size() <= most);
            for (const mir::InstructionSet set : instruction_sets())
                mir::run_with(set, [&](auto chosen) {
                    CHECK(policy.template choose<chosen()>(block, tree, shading) == cut);
                });
        }
    }
    CHECK(asked > 0);
}

}  // namespace mirtest
