// SPDX-License-Identifier: MIT
#include "mir/shaft/host/block_cascade.hpp"

#include "accel/build_worlds.hpp"
#include "conformance/shaft_suite.hpp"
#include "shaft/block_words.hpp"

// Words by whole blocks against every triangle asked, bit for bit: docs/shafts.md.

namespace {

using mirtest::by_blocks;
using mirtest::different_bits;
using mirtest::Lit;
using mirtest::ShaftStage;
using mirtest::soup;
using mirtest::stage_of;

const auto by_default = [](const ShaftStage& stage) { return by_blocks(stage); };

}  // namespace

TEST_CASE("Blocks give the bits of every triangle asked") {
    for (const mir::InstructionSet set : mirtest::instruction_sets())
        mirtest::shaft_soup_suite(
            [set](const ShaftStage& stage) { return by_blocks(stage, {}, set); });
}

TEST_CASE("Blocks in closed rooms give the bits of every triangle asked") {
    const mirtest::World world = mirtest::sphere_in_box();
    const ShaftStage stage = stage_of(world, 2000, 60);
    const std::vector<std::uint32_t> truth = stage.by_brute_force();
    for (mir::InstructionSet set : mirtest::instruction_sets())
        CHECK(different_bits(by_blocks(stage, {}, set), truth) == 0);
}

TEST_CASE("No limit of the cascade changes a bit") {
    const int kind = GENERATE(0, 1, 2);
    const mirtest::World world = kind == 2 ? mirtest::sphere_in_box() : soup(kind == 1);
    const ShaftStage stage = stage_of(world, 700, 30);
    const std::vector<std::uint32_t> truth = stage.by_segments();
    for (std::uint32_t nodes : {0u, 1u, 2u, 3u, 5u, 8u, 1000u})
        for (std::uint32_t batches : {0u, 1u, 2u, 7u, 16u, 1000u}) {
            CAPTURE(nodes, batches);
            CHECK(different_bits(by_blocks(stage, {nodes, batches}), truth) == 0);
        }
}

TEST_CASE("Leaves of any size are right") {
    const mirtest::World world = soup(false);
    const Lit lit = mirtest::random_lit(world.geometry, 512, 30, mirtest::test_random(25));
    for (std::uint32_t leaf : {1u, 8u}) {
        mir::WideBvhOptions options;
        options.leaf_size = leaf;
        const ShaftStage stage(world.geometry, lit, options);
        CHECK(different_bits(by_blocks(stage), stage.by_brute_force()) == 0);
    }
}

TEST_CASE("Trees as deep as can be give the bits of single segments") {
    const mirtest::World world = mirtest::nested_triangles(3000, 30);
    const Lit lit = mirtest::random_lit(world.geometry, 512, 20, mirtest::test_random(28));
    mir::WideBvhOptions options;
    options.leaf_size = 1;
    options.max_depth = mir::WideBvhOptions::depth_limit;
    const ShaftStage stage(world.geometry, lit, options);
    const std::vector<std::uint32_t> truth = stage.by_segments();
    for (std::uint32_t nodes : {0u, 1u, 8u, 1000u}) {
        CAPTURE(nodes);
        CHECK(different_bits(by_blocks(stage, {nodes, 16}), truth) == 0);
    }
}

TEST_CASE("Triangles that lie in several leaves change no bit of a block") {
    const mirtest::World world = soup(GENERATE(false, true), 1.0f, GENERATE(0.0f, 30.0f));
    const Lit lit = mirtest::random_lit(world.geometry, 512, 30, mirtest::test_random(27));
    mir::WideBvhOptions options;
    options.splits = 1.0f;
    const ShaftStage stage(world.geometry, mirtest::clustered(lit), options);
    CHECK(stage.bvh().indices().size() > world.geometry.triangles().size());
    const std::vector<std::uint32_t> truth = stage.by_brute_force();
    CHECK(different_bits(by_blocks(stage), truth) == 0);
    CHECK(different_bits(by_blocks(stage, {2, 1}), truth) == 0);
    CHECK(different_bits(stage.by_shafts(), truth) == 0);
    CHECK(different_bits(stage.by_shafts({{2, 4}, {3, 2}}), truth) == 0);
}

TEST_CASE("Blocks of any number of luxels are right") {
    mirtest::shaft_count_suite(by_default, {0, 1, 15, 17, 256, 257, 513}, {0, 1, 33});
}

TEST_CASE("Luxels that are scattered over the scene give the same bits") {
    const mirtest::World world = mirtest::sphere_in_box();
    Lit lit = mirtest::random_lit(world.geometry, 1024, 40, mirtest::test_random(26));
    Lit dealt = lit;
    for (std::size_t i = 0; i < dealt.luxels.size(); ++i)
        dealt.luxels[i] = lit.luxels[i * 353 % lit.luxels.size()];
    const ShaftStage stage(world.geometry, dealt);
    CHECK(different_bits(by_blocks(stage), stage.by_brute_force()) == 0);
}

