// SPDX-License-Identifier: MIT
#include "mir/shaft/device/cluster_shafts.hpp"

#include "shaft/searched_stage.hpp"
#include "support/catch.hpp"

// The search of 32 luxels and a VPL by itself: what it says of each pair, and the leaves that it
// lists, against every triangle asked about every luxel.

namespace {

using mirtest::SearchedStage;

/// What a search may use.
struct ClusterLimits {
    std::uint32_t nodes = 1000;
    std::uint32_t lists = 1u << 16;
    std::uint32_t leaves = 1u << 20;
};

/// What a search left of each pair, and how much of that is wrong.
struct ClusterOutcome {
    std::uint32_t asleep = 0;  ///< without a luxel that faces, or of a block that was not queued
    std::uint32_t clear = 0;
    std::uint32_t listed = 0;
    std::uint32_t open = 0;
    std::uint32_t wrong = 0;
    std::size_t triangles = 0;  ///< in lists

    [[nodiscard]] std::uint32_t alive() const { return clear + listed + open; }
};

/// Two of three pairs of blocks and VPLs, in an order of their own.
std::vector<mir::OpenPair> some_blocks(const SearchedStage& stage) {
    std::vector<mir::OpenPair> blocks;
    for (std::uint32_t j = stage.vpls().size(); j-- > 0;)
        for (std::uint32_t b = 0; b < stage.block_count(); ++b)
            if ((b + j) % 3 != 0) blocks.push_back({b, j});
    return blocks;
}

class ClusterSearch {
 public:
    ClusterSearch(const SearchedStage& stage, const ClusterLimits& limits)
        : stage_(stage),
          blocks_(some_blocks(stage)),
          listed_(limits.lists),
          pool_(limits.leaves),
          open_(stage.facing().size()) {
        using Kernel = mir::ClusterShafts<mir::Space::host, SearchedStage::Vpls>;
        const Kernel kernel{stage.stage().clusters().data(),
                            stage.vpls(),
                            stage.bvh(),
                            stage.stage().sigma(),
                            limits.nodes,
                            stage.facing().data(),
                            blocks_.view(),
                            listed_.view(),
                            pool_.view(),
                            open_.view()};
        typename Kernel::Workspace space;
        // The second group finds nothing to do.
        for (std::uint32_t i = 0; i < 2; ++i) kernel(mir::LaneGroup{}, i, space);
    }

    [[nodiscard]] ClusterOutcome outcome() {
        ClusterOutcome outcome;
        outcome.wrong += pool_.is_whole() && open_.asked() == open_.items().size() ? 0 : 1;
        std::vector<std::uint32_t> found(stage_.facing().size(), 0u);  // times that it was queued
        for (const mir::OpenPair& pair : open_.items()) ++found[stage_.place(pair)];
        outcome.open = static_cast<std::uint32_t>(open_.items().size());
        for (const mir::ListedPair& list : listed_.items()) {
            ++found[stage_.place(list.pair)];
            judge(list, outcome);
        }
        for (std::uint32_t c = 0; c < stage_.stage().clusters().size(); ++c)
            for (std::uint32_t j = 0; j < stage_.vpls().size(); ++j)
                judge({c, j}, found[stage_.place({c, j})], outcome);
        return outcome;
    }

 private:
    /// Every triangle that hides a luxel must be in the list.
    void judge(const mir::ListedPair& list, ClusterOutcome& outcome) const {
        ++outcome.listed;
        if (list.first + list.count > pool_.capacity()) {
            ++outcome.wrong;
            return;
        }
        const auto triangles = stage_.triangles_of(pool_.words().data() + list.first, list.count);
        outcome.triangles += triangles.size();
        outcome.wrong += mirtest::are_among(stage_.hiding(list.pair), triangles) ? 0 : 1;
    }
    void judge(mir::OpenPair pair, std::uint32_t found, ClusterOutcome& outcome) const {
        const std::uint32_t block = pair.cluster * mir::cluster_luxels / mir::block_luxels;
        const bool is_alive = (block + pair.vpl) % 3 != 0 && stage_.facing(pair) != 0;
        const bool is_clear = is_alive && found == 0;
        outcome.asleep += is_alive ? 0 : 1;
        outcome.clear += is_clear ? 1 : 0;
        outcome.wrong += found > (is_alive ? 1u : 0u) ? 1 : 0;
        outcome.wrong += is_clear && !stage_.hiding(pair).empty() ? 1 : 0;
    }

