// SPDX-License-Identifier: MIT
#include "mir/sched/cpu_blocks.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/scheduler_suite.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/host/shaft_scene.hpp"
#include "mir/reshade.hpp"
#include "support/catch.hpp"
#include "support/instruction_sets.hpp"
#include "support/soa_run.hpp"

#include <algorithm>

namespace {

template <mir::Bsdf B>
using BruteStage = mirtest::Stage<B, mirtest::BruteForceScene>;
/// Whose visibility is asked page by page.
template <mir::Bsdf B>
using ShaftStage = mirtest::Stage<B, mir::ShaftScene>;

/// Pages whose luxels are sorted before visibility is asked.
template <class Stage>
std::uint32_t sorted_pages(const Stage& stage) {
    std::uint32_t count = 0;
    for (mir::TileIndex t = 0; t < stage.gbuffer().tiles().size(); ++t) {
        const mir::LuxelPages pages{mir::BlockedLayout::of(stage.gbuffer().tiles()[t])};
        for (std::uint32_t i = 0; i < pages.count(); ++i)
            count += mir::PageClusters(stage.gbuffer().view(t).hits, pages[i]).is_compact() ? 0 : 1;
    }
    return count;
}

/// VPLs that a luxel of a block sees, of the block with the most. All tiles are one block.
std::uint32_t most_lighting_a_block(const mir::VisibilityMatrix& matrix) {
    std::uint32_t most = 0;
    for (mir::TileIndex t = 0; t < matrix.tiles(); ++t) {
        std::uint32_t count = 0;
        for (mir::VplIndex j = 0; j < matrix.vpls(); ++j) {
            const std::uint16_t* const masks = matrix.view().block_masks(t, 0, j);
            count += std::any_of(masks, masks + 16, [](auto mask) { return mask != 0; }) ? 1u : 0u;
        }
        most = std::max(most, count);
    }
    return most;
}

}  // namespace

TEMPLATE_TEST_CASE("sched::CpuBlocks keeps the axioms of Scheduler with every instruction set", "",
                   mir::Lambert, mir::CookTorrance) {
    const BruteStage<TestType> stage({100, 70}, {48, 32}, 37);
    mir::InlineExecutor executor;
    for (mir::InstructionSet set : mirtest::instruction_sets()) {
        INFO("instruction set " << static_cast<int>(set));
        mirtest::scheduler_suite(mir::sched::CpuBlocks{executor, nullptr, set}, stage);
    }
}

TEMPLATE_TEST_CASE("sched::CpuBlocks keeps the axioms by whole blocks with every instruction set",
                   "", mir::Lambert, mir::CookTorrance) {
    const ShaftStage<TestType> stage({100, 70}, {48, 32}, 37);
    CHECK(sorted_pages(stage) > 0);
    mir::InlineExecutor executor;
    for (mir::InstructionSet set : mirtest::instruction_sets()) {
        INFO("instruction set " << static_cast<int>(set));
        mirtest::scheduler_suite(mir::sched::CpuBlocks{executor, nullptr, set}, stage);
    }
}

TEST_CASE("A matrix filled by whole blocks has the bits of single segments") {
    const ShaftStage<mir::Lambert> stage({100, 70}, {48, 32}, 37);
    CHECK(sorted_pages(stage) > 0);
    mir::InlineExecutor executor;
    for (mir::InstructionSet set : mirtest::instruction_sets()) {
        mir::VisibilityMatrix matrix(stage.gbuffer().tiles(), stage.vpls().size());
        fill_visibility(matrix, stage.gbuffer(), stage.vpls(), stage.visibility(), executor, set);
        std::size_t wrong = 0;
        for (mir::TileIndex t = 0; t < stage.gbuffer().tiles().size(); ++t)
            for (mir::LuxelIndex i = 0; i < stage.gbuffer().view(t).size(); ++i)
                for (mir::VplIndex j = 0; j < stage.vpls().size(); ++j) {
                    const mir::Hit hit = stage.gbuffer().view(t).hit(i);
                    const mir::Vpl vpl = stage.vpls()[j];
                    const bool wanted =
                        faces(hit, vpl) && stage.visibility().visible(vpl.position, hit.position);
                    wrong += matrix.view().sees(t, i, j) != wanted ? 1 : 0;
                }
        CHECK(wrong == 0);
    }
}

