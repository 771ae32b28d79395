// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/host/shaft_visibility.hpp"
#include "shaft/shaft_stage.hpp"
#include "support/instruction_sets.hpp"

namespace mirtest {

/// Words of a stage by the block interface, laid out like those of ShaftPass.
inline std::vector<std::uint32_t> by_blocks(const ShaftStage& stage,
                                            const mir::CascadeLimits& limits = {},
                                            mir::InstructionSet set = mir::best_instruction_set()) {
    const Lit& lit = stage.lit();
    const auto triangles = mir::make_triangle_lanes(stage.bvh().triangles());
    const mir::ShaftVisibility visibility{stage.bvh().view(), triangles.data(), limits};
    const HitRun run(lit.luxels);
    std::vector<std::uint32_t> words(lit.luxels.size() / 32 * lit.vpls.size(), 0u);
    for (std::size_t b = 0; b < lit.luxels.size() / mir::BlockMask::luxels; ++b) {
        const std::size_t first = b * mir::BlockMask::luxels;
        const auto block = visibility.block({run.view().planes + first, run.view().stride}, set);
        for (std::size_t j = 0; j < lit.vpls.size(); ++j) {
            mir::BlockMask mask;
            for (std::uint32_t i = 0; i < mir::BlockMask::luxels; ++i)
                if (mir::faces(lit.luxels[first + i], lit.vpls[j]))
                    mask.packet[i / 16] |= 1u << i % 16;
            visibility.visible_block(block, lit.vpls[j].position, mask);
            for (std::uint32_t g = 0; g < mir::BlockMask::packets; ++g)
                words[(first / 32 + g / 2) * lit.vpls.size() + j] |= mask.packet[g] << 16 * (g % 2);
        }
    }
    return words;
}

}  // namespace mirtest