TEST_CASE("Luxels and VPLs beyond reach give the bits of single segments") {
    const mirtest::World world = soup(false);
    const ShaftStage stage(world.geometry, mirtest::clustered(mirtest::lit_beyond_reach(world)));
    CHECK(different_bits(by_blocks(stage), stage.by_segments()) == 0);
}

TEST_CASE("Scenes larger than the proofs reach give the bits of single segments") {
    const ShaftStage stage = mirtest::stage_beyond_proofs();
    CHECK(different_bits(by_blocks(stage), stage.by_segments()) == 0);
}

TEST_CASE("A luxel that is not a number changes no bit of the block around it") {
    const mirtest::World world = soup(false);
    const Lit lit =
        mirtest::clustered(mirtest::random_lit(world.geometry, 512, 30, mirtest::test_random(23)));
    for (const std::size_t first : {0u, 1u, 16u, 40u})
        for (const int axis : {0, 1, 2}) {
            CAPTURE(first, axis);
            const ShaftStage stage(world.geometry, mirtest::with_nan(lit, first, 48, axis));
            CHECK(different_bits(by_blocks(stage), stage.by_segments()) == 0);
            CHECK(different_bits(by_blocks(stage, {1, 1}), stage.by_segments()) == 0);
        }
}

TEST_CASE("A block in a world without triangles sees everything it faces") {
    mirtest::shaft_empty_suite(by_default);
}

namespace {

/// What a search of the whole block leaves for its packets.
struct Outcomes {
    std::size_t covered = 0;
    std::size_t clear = 0;
    std::size_t listed = 0;  ///< completely
    std::size_t waiting = 0;
    std::size_t forgotten = 0;  ///< luxels hidden by what waits alone
};

using Triangles = decltype(mir::make_triangle_lanes(std::span<const mir::TriangleRows>()));

/// Whether a triangle of the search's list hits the segment.
bool is_listed(const mir::detail::LaneSearch& search, const Triangles& triangles, mir::Vec3 vpl,
               mir::Vec3 luxel) {
    for (std::uint32_t b = 0; b < search.batches; ++b)
        for (std::uint32_t lanes = search.chosen.lanes[b]; lanes != 0;) {
            const std::uint32_t k = mir::detail::pop_lowest(lanes);
            if (hits_segment(triangles[search.batch[b].group].rows(k), vpl, luxel)) return true;
        }
    return false;
}

/// Adds what the search for one block and one VPL comes to.
void search_block(const ShaftStage& stage, const Triangles& triangles,
                  const mir::BlockRecords& block, std::size_t first, mir::Vec3 vpl,
                  const mir::CascadeLimits& limits, Outcomes& outcomes) {
    const auto view = stage.bvh().view();
    mir::detail::LaneSearch search;
    mir::detail::LaneSearcher searcher(view, triangles.data(), block.all, vpl, stage.sigma(),
                                       search);
    if (searcher.run(limits)) {
        ++outcomes.covered;
        return;
    }
    outcomes.clear += search.finds_nothing() ? 1 : 0;
    outcomes.listed += search.batches != 0 && search.waiting.size() == 0 ? 1 : 0;
    outcomes.waiting += search.waiting.size() != 0 ? 1 : 0;
    for (std::size_t i = first; i < first + mir::BlockMask::luxels; ++i) {
        const mir::Hit& hit = stage.lit().luxels[i];
        if (is_empty(hit) || !is_hidden(view, vpl, hit.position)) continue;
        outcomes.forgotten += is_listed(search, triangles, vpl, hit.position) ? 0 : 1;
    }
}

Outcomes search_blocks(const ShaftStage& stage, const mir::CascadeLimits& limits) {
    Outcomes outcomes;
    const Triangles triangles = mir::make_triangle_lanes(stage.bvh().triangles());
    const mirtest::HitRun run(stage.lit().luxels);
    for (std::size_t first = 0; first < run.size(); first += mir::BlockMask::luxels) {
        const mir::BlockRecords block({run.view().planes + first, run.view().stride},
                                      stage.bvh().view().reach, stage.sigma());
        if (!block.all.within) continue;
        for (const mir::Vpl& vpl : stage.lit().vpls)
            search_block(stage, triangles, block, first, vpl.position, limits, outcomes);
    }
    return outcomes;
}

}  // namespace

TEST_CASE("A search lists all that hides a luxel unless nodes wait, which must be noticed") {
    const mirtest::World world = mirtest::sphere_in_box();
    const ShaftStage stage = stage_of(world, 30000, 20);
    const Outcomes all = search_blocks(stage, {100000, 16});
    CHECK(all.covered > 10);
    CHECK(all.clear > 0);
    CHECK(all.listed > 10);
    const Outcomes few = search_blocks(stage, {2, 16});
    CHECK(few.waiting > 10);
    CHECK(few.forgotten > 10);
    const mirtest::World small = soup(false);
    const Outcomes complete = search_blocks(stage_of(small, 2000, 20), {100000, 16});
    CHECK(complete.waiting == 0);
    CHECK(complete.forgotten == 0);
}
