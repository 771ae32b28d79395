// SPDX-License-Identifier: MIT
#include "mir/sched/cpu.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/scheduler_suite.hpp"
#include "support/catch.hpp"

namespace {

using Matte = mirtest::Stage<mir::Lambert, mirtest::BruteForceScene>;

}  // namespace

TEST_CASE("sched::Cpu keeps the axioms of Scheduler") {
    const Matte stage({100, 70}, {48, 32}, 37);
    mir::InlineExecutor executor;
    mirtest::scheduler_suite(mir::sched::Cpu{executor}, stage);
}

TEST_CASE("The image of sched::Cpu does not depend on the size of tiles") {
    const mir::VplShading<mir::Lambert> shading{2.0f};
    const auto wanted = mirtest::oracle(Matte({100, 70}, {48, 32}, 37), shading);
    const std::uint32_t side = GENERATE(16u, 64u, 256u);
    const Matte stage({100, 70}, {side, side}, 37);
    CHECK(mirtest::pixels_that_differ(mirtest::oracle(stage, shading), wanted) == 0);
}

TEST_CASE("sched::Cpu sums contribution() over the VPLs in their order") {
    const Matte stage({40, 30}, {16, 16}, 9);
    const mir::VplShading<mir::Lambert> shading{};
    const auto image = mirtest::oracle(stage, shading);
    std::size_t wrong = 0;
    for (mir::TileIndex t = 0; t < stage.gbuffer().tiles().size(); ++t) {
        const mir::Tile tile = stage.gbuffer().tiles()[t];
        const auto layout = mir::BlockedLayout::of(tile);
        const auto view = stage.gbuffer().view(t);
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                const mir::Hit hit = view.hit(layout(x, y));
                mir::Rgb sum;
                for (mir::VplIndex j = 0; j < stage.vpls().size() && !is_empty(hit); ++j)
                    sum += contribution(hit, view.surface(layout(x, y)), stage.vpls()[j],
                                        stage.visibility(), shading);
                wrong += image(tile.x + x, tile.y + y) == sum ? 0 : 1;
            }
    }
    CHECK(wrong == 0);
}

TEST_CASE("sched::Cpu counts contributions and stops when it is told to") {
    const Matte stage({20, 20}, {16, 16}, 3);
    mir::InlineExecutor executor;
    mir::Monitor monitor;
    const auto run = [&] {
        return mir::reconstruct(mir::sched::Cpu{executor, &monitor}, stage.gbuffer(), stage.vpls(),
                                stage.visibility(), mir::VplShading<mir::Lambert>{});
    };
    static_cast<void>(run());
    CHECK(monitor.contributions == 1200);
    monitor.cancelled = true;
    try {
        static_cast<void>(run());
        FAIL("a cancelled render went on");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::cancelled);
    }
}
