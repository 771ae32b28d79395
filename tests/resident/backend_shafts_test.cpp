// SPDX-License-Identifier: MIT
#include "mir/shaft/device/backend_shafts.hpp"

#include "conformance/masked_soup.hpp"
#include "conformance/shaft_suite.hpp"
#include "mir/host/backend.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/host/wide_bvh_scene.hpp"
#include "support/lazy_backend.hpp"
#include "support/shaft_words.hpp"

// Words by the shafts of a backend, bit for bit those of every triangle asked: docs/shafts.md.

namespace {

using mirtest::different_bits;
using mirtest::Lit;
using mirtest::ShaftStage;
using mirtest::soup;
using mirtest::stage_of;
using HostBackend = mir::host::Backend<mir::InlineExecutor>;

mirtest::ShaftInput input(const ShaftStage& stage) {
    return {stage.hits(), stage.lit().vpls, &stage.bvh(), stage.sigma()};
}

std::vector<std::uint32_t> words(const ShaftStage& stage,
                                 const mir::BackendShaftOptions& options = {}, bool trace = true) {
    mir::InlineExecutor executor;
    return mirtest::shaft_words(HostBackend(executor), input(stage), options, trace);
}

const auto by_default = [](const ShaftStage& stage) { return words(stage); };

}  // namespace

TEST_CASE("Shafts of a backend give the bits of every triangle asked") {
    mirtest::shaft_soup_suite(by_default);
}

TEST_CASE("Most pairs of a closed room are decided without a single segment") {
    const mirtest::World world = mirtest::sphere_in_box();
    const ShaftStage stage = stage_of(world, 30000, 30);
    const auto truth = stage.by_segments();
    CHECK(different_bits(words(stage), truth) == 0);
    const auto untraced = [&](const mir::BackendShaftOptions& options) {
        return different_bits(words(stage, options, false), truth);
    };
    const std::size_t facing = untraced({0, 0});
    CHECK(facing > 10000);
    CHECK(untraced({}) < facing / 10);
}

TEST_CASE("Triangles that a block's shaft found decide its clusters without a search") {
    const mirtest::World world = mirtest::sphere_in_box();
    const ShaftStage stage = stage_of(world, 30000, 30);
    const auto truth = stage.by_segments();
    // No cluster may search, so that what is decided beyond the first is decided by blocks.
    const auto open = [&](const mir::BackendShaftOptions& options) {
        return different_bits(words(stage, options, false), truth);
    };
    const std::size_t listed_by_nobody = open({0, 0});
    CHECK(open({1000, 0}) < listed_by_nobody / 20);
    mir::BackendShaftOptions no_room{1000, 0};
    no_room.leaves = 0;
    CHECK(open(no_room) > listed_by_nobody / 10);
    CHECK(different_bits(words(stage, no_room), truth) == 0);
}

TEST_CASE("Nothing of a deep hierarchy is lost, and lanes take new pairs while others search") {
    const mirtest::World world = mirtest::sphere_in_box(120);
    const ShaftStage stage = stage_of(world, 10000, 40, 24);
    const auto truth = stage.by_segments();
    CHECK(different_bits(words(stage), truth) == 0);
    for (std::uint32_t groups : {1u, 5u}) {
        const mir::BackendShaftOptions thorough{0, 1000, 40, groups};
        CHECK(different_bits(words(stage, thorough), truth) == 0);
        const std::size_t open = different_bits(words(stage, thorough, false), truth);
        CHECK(open < different_bits(words(stage, {0, 0}, false), truth) / 2);
    }
}

TEST_CASE("No limit of a backend's shafts changes a bit") {
    const mirtest::World world = soup(GENERATE(false, true));
    const ShaftStage stage = stage_of(world, 700, 30);
    const auto truth = stage.by_brute_force();
    for (std::uint32_t of_block : {0u, 1u, 2u, 5u, 1000u})
        for (std::uint32_t of_cluster : {0u, 1u, 2u, 3u, 5u, 8u, 1000u}) {
            CAPTURE(of_block, of_cluster);
            CHECK(different_bits(words(stage, {of_block, of_cluster}), truth) == 0);
        }
}

