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
#include <cmath>
#include <span>

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
    REQUIRE(most_lighting_a_block(matrix) > 2 * mir::blocks::LitVpls::capacity);
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

TEMPLATE_TEST_CASE("sched::CpuBlocks drops no VPL just within the reach of its shading", "",
                   BruteStage<mir::Lambert>, ShaftStage<mir::Lambert>) {
    const TestType stage({100, 70}, {48, 32}, 1);
    const mir::RemovedByBound<mir::Lambert> removed{100.0f};
    // Straight above every 50th luxel, where the geometry term is a quarter above the bound.
    const float distance = std::sqrt(0.8f * removed.reach_squared());
    std::vector<mir::Vpl> vpls;
    for (mir::TileIndex t = 0; t < stage.gbuffer().tiles().size(); ++t)
        for (mir::LuxelIndex i = 0; i < stage.gbuffer().view(t).size(); i += 50) {
            const mir::Hit hit = stage.gbuffer().view(t).hit(i);
            if (is_empty(hit)) continue;
            vpls.push_back({hit.position + distance * hit.normal, -hit.normal, {1, 2, 3}});
        }
    mir::InlineExecutor executor;
    const auto wanted = mir::reconstruct(mir::sched::Cpu{executor}, stage.gbuffer(),
                                         mir::span_of(vpls), stage.visibility(), removed);
    REQUIRE(mirtest::pixels_that_differ(wanted, mir::Image<mir::Rgb>(stage.gbuffer().extent())) >
            100);
    mir::VisibilityMatrix matrix(stage.gbuffer().tiles(), mir::span_of(vpls).size());
    fill_visibility(matrix, stage.gbuffer(), mir::span_of(vpls), stage.visibility(), executor);
    for (const mir::InstructionSet set : mirtest::instruction_sets()) {
        INFO("instruction set " << static_cast<int>(set));
        const mir::sched::CpuBlocks scheduler{executor, nullptr, set};
        const auto traced = mir::reconstruct(scheduler, stage.gbuffer(), mir::span_of(vpls),
                                             stage.visibility(), removed);
        CHECK(mirtest::pixels_that_differ(traced, wanted) == 0);
        const auto known =
            mir::reshade(scheduler, stage.gbuffer(), mir::span_of(vpls), matrix, removed);
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
        const mir::blocks::BoundedHitBlock block(run.view(), {},
                                                 [](std::uint32_t) { return true; });
        const mir::blocks::BlockBounds& bounds = block.bounds;
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
            const mir::blocks::BoundedHitBlock block(run.view(), {},
                                                     [](std::uint32_t) { return true; });
            // In the plane of the luxels, whatever it faces; and with them in its own.
            CHECK(block.bounds.turned_away_from(in_plane()));
            CHECK(block.bounds.behind({in_plane(), normal, {}}));
            mir::Vec3 before = in_plane();
            before[axis] = std::nextafter(before[axis], side);
            CHECK_FALSE(block.bounds.turned_away_from(before));
            CHECK_FALSE(block.bounds.behind({before, -normal, {}}));
        }
}

namespace {

/// Luxels and a VPL that may lie in the plane of some of them.
struct BlockAndVpl {
    std::vector<mir::Hit> luxels = std::vector<mir::Hit>(mir::BlockMask::luxels);
    mir::Vpl vpl;

    [[nodiscard]] bool is_faced() const {
        return std::ranges::any_of(
            luxels, [&](const mir::Hit& hit) { return !is_empty(hit) && faces(hit, vpl); });
    }
    [[nodiscard]] bool is_rejected(mir::InstructionSet set) const {
        const mirtest::HitRun run(luxels);
        bool is = false;
        mir::run_with(set, [&] {
            const mir::blocks::BoundedHitBlock block(run.view(), {},
                                                     [](std::uint32_t) { return true; });
            is = block.cannot_face(vpl);
        });
        return is;
    }
};

/// In one plane but for rounding, which decides then.
BlockAndVpl flat(mir::Random& random, std::size_t count, float scale) {
    BlockAndVpl all;
    const mir::Vec3 normal = mirtest::direction(random);
    const auto in_plane = [&] {
        return scale * glm::cross(normal, mirtest::point_in_cube(random));
    };
    for (std::size_t k = 0; k < count; ++k) all.luxels[77 * k] = {in_plane(), normal};
    all.vpl = {in_plane(), random.next() < 0.5f ? normal : mirtest::direction(random), {}};
    return all;
}

/// Coordinates and normals of which many are zero, equal or next to each other; some differences
/// overflow at the largest scale.
BlockAndVpl cornered(mir::Random& random, float scale) {
    const auto pick = [&](std::span<const float> from) {
        return from[static_cast<std::size_t>(random.next() * static_cast<float>(from.size()))];
    };
    const auto place = [&] {
        constexpr float at[] = {-1.0f, -0.8f, 0.0f, 0.3f, 0x1.333334p-2f, 0.8f, 1.0f};
        return scale * mir::Vec3(pick(at), pick(at), pick(at));
    };
    const auto normal = [&] {
        constexpr float along[] = {-1.0f, -0.6f, -0.0f, 0.0f, 0.0f, 0.6f, 1.0f};
        return mir::Vec3(pick(along), pick(along), pick(along));
    };
    BlockAndVpl all;
    for (std::size_t k = 0; k < 2; ++k) all.luxels[77 * k] = {place(), normal()};
    all.vpl = {place(), normal(), {}};
    return all;
}

}  // namespace

TEST_CASE("A block's bounds are as exact as the dot products of facing") {
    for (const mir::InstructionSet set : mirtest::instruction_sets()) {
        INFO("instruction set " << static_cast<int>(set));
        mir::Random random = mirtest::test_random(63);
        std::size_t rejected = 0;
        std::size_t differ = 0;
        for (const float scale : {1.0f, 1e6f, 0x1p60f})
            for (int i = 0; i < 3000; ++i) {
                const BlockAndVpl one = flat(random, 1, scale);
                const bool is_rejected = one.is_rejected(set);
                rejected += is_rejected ? 1 : 0;
                differ += is_rejected == one.is_faced() ? 1 : 0;
            }
        CHECK(rejected > 3000);
        CHECK(differ == 0);
    }
}

TEST_CASE("A block's bounds drop no pair where rounding decides or numbers overflow") {
    for (const mir::InstructionSet set : mirtest::instruction_sets()) {
        INFO("instruction set " << static_cast<int>(set));
        mir::Random random = mirtest::test_random(64);
        std::size_t rejected = 0;
        std::size_t rejected_wrongly = 0;
        for (const float scale : {1.0f, 1e6f, 0x1p60f, 3e38f})
            for (int i = 0; i < 20000; ++i) {
                const BlockAndVpl block =
                    i % 2 == 0 ? flat(random, 3, scale) : cornered(random, scale);
                if (!block.is_rejected(set)) continue;
                ++rejected;
                rejected_wrongly += block.is_faced() ? 1 : 0;
            }
        CHECK(rejected > 20000);
        CHECK(rejected_wrongly == 0);
    }
}
