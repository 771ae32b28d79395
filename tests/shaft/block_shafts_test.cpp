// SPDX-License-Identifier: MIT
#include "mir/shaft/device/block_shafts.hpp"

#include "shaft/searched_stage.hpp"
#include "support/catch.hpp"

// The decision about 256 luxels and a VPL by itself, against every triangle asked about every
// luxel.

namespace {

using mirtest::SearchedStage;

/// What a decision may use.
struct BlockLimits {
    std::uint32_t nodes = 1000;
    std::uint32_t lists = 1u << 16;
    std::uint32_t triangles = 1u << 20;
};

/// What became of pairs of a batch, and how many of all pairs are wrong.
struct BlockOutcome {
    std::uint32_t asleep = 0;  ///< no luxel faces
    std::uint32_t clear = 0;
    std::uint32_t covered = 0;
    std::uint32_t listed = 0;
    std::uint32_t open = 0;
    std::uint32_t wrong = 0;

    bool operator==(const BlockOutcome&) const = default;
};

class BlockDecision {
 public:
    BlockDecision(const SearchedStage& stage, mir::VplBatch batch, const BlockLimits& limits)
        : stage_(stage),
          batch_(batch),
          words_(stage.facing()),
          listed_(limits.lists),
          pool_(limits.triangles),
          open_(std::size_t{stage.block_count()} * batch.count) {
        std::vector<std::uint8_t> flags(std::size_t{stage.block_count()} * batch.count);
        const mir::FacedBlocks faced{flags.data(), stage.block_count()};
        for (std::uint32_t b = 0; b < faced.blocks; ++b)
            for (std::uint32_t k = 0; k < batch.count; ++k)
                faced.at(b, k) = stage.is_faced({b, batch.first + k}) ? 1 : 0;
        using Kernel = mir::BlockShafts<mir::Space::host, SearchedStage::Vpls>;
        const Kernel kernel{stage.blocks().data(), stage.vpls(), batch,       stage.bvh(),
                            stage.stage().sigma(), limits.nodes, faced,       words_.data(),
                            listed_.view(),        pool_.view(), open_.view()};
        typename Kernel::Workspace space;
        for (std::uint32_t i = 0; i < Kernel::groups(faced.blocks, batch); ++i)
            kernel(mir::LaneGroup{}, i, space);
    }

    [[nodiscard]] BlockOutcome outcome() {
        BlockOutcome outcome;
        outcome.wrong += pool_.is_whole() && open_.asked() == open_.items().size() ? 0 : 1;
        std::vector<std::uint32_t> queued(std::size_t{stage_.block_count()} * stage_.vpls().size());
        const auto times = [&](mir::OpenPair pair) -> std::uint32_t& {
            return queued[std::size_t{pair.cluster} * stage_.vpls().size() + pair.vpl];
        };
        for (const mir::OpenPair& pair : open_.items()) ++times(pair);
        outcome.open = static_cast<std::uint32_t>(open_.items().size());
        for (const mir::ListedPair& list : listed_.items()) {
            ++times(list.pair);
            ++outcome.listed;
            outcome.wrong += is_complete(list) ? 0 : 1;
        }
        for (std::uint32_t b = 0; b < stage_.block_count(); ++b)
            for (std::uint32_t j = 0; j < stage_.vpls().size(); ++j)
                judge({b, j}, times({b, j}), outcome);
        return outcome;
    }

 private:
    /// No triangle but once, none forgotten, and no more than a lane each.
    [[nodiscard]] bool is_complete(const mir::ListedPair& list) const {
        if (list.count == 0 || list.count > mir::LaneGroup::width ||
            list.first + list.count > pool_.capacity())
            return false;
        std::vector<std::uint32_t> triangles(list.count);
        std::copy_n(pool_.words().begin() + list.first, list.count, triangles.begin());
        const bool is_complete = mirtest::are_among(stage_.hiding_in_block(list.pair), triangles);
        std::sort(triangles.begin(), triangles.end());
        return is_complete && triangles.back() < stage_.triangles() &&
               std::adjacent_find(triangles.begin(), triangles.end()) == triangles.end();
    }
    void judge(mir::OpenPair block, std::uint32_t times, BlockOutcome& outcome) const {
        bool is_kept = true, is_zero = true;
        for (const mir::OpenPair& part : SearchedStage::parts(block)) {
            const std::uint32_t word = words_[stage_.place(part)];
            is_kept = is_kept && word == stage_.facing(part);
            is_zero = is_zero && word == 0;
        }
        const bool is_asked = block.vpl - batch_.first < batch_.count;
        if (!is_asked || !stage_.is_faced(block)) {
            outcome.asleep += is_asked ? 1 : 0;
            outcome.wrong += is_kept && times == 0 ? 0 : 1;
            return;
        }
        outcome.wrong += (is_kept || (is_zero && times == 0)) && times < 2 ? 0 : 1;
        if (times != 0) return;
        ++(is_zero ? outcome.covered : outcome.clear);
        outcome.wrong +=
            (is_zero ? stage_.is_covered(block) : stage_.hiding_in_block(block).empty()) ? 0 : 1;
    }