    const SearchedStage& stage_;
    mirtest::Queued<mir::OpenPair> blocks_;
    mirtest::Queued<mir::ListedPair> listed_;
    mirtest::PoolMemory pool_;
    mirtest::Queued<mir::OpenPair> open_;
};

ClusterOutcome outcome_of(const SearchedStage& stage, const ClusterLimits& limits = {}) {
    ClusterOutcome outcome = ClusterSearch(stage, limits).outcome();
    UNSCOPED_INFO(outcome.asleep << " asleep, " << outcome.clear << " clear, " << outcome.listed
                                 << " listed, " << outcome.open << " open");
    CHECK(outcome.wrong == 0);
    return outcome;
}

}  // namespace

TEST_CASE("Shafts of clusters list every triangle that hides a luxel, and no other pair is clear") {
    const bool room = GENERATE(true, false);
    const mirtest::World world = room ? mirtest::sphere_in_box(24) : mirtest::soup(false);
    const mirtest::ShaftStage drawn(world.geometry, mirtest::lit_in_space(world, 6000, 150));
    const SearchedStage stage(drawn);
    const ClusterOutcome found = outcome_of(stage);
    CHECK(found.open == 0);
    CHECK(found.asleep > 500);
    CHECK(found.clear > 20);
    CHECK(found.listed > 100);
    CHECK(found.triangles < found.listed * stage.triangles() / 2);
}

TEST_CASE("Searches of clusters that may visit too few nodes leave their pairs open") {
    const mirtest::World world = mirtest::sphere_in_box(40);
    const mirtest::ShaftStage drawn = mirtest::stage_of(world, 1024, 16);
    const SearchedStage stage(drawn);
    std::uint32_t open = ~0u;
    const std::uint32_t alive = outcome_of(stage).alive();
    for (const std::uint32_t nodes : {0u, 6u, 10u, 20u, 1000u}) {
        CAPTURE(nodes);
        const ClusterOutcome found = outcome_of(stage, {nodes});
        CHECK(found.alive() == alive);
        CHECK(found.open < open);
        open = found.open;
    }
}

TEST_CASE("Lists of clusters for which there is no room are left open, and no other") {
    const mirtest::World world = mirtest::soup(false);
    const mirtest::ShaftStage drawn = mirtest::stage_of(world, 1500, 20);
    const SearchedStage stage(drawn);
    const ClusterOutcome all = outcome_of(stage);
    REQUIRE(all.listed > 100);
    const auto has_room_for = [&](const ClusterLimits& limits) {
        const ClusterOutcome found = outcome_of(stage, limits);
        CHECK(found.clear == all.clear);
        CHECK(found.listed + found.open == all.listed);
        return found.listed;
    };
    for (const std::uint32_t lists : {0u, 1u, 33u, 100u})
        CHECK(has_room_for({1000, lists}) == lists);
    CHECK(has_room_for({1000, all.listed, 0}) == 0);
    CHECK(has_room_for({1000, all.listed, 7}) <= 7);
    const std::uint32_t some = has_room_for({1000, all.listed, 200});
    CHECK(some > 0);
    CHECK(some <= 200);
}

TEST_CASE("Clusters and VPLs beyond reach are left open unless no luxel faces") {
    const mirtest::World world = mirtest::soup(false);
    const mirtest::ShaftStage drawn(world.geometry, mirtest::lit_beyond_reach(world, 1500, 20));
    const SearchedStage stage(drawn);
    std::uint32_t beyond = 0;
    for (const mir::OpenPair& block : some_blocks(stage))
        for (const mir::OpenPair& pair : SearchedStage::parts(block))
            if (stage.facing(pair) != 0 &&
                stage.is_beyond_reach(drawn.clusters()[pair.cluster], pair.vpl))
                ++beyond;
    REQUIRE(beyond > 100);
    CHECK(outcome_of(stage).open == beyond);
}
