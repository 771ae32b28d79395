// SPDX-License-Identifier: MIT
#include "mir/concepts/scheduler.hpp"

#include "mir/concepts/archetypes.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"

namespace {

namespace archetype = mir::archetype;
using archetype::make;

using Poorest = mir::Inputs<archetype::TiledGBuffer, archetype::VplSet, archetype::Visibility,
                            archetype::Shading>;
static_assert(mir::Pipeline<archetype::Pipeline>);
static_assert(mir::Scheduler<archetype::Scheduler, Poorest>);

struct WithoutSubmit : archetype::Pipeline {
    void submit();
};
static_assert(!mir::Pipeline<WithoutSubmit>);

struct WithoutFinish : archetype::Pipeline {
    void finish(int);
};
static_assert(!mir::Pipeline<WithoutFinish>);

struct WithoutOpen : archetype::Scheduler {
    void open();
};
static_assert(!mir::Scheduler<WithoutOpen, Poorest>);

struct OpensNothing : archetype::Scheduler {
    template <class In>
    void open(const In&, mir::Image<mir::Rgb>&) const {}
};
static_assert(!mir::Scheduler<OpensNothing, Poorest>);

struct OpensOnlyOnce : archetype::Scheduler {
    template <class In>
    archetype::Pipeline open(const In&, mir::Image<mir::Rgb>&) {
        return archetype::Pipeline{make};
    }
};
static_assert(!mir::Scheduler<OpensOnlyOnce, Poorest>);

struct Unrelated {};
static_assert(!mir::Scheduler<Unrelated, Poorest>);

static_assert(mir::Scheduler<mir::sched::Cpu<mir::InlineExecutor>, Poorest>);

}  // namespace

TEST_CASE("reconstruct() asks for no more than its concepts say") {
    const archetype::TiledGBuffer gbuffer{make};
    const auto image =
        mir::reconstruct(archetype::Scheduler{make}, gbuffer, archetype::VplSet{make},
                         archetype::Visibility{make}, archetype::Shading{make});
    CHECK(image.extent() == gbuffer.extent());
    CHECK(image(0, 0) == mir::Rgb{});
}

TEST_CASE("sched::Cpu asks for no more than the concepts of its inputs say") {
    archetype::Executor executor{make};
    const archetype::TiledGBuffer gbuffer{make};
    const auto image = mir::reconstruct(mir::sched::Cpu{executor}, gbuffer, archetype::VplSet{make},
                                        archetype::Visibility{make}, archetype::Shading{make});
    // Two VPLs of intensity (1, 2, 4), passed through as they are.
    for (const mir::Rgb& c : image.pixels()) REQUIRE(c == mir::Rgb{2, 4, 8});
}

TEST_CASE("sched::CpuBlocks asks for no more of executor, VPLs, visibility and BSDF") {
    archetype::Executor executor{make};
    mir::BlockedGBuffer<archetype::Bsdf::Params> gbuffer({20, 10}, {16, 16});
    gbuffer.store(0, 0, {{0, 0, 0}, {0, 0, 1}}, {});
    const auto image =
        mir::reconstruct(mir::sched::CpuBlocks{executor}, gbuffer, archetype::VplSet{make},
                         archetype::PacketVisibility{make}, mir::VplShading<archetype::Bsdf>{});
    for (const mir::Rgb& c : image.pixels()) REQUIRE(c == mir::Rgb{});
}
