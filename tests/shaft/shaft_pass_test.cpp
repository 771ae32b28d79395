// SPDX-License-Identifier: MIT
#include "support/shafts/shaft_pass.hpp"

#include "conformance/shaft_suite.hpp"

// Words by shafts against every triangle asked, bit for bit: docs/shafts.md.

namespace {

using mir::PairState;
using mirtest::different_bits;
using mirtest::Lit;
using mirtest::ShaftStage;
using mirtest::soup;
using mirtest::stage_of;

const auto by_shafts = [](const ShaftStage& stage) { return stage.by_shafts(); };

/// Blocks and VPLs that a ShaftPass did not search.
std::uint64_t unknown_blocks(const ShaftStage& stage) {
    mir::PairTally tally;
    static_cast<void>(stage.by_shafts({}, tally));
    return tally.block(PairState::unknown);
}

}  // namespace

TEST_CASE("Shafts give the bits of every triangle asked") { mirtest::shaft_soup_suite(by_shafts); }

TEST_CASE("All that may become of a pair does") {
    const mirtest::World world = mirtest::sphere_in_box();
    const ShaftStage stage = stage_of(world, 30000, 30);
    mir::PairTally counts;
    static_cast<void>(stage.by_shafts({}, counts));
    for (PairState s : {PairState::clear, PairState::covered, PairState::listed}) {
        CAPTURE(static_cast<int>(s));
        CHECK(counts.block(s) > 0);
        CHECK(counts.cluster(s) > 100);
    }
    mir::PairTally few;
    static_cast<void>(stage.by_shafts({{2, 4}, {3, 2}}, few));
    CHECK(few.block(PairState::unknown) > 100);
    CHECK(few.cluster(PairState::unknown) > 100);
}

TEST_CASE("No limit of a search changes a bit") {
    const mirtest::World world = soup(GENERATE(false, true));
    const ShaftStage stage = stage_of(world, 700, 30);
    const std::vector<std::uint32_t> truth = stage.by_brute_force();
    for (std::uint32_t nodes : {0u, 1u, 2u, 3u, 5u, 8u, 1000u})
        for (std::uint32_t triangles : {0u, 1u, 2u, 7u, 64u, 1000u}) {
            CAPTURE(nodes, triangles);
            const mir::SearchLimits some{nodes, triangles};
            CHECK(different_bits(stage.by_shafts({some, {96, 24}}), truth) == 0);
            CHECK(different_bits(stage.by_shafts({{0, 0}, some}), truth) == 0);
        }
}

TEST_CASE("No order of luxels changes a bit") {
    const mirtest::World world = soup(false);
    const Lit lit = mirtest::random_lit(world.geometry, 700, 30, mirtest::test_random(20));
    Lit reversed = lit;
    std::reverse(reversed.luxels.begin(), reversed.luxels.end());
    Lit dealt = lit;
    for (std::size_t i = 0; i < dealt.luxels.size(); ++i)
        dealt.luxels[i] = lit.luxels[i * 353 % lit.luxels.size()];
    for (const Lit& order : {lit, reversed, dealt, mirtest::clustered(lit)}) {
        const ShaftStage stage(world.geometry, order);
        CHECK(different_bits(stage.by_shafts(), stage.by_brute_force()) == 0);
    }
}

TEST_CASE("Any number of luxels and of VPLs is right") {
    mirtest::shaft_count_suite(by_shafts, {0, 1, 31, 32, 33, 256, 511, 513}, {0, 1, 31, 33});
}

TEST_CASE("Closed boxes, flat to shared edges and to the axes, give the same bits") {
    const mirtest::World world = mirtest::sphere_in_box();
    const ShaftStage stage = stage_of(world, 2000, 60);
    CHECK(different_bits(stage.by_shafts(), stage.by_brute_force()) == 0);
}

TEST_CASE("Luxels and VPLs beyond reach are asked one by one") {
    const mirtest::World world = soup(false);
    const Lit within = mirtest::random_lit(world.geometry, 500, 40, mirtest::test_random(22));
    const std::uint64_t before =
        unknown_blocks(ShaftStage(world.geometry, mirtest::clustered(within)));
    const ShaftStage stage(world.geometry, mirtest::clustered(mirtest::lit_beyond_reach(world)));
    CHECK(different_bits(stage.by_shafts(), stage.by_segments()) == 0);
    CHECK(unknown_blocks(stage) > before + 10);
}

TEST_CASE("Scenes larger than the proofs reach are asked one by one") {
    const ShaftStage stage = mirtest::stage_beyond_proofs();
    CHECK(different_bits(stage.by_shafts(), stage.by_segments()) == 0);
    mir::PairTally tally;
    static_cast<void>(stage.by_shafts({}, tally));
    CHECK(tally.block(PairState::unknown) > 10);
    CHECK(tally.block(PairState::covered) + tally.block(PairState::clear) == 0);
}

TEST_CASE("A luxel that is not a number changes no bit of its neighbours") {
    const mirtest::World world = soup(false);
    const Lit lit =
        mirtest::clustered(mirtest::random_lit(world.geometry, 512, 30, mirtest::test_random(23)));
    for (const std::size_t first : {0u, 1u, 40u})
        for (const int axis : {0, 1, 2}) {
            CAPTURE(first, axis);
            const ShaftStage stage(world.geometry, mirtest::with_nan(lit, first, 64, axis));
            CHECK(different_bits(stage.by_shafts(), stage.by_segments()) == 0);
        }
}

TEST_CASE("A world without triangles hides nothing") { mirtest::shaft_empty_suite(by_shafts); }