TEST_CASE("No batch of VPLs and no number of groups changes a bit") {
    const mirtest::World world = soup(false);
    const ShaftStage stage = stage_of(world, 3000, 37);
    const auto truth = stage.by_brute_force();
    for (std::uint32_t vpls : {1u, 2u, 36u, 37u, 38u})
        for (std::uint32_t groups : {1u, 3u, 1000u}) {
            CAPTURE(vpls, groups);
            CHECK(different_bits(words(stage, {48, 96, vpls, groups}), truth) == 0);
        }
    CHECK_THROWS_AS(words(stage, {48, 96, 0, 1}), mir::Error);
    CHECK_THROWS_AS(words(stage, {48, 96, 1, 0}), mir::Error);
}

TEST_CASE("No room for leaves changes a bit") {
    const mirtest::World world = soup(false);
    const ShaftStage stage = stage_of(world, 3000, 37);
    const auto truth = stage.by_brute_force();
    for (std::uint32_t leaves : {0u, 1u, 7u, 8u, 9u, 100u, 5000u}) {
        CAPTURE(leaves);
        CHECK(different_bits(words(stage, {48, 96, 37, 16, leaves}), truth) == 0);
    }
}

TEST_CASE("Any number of luxels and of VPLs is right for a backend's shafts") {
    mirtest::shaft_count_suite(by_default, {0, 1, 33, 256, 513, 8193}, {0, 1, 33});
}

TEST_CASE("Luxels and VPLs beyond reach, and those that are no number, are asked one by one") {
    const mirtest::World world = soup(false);
    Lit lit = mirtest::lit_beyond_reach(world);
    lit.luxels[77].position.y = std::numeric_limits<float>::quiet_NaN();
    const ShaftStage stage(world.geometry, lit);
    CHECK(different_bits(words(stage), stage.by_segments()) == 0);
}

TEST_CASE("A luxel that is no number changes no bit of its neighbours by a backend's shafts") {
    const bool room = GENERATE(false, true);
    const mirtest::World world = room ? mirtest::sphere_in_box() : soup(false);
    const Lit lit =
        mirtest::clustered(mirtest::random_lit(world.geometry, 5120, 60, mirtest::test_random(23)));
    const std::size_t first = GENERATE(std::size_t{0}, 1, 16, 40);
    const int axis = GENERATE(0, 1, 2);
    CAPTURE(room, first, axis);
    const ShaftStage stage(world.geometry, mirtest::with_nan(lit, first, 48, axis));
    CHECK(different_bits(words(stage), stage.by_segments()) == 0);
}

TEST_CASE("Shafts of a backend refuse what they have no room for") {
    mir::InlineExecutor executor;
    const HostBackend backend(executor);
    const mirtest::World world = soup(false);
    const ShaftStage stage = stage_of(world, 500, 9);
    auto queue = backend.queue();
    const mirtest::UploadedWideBvh<HostBackend> bvh(backend, queue, stage.bvh());
    const mir::ClusterVisibility<mir::WideBvhVisibility<mir::Space::host>> visibility{
        bvh.quantised(), stage.sigma(), {bvh.view()}};
    std::vector<std::uint32_t> out(512 / 32 * 9);
    std::optional<mir::BlockedLayout> layout;
    const auto fill = [&](std::uint32_t luxels, std::uint32_t vpls, std::uint32_t asked) {
        mir::BackendShafts<HostBackend> shafts(backend, luxels, vpls);
        shafts.fill(queue, mir::SoaView<const mir::Hit>{stage.hits().planes, asked}, layout,
                    mir::span_of(stage.lit().vpls), visibility, out.data());
    };
    CHECK_NOTHROW(fill(512, 9, 512));
    CHECK_THROWS_AS(fill(256, 9, 512), mir::Error);
    CHECK_THROWS_AS(fill(512, 8, 512), mir::Error);
    CHECK_THROWS_AS(fill(512, 9, 500), mir::Error);
    layout = mir::BlockedLayout{2, 1};
    CHECK_NOTHROW(fill(512, 9, 512));
    layout = mir::BlockedLayout{3, 1};
    CHECK_THROWS_AS(fill(512, 9, 512), mir::Error);
}