    const SearchedStage& stage_;
    mir::VplBatch batch_;
    std::vector<std::uint32_t> words_;
    mirtest::Queued<mir::ListedPair> listed_;
    mirtest::PoolMemory pool_;
    mirtest::Queued<mir::OpenPair> open_;
};

BlockOutcome decided(const SearchedStage& stage, mir::VplBatch batch,
                     const BlockLimits& limits = {}) {
    const BlockOutcome outcome = BlockDecision(stage, batch, limits).outcome();
    UNSCOPED_INFO(outcome.asleep << " asleep, " << outcome.clear << " clear, " << outcome.covered
                                 << " covered, " << outcome.listed << " listed, " << outcome.open
                                 << " open");
    CHECK(outcome.wrong == 0);
    return outcome;
}
BlockOutcome decided(const SearchedStage& stage, const BlockLimits& limits = {}) {
    return decided(stage, {0, stage.vpls().size()}, limits);
}

}  // namespace

TEST_CASE("Shafts of blocks decide right, and their lists have every triangle that hides a luxel") {
    const bool room = GENERATE(true, false);
    const mirtest::World world = room ? mirtest::sphere_in_box() : mirtest::soup(false);
    const mirtest::ShaftStage drawn(world.geometry, mirtest::lit_in_space(world, 10000, 60));
    const SearchedStage stage(drawn);
    REQUIRE(stage.block_count() > mir::LaneGroup::width);
    const BlockOutcome found = decided(stage);
    CHECK(found.asleep > 1000);
    CHECK(found.clear > 10);
    CHECK(found.covered > 5);
    CHECK(found.listed > 300);
    CHECK(found.open < 100);
    std::uint32_t in_batches = 0;
    for (const mir::VplBatch batch : {mir::VplBatch{0, 7}, {7, 1}, {8, 52}})
        in_batches += decided(stage, batch).listed;
    CHECK(in_batches == found.listed);
}

TEST_CASE("Blocks whose shafts may visit too few nodes are left open") {
    const mirtest::World world = mirtest::soup(false);
    const mirtest::ShaftStage drawn = mirtest::stage_of(world, 4000, 40);
    const SearchedStage stage(drawn);
    std::uint32_t open = ~0u;
    for (const std::uint32_t nodes : {0u, 3u, 6u}) {
        const std::uint32_t now = decided(stage, BlockLimits{nodes}).open;
        CHECK(now < open);
        open = now;
    }
}

TEST_CASE("Blocks with more triangles than a list may have are left open") {
    const mirtest::World world = mirtest::sphere_in_box(40);
    const mirtest::ShaftStage drawn = mirtest::stage_of(world, 2000, 20);
    const SearchedStage stage(drawn);
    CHECK(decided(stage).open > 20);
}

TEST_CASE("Lists of blocks for which there is no room are left open, and nothing else changes") {
    const mirtest::World world = mirtest::soup(false);
    const mirtest::ShaftStage drawn = mirtest::stage_of(world, 9000, 20);
    const SearchedStage stage(drawn);
    const BlockOutcome all = decided(stage);
    REQUIRE(all.listed > 100);
    const auto has_room_for = [&](const BlockLimits& limits) {
        BlockOutcome found = decided(stage, limits);
        const std::uint32_t listed = found.listed;
        found.open -= all.listed - listed;
        found.listed = all.listed;
        CHECK(found == all);
        return listed;
    };
    for (const std::uint32_t lists : {0u, 1u, 33u, 100u})
        CHECK(has_room_for({1000, lists}) == lists);
    CHECK(has_room_for({1000, all.listed, 0}) == 0);
    const std::uint32_t some = has_room_for({1000, all.listed, 100});
    CHECK((some > 0 && some <= 100));
}

TEST_CASE("Blocks and VPLs beyond reach are left open") {
    const mirtest::World world = mirtest::soup(false);
    const mirtest::ShaftStage drawn(world.geometry, mirtest::lit_beyond_reach(world, 2048, 20));
    const SearchedStage stage(drawn);
    std::uint32_t beyond = 0;
    for (std::uint32_t b = 0; b < stage.block_count(); ++b)
        for (std::uint32_t j = 0; j < stage.vpls().size(); ++j)
            if (stage.is_faced({b, j}) && stage.is_beyond_reach(stage.blocks()[b], j)) ++beyond;
    REQUIRE(beyond > 20);
    CHECK(decided(stage).open == beyond);
}
