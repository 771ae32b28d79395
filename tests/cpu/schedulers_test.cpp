// SPDX-License-Identifier: MIT
#include "conformance/scheduler_suite.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "support/catch.hpp"

namespace {

template <mir::Bsdf B>
using EmbreeStage = mirtest::Stage<B, mir::cpu::EmbreeScene>;

}  // namespace

TEMPLATE_TEST_CASE("The host schedulers keep their axioms with Embree, on one thread and on many",
                   "", mir::Lambert, mir::CookTorrance) {
    const EmbreeStage<TestType> stage({100, 70}, {48, 32}, 37);
    mir::TbbExecutor threads(4);
    mir::InlineExecutor one;
    mirtest::scheduler_suite(mir::sched::Cpu{threads}, stage);
    mirtest::scheduler_suite(mir::sched::CpuBlocks{threads}, stage);
    mirtest::scheduler_suite(mir::sched::CpuBlocks{one}, stage);
}

TEST_CASE("Tile sizes and instruction sets do not change a bit of an Embree image") {
    const mir::VplShading<mir::CookTorrance> shading{2.0f};
    const auto wanted =
        mirtest::oracle(EmbreeStage<mir::CookTorrance>({100, 70}, {48, 32}, 37), shading);
    const std::uint32_t side = GENERATE(16u, 64u, 256u);
    const EmbreeStage<mir::CookTorrance> stage({100, 70}, {side, side}, 37);
    mir::TbbExecutor executor;
    for (auto set : {mir::InstructionSet::baseline, mir::best_instruction_set()}) {
        const auto found =
            mir::reconstruct(mir::sched::CpuBlocks{executor, nullptr, set}, stage.gbuffer(),
                             stage.vpls(), stage.visibility(), shading);
        CHECK(mirtest::pixels_that_differ(found, wanted) == 0);
    }
}