TEMPLATE_TEST_CASE("The image of sched::CpuBlocks does not depend on the size of tiles", "",
                   BruteStage<mir::CookTorrance>, ShaftStage<mir::CookTorrance>) {
    const mir::VplShading<mir::CookTorrance> shading{2.0f};
    const auto wanted = mirtest::oracle(TestType({100, 70}, {48, 32}, 37), shading);
    const std::uint32_t side = GENERATE(5u, 16u, 64u, 256u);
    const TestType stage({100, 70}, {side, side}, 37);
    mir::InlineExecutor executor;
    const auto found = mir::reconstruct(mir::sched::CpuBlocks{executor}, stage.gbuffer(),
                                        stage.vpls(), stage.visibility(), shading);
    CHECK(mirtest::pixels_that_differ(found, wanted) == 0);
}

TEMPLATE_TEST_CASE("sched::CpuBlocks adds more VPLs than it shades together", "",
                   BruteStage<mir::CookTorrance>, ShaftStage<mir::CookTorrance>) {
    const TestType stage({40, 30}, {16, 16}, 300);
    const mir::VplShading<mir::CookTorrance> shading{2.0f};
    const auto wanted = mirtest::oracle(stage, shading);
    mir::InlineExecutor executor;
    mir::VisibilityMatrix matrix(stage.gbuffer().tiles(), stage.vpls().size());
    fill_visibility(matrix, stage.gbuffer(), stage.vpls(), stage.visibility(), executor);
    REQUIRE(most_lighting_a_block(matrix) > 2 * mir::sched::detail::LitVpls::capacity);
    for (const mir::InstructionSet set : mirtest::instruction_sets()) {
        INFO("instruction set " << static_cast<int>(set));
        const mir::sched::CpuBlocks scheduler{executor, nullptr, set};
        const auto traced =
            mir::reconstruct(scheduler, stage.gbuffer(), stage.vpls(), stage.visibility(), shading);
        CHECK(mirtest::pixels_that_differ(traced, wanted) == 0);
        const auto known = mir::reshade(scheduler, stage.gbuffer(), stage.vpls(), matrix, shading);
        CHECK(mirtest::pixels_that_differ(known, wanted) == 0);
    }
}

TEMPLATE_TEST_CASE("sched::CpuBlocks counts contributions and stops when it is told to", "",
                   BruteStage<mir::Lambert>, ShaftStage<mir::Lambert>) {
    const TestType stage({20, 20}, {16, 16}, 3);
    mir::InlineExecutor executor;
    mir::Monitor monitor;
    const auto run = [&] {
        return mir::reconstruct(mir::sched::CpuBlocks{executor, &monitor}, stage.gbuffer(),
                                stage.vpls(), stage.visibility(), mir::VplShading<mir::Lambert>{});
    };
    static_cast<void>(run());
    CHECK(monitor.contributions == 1200);
    monitor.cancelled = true;
    CHECK_THROWS_AS(run(), mir::Error);
}

TEST_CASE("A block's bounds never reject a VPL that faces one of its luxels") {
    mir::Random random = mirtest::test_random(61);
    std::size_t behind = 0;
    std::size_t turned_away = 0;
    std::size_t rejected_wrongly = 0;
    for (int i = 0; i < 20000; ++i) {
        const mir::Vec3 centre = mirtest::point_in_cube(random);
        const mir::Vec3 normal = mirtest::direction(random);
        // From a flat block to one around a corner.
        const float spread = i % 3 == 0 ? 0.0f : random.next();
        std::vector<mir::Hit> hits;
        std::vector<mir::Hit> luxels(mir::BlockMask::luxels);
        for (std::size_t k = 0; k < 8; ++k) {
            const mir::Vec3 position = centre + 0.1f * mirtest::point_in_cube(random);
            const mir::Vec3 tilt = spread * mirtest::point_in_cube(random);
            hits.push_back({position, glm::normalize(normal + 0.5f * tilt)});
            luxels[(37 * k + static_cast<std::size_t>(i)) % luxels.size()] = hits.back();
        }
        const mirtest::HitRun run(luxels);
        const mir::sched::detail::BoundedHitBlock block(run.view(), {},
                                                        [](std::uint32_t) { return true; });
        const mir::sched::detail::BlockBounds& bounds = block.bounds;
        // Half of the VPLs lie on a luxel, so that rounding decides.
        const mir::Vec3 anywhere = mirtest::point_in_cube(random);
        const mir::Vpl vpl{
            i % 2 == 0 ? hits[0].position : anywhere, mirtest::direction(random), {}};
        behind += bounds.behind(vpl) ? 1 : 0;
        turned_away += bounds.turned_away_from(vpl.position) ? 1 : 0;
        const bool rejected = bounds.behind(vpl) || bounds.turned_away_from(vpl.position);
        for (const mir::Hit& hit : hits) {
            rejected_wrongly += rejected && faces(hit, vpl) ? 1 : 0;
            // The slack is for the rounding of both sides.
            const float d2 = mir::length_squared(vpl.position - hit.position);
            if (bounds.distance_squared(vpl.position) > d2 * (1.0f + 0x1p-16f)) ++rejected_wrongly;
        }
    }
    CHECK(behind > 1000);
    CHECK(turned_away > 1000);
    CHECK(rejected_wrongly == 0);
}