TEST_CASE("Luxels that are put into clusters by pages keep their bits") {
    // Whole pages, and such as are cut off on the right, below, or both.
    const auto [blocks_x, blocks_y] =
        GENERATE(table<std::uint32_t, std::uint32_t>({{2, 2}, {4, 2}, {5, 2}, {1, 8}, {3, 3}}));
    INFO(blocks_x << " x " << blocks_y << " blocks");
    const mir::BlockedLayout layout{blocks_x, blocks_y};
    const mirtest::World world = soup(false);
    const ShaftStage stage = stage_of(world, layout.size(), 70);
    REQUIRE(stage.hits().stride == layout.size());
    mirtest::ShaftInput in = input(stage);
    in.layout = layout;
    mir::InlineExecutor executor;
    const auto found = mirtest::shaft_words(HostBackend(executor), in, {});
    CHECK(different_bits(found, stage.by_segments()) == 0);
}

TEST_CASE("Shafts of a backend that runs late, or on many threads, give the same words") {
    const mirtest::World world = mirtest::sphere_in_box();
    const ShaftStage stage = stage_of(world, 5000, 30);
    const auto truth = words(stage);
    mir::TbbExecutor many(4);
    CHECK(mirtest::shaft_words(mir::host::Backend(many), input(stage), {}) == truth);
    mirtest::PutOff work(0);
    CHECK(mirtest::shaft_words(mirtest::LazyBackend(work), input(stage), {}) == truth);
}

TEST_CASE("Shafts of a backend see through what single segments see through") {
    const mirtest::World world =
        mirtest::masked_soup(GENERATE(12u, 200u), 92, mirtest::see_through_materials());
    const ShaftStage stage = stage_of(world, 3000, 70);
    const mir::WorldGeometry& geometry = world.geometry;
    const mir::TrianglesByOpacity parts = mir::triangles_by_opacity(geometry);
    mir::InlineExecutor executor;
    const HostBackend backend(executor);
    auto queue = backend.queue();
    const mir::WideBvh opaque = mir::build_wide_bvh(geometry, parts.opaque, executor);
    const mir::WideBvh open = mir::build_wide_bvh(geometry, parts.open, executor);
    const mirtest::UploadedWideBvh<HostBackend> opaque_there(backend, queue, opaque);
    const mirtest::UploadedWideBvh<HostBackend> open_there(backend, queue, open);
    using Sight = mir::WideBvhVisibility<mir::Space::host>;
    const mir::VeiledClusterVisibility<Sight, Sight> visibility{
        opaque_there.quantised(),
        stage.sigma(),
        {opaque_there.view()},
        open_there.quantised(),
        {open_there.view(), geometry.opacity()}};
    const std::vector<mir::Vpl>& vpls = stage.lit().vpls;
    std::vector<std::uint32_t> found(stage.hits().stride / 32 * vpls.size(), ~0u);
    mir::BackendShafts<HostBackend> shafts(backend, stage.hits().stride,
                                           static_cast<std::uint32_t>(vpls.size()), {48, 96, 40});
    shafts.fill(queue, stage.hits(), std::nullopt, mir::span_of(vpls), visibility, found.data());

    const mir::WideBvhScene all(geometry);
    std::vector<std::uint32_t> truth(found.size());
    std::size_t behind_open = 0;
    for (std::uint32_t i = 0; i < stage.hits().stride; ++i)
        for (std::size_t j = 0; j < vpls.size(); ++j) {
            const mir::Hit hit = stage.hits().load(i);
            if (!faces(hit, vpls[j])) continue;
            const bool seen = all.visibility().visible(vpls[j].position, hit.position);
            truth[i / 32 * vpls.size() + j] |= static_cast<std::uint32_t>(seen) << i % 32;
            behind_open +=
                !seen && visibility.segments.visible(vpls[j].position, hit.position) ? 1 : 0;
        }
    CHECK(different_bits(found, truth) == 0);
    CHECK(behind_open > 300);
}
