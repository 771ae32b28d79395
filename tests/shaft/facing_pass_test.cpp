// SPDX-License-Identifier: MIT
#include "mir/shaft/device/facing_pass.hpp"

#include "shaft/shaft_stage.hpp"
#include "support/catch.hpp"

using namespace mirtest;

namespace {

/// What a FacingPass writes of a stage, some VPLs at a time, where nothing was zero before.
struct Faced {
    std::vector<std::uint32_t> words;
    std::vector<std::uint8_t> blocks;  ///< of block b and VPL j at j times blocks + b
};

Faced faced_by(const ShaftStage& stage, std::uint32_t at_once) {
    const auto vpls = static_cast<std::uint32_t>(stage.lit().vpls.size());
    const std::uint32_t blocks = stage.hits().stride / mir::block_luxels;
    Faced faced{std::vector<std::uint32_t>(
                    std::size_t{stage.hits().stride} / mir::cluster_luxels * vpls, 0xAAAAAAAAu),
                std::vector<std::uint8_t>(std::size_t{blocks} * vpls, 2)};
    std::vector<mir::FacingRecord> records(blocks);
    const mir::FacingRecords make{stage.hits(), records.data()};
    mir::FacingRecords::Workspace nothing;
    for (std::uint32_t i = 0; i < mir::FacingRecords::groups(stage.hits().stride); ++i)
        make(mir::LaneGroup{}, i, nothing);
    for (std::uint32_t first = 0; first < vpls; first += at_once) {
        mir::FacingPass pass{stage.hits(),
                             records.data(),
                             mir::span_of(stage.lit().vpls),
                             mir::VplBatch{first, std::min(at_once, vpls - first)},
                             faced.words.data(),
                             mir::FacedBlocks{&faced.blocks[std::size_t{first} * blocks], blocks}};
        decltype(pass)::Workspace space;
        for (std::uint32_t i = 0; i < decltype(pass)::groups(stage.hits().stride, pass.batch); ++i)
            pass(mir::LaneGroup{}, i, space);
    }
    return faced;
}

std::uint32_t wrong_blocks(const ShaftStage& stage, const Faced& faced) {
    const std::size_t vpls = stage.lit().vpls.size();
    const std::size_t blocks = faced.blocks.size() / vpls;
    constexpr std::size_t words = mir::block_luxels / mir::cluster_luxels;
    std::uint32_t wrong = 0;
    for (std::size_t b = 0; b < blocks; ++b)
        for (std::size_t j = 0; j < vpls; ++j) {
            bool any = false;
            for (std::size_t c = 0; c < words; ++c)
                any = any || faced.words[(b * words + c) * vpls + j] != 0;
            wrong += faced.blocks[j * blocks + b] == (any ? 1 : 0) ? 0 : 1;
        }
    return wrong;
}

}  // namespace

TEST_CASE("Facing words have a bit for each luxel that faces a VPL, and blocks know if any does") {
    const World world = GENERATE(0, 1) == 0 ? sphere_in_box() : soup(false, 1.0f, 0.0f);
    const ShaftStage stage = stage_of(world, 3000, 70);
    const std::vector<std::uint32_t> truth =
        stage.one_by_one([](mir::Vec3, mir::Vec3) { return false; });
    for (const std::uint32_t at_once : {70u, 32u, 33u, 1u}) {
        CAPTURE(at_once);
        const Faced faced = faced_by(stage, at_once);
        CHECK(different_bits(faced.words, truth) == 0);
        CHECK(wrong_blocks(stage, faced) == 0);
    }
}