TEST_CASE("A block's bounds reject VPLs that lie in the plane of its luxels") {
    mir::Random random = mirtest::test_random(62);
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            INFO("axis " << axis << ", side " << side);
            mir::Vec3 normal{0.0f};
            normal[axis] = side;
            const auto in_plane = [&] {
                mir::Vec3 p = 7.0f * mirtest::point_in_cube(random);
                p[axis] = 0.3f;
                return p;
            };
            std::vector<mir::Hit> luxels(mir::BlockMask::luxels);
            for (mir::Hit& hit : luxels) hit = {in_plane(), normal};
            const mirtest::HitRun run(luxels);
            const mir::sched::detail::BoundedHitBlock block(run.view(), {},
                                                            [](std::uint32_t) { return true; });
            // In the plane of the luxels, whatever it faces; and with them in its own.
            CHECK(block.bounds.turned_away_from(in_plane()));
            CHECK(block.bounds.behind({in_plane(), normal, {}}));
            mir::Vec3 before = in_plane();
            before[axis] += 0x1p-20f * side;
            CHECK_FALSE(block.bounds.turned_away_from(before));
            CHECK_FALSE(block.bounds.behind({before, -normal, {}}));
        }
}

namespace {

/// A block of one or three luxels of a plane, and a VPL in it but for rounding, which decides then.
struct FlatBlock {
    std::vector<mir::Hit> luxels = std::vector<mir::Hit>(mir::BlockMask::luxels);
    mir::Vpl vpl;

    FlatBlock(mir::Random& random, std::size_t count, float scale, bool is_parallel) {
        const mir::Vec3 normal = mirtest::direction(random);
        const auto in_plane = [&] {
            return scale * glm::cross(normal, mirtest::point_in_cube(random));
        };
        for (std::size_t k = 0; k < count; ++k) luxels[77 * k] = {in_plane(), normal};
        vpl = {in_plane(), is_parallel ? normal : mirtest::direction(random), {}};
    }

    [[nodiscard]] bool is_faced() const {
        return std::ranges::any_of(
            luxels, [&](const mir::Hit& hit) { return !is_empty(hit) && faces(hit, vpl); });
    }
    [[nodiscard]] bool is_rejected() const {
        const mirtest::HitRun run(luxels);
        return mir::sched::detail::BoundedHitBlock(run.view(), {},
                                                   [](std::uint32_t) { return true; })
            .cannot_face(vpl);
    }
};

}  // namespace

TEST_CASE("A block's bounds are as exact as the dot products of facing") {
    mir::Random random = mirtest::test_random(63);
    std::size_t rejected = 0;
    std::size_t rejected_wrongly = 0;
    std::size_t kept_of_one_luxel = 0;
    // At the largest scale some differences are no numbers any more, for which nothing is exact.
    for (const float scale : {1.0f, 1e6f, 0x1p66f, 2e38f})
        for (int i = 0; i < 5000; ++i) {
            const std::size_t count = i % 2 == 0 ? 1 : 3;
            const FlatBlock block(random, count, scale, i % 4 < 2);
            const bool is_rejected = block.is_rejected();
            const bool is_faced = block.is_faced();
            rejected += is_rejected ? 1 : 0;
            rejected_wrongly += is_rejected && is_faced ? 1 : 0;
            const bool is_exact = count == 1 && scale < 1e38f;
            kept_of_one_luxel += is_exact && !is_rejected && !is_faced ? 1 : 0;
        }
    CHECK(rejected > 5000);
    CHECK(rejected_wrongly == 0);
    CHECK(kept_of_one_luxel == 0);
}
