// SPDX-License-Identifier: MIT
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/host/shaft_scene.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scenes.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <array>
#include <thread>

// Under the thread sanitizer the first is a test for races as well. It sees work of several threads
// in one arena of oneTBB, whose binary is not built with it, as a race.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define MIRTEST_NO_SHARED_ARENA
#endif
#endif

namespace {

using Bsdf = mir::Lambert;
using Picture = mir::Image<mir::Rgb>;

/// What several renders may share.
struct World {
    mir::Scene scene = mir::builtin::make("cornell-box");
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<Bsdf> surfaces{scene};
    mir::KdTreeScene tree{geometry};
    mir::ShaftScene shafts{geometry};
};

/// A picture whose VPLs depend on the seed.
template <mir::Executor E>
Picture render(const World& world, E& executor, std::uint64_t seed) {
    const mir::CameraRays rays{world.scene.cameras[0], {{40, 36}}};
    mir::BlockedGBuffer<Bsdf::Params> luxels(rays.grid.luxels(), {32, 32});
    fill_gbuffer(luxels, 0, rays, world.tree.ray_caster(), world.surfaces, executor);
    using Caster = decltype(world.tree.ray_caster());
    const mir::InstantRadiositySampler<Bsdf, Caster> sampler(
        {world.geometry, world.lights, world.surfaces, world.tree.ray_caster()},
        {.vpls = 40, .seed = seed});
    const mir::VplList vpls = aggregate(sampler.sample(executor));
    return reconstruct(mir::sched::CpuBlocks{executor}, luxels, vpls.span(),
                       world.shafts.visibility(), mir::VplShading<Bsdf>{.bound = 20.0f});
}

/// draw(world, i) for three i, a thread each.
template <class Draw>
std::array<Picture, 3> render_together(const World& world, const Draw& draw) {
    std::array<Picture, 3> pictures;
    {
        std::array<std::jthread, 3> threads;
        for (std::size_t i = 0; i < threads.size(); ++i)
            threads[i] = std::jthread([&, i] { pictures[i] = draw(world, i); });
    }
    return pictures;
}

bool same(const Picture& a, const Picture& b) {
    return std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin(), b.pixels().end());
}

}  // namespace

TEST_CASE("renders at the same time share scene and structures, and keep their bits") {
    const World world;
    std::array<Picture, 3> alone;
    mir::InlineExecutor one;
    for (std::size_t i = 0; i < alone.size(); ++i) alone[i] = render(world, one, i);
    REQUIRE_FALSE(same(alone[0], alone[1]));
    const auto together = render_together(world, [&](const World& w, std::uint64_t seed) {
        mir::InlineExecutor executor;
        return render(w, executor, seed);
    });
    for (std::size_t i = 0; i < alone.size(); ++i) CHECK(same(together[i], alone[i]));
}

#ifndef MIRTEST_NO_SHARED_ARENA
TEST_CASE("renders at the same time share an executor, and keep their bits") {
    const World world;
    mir::TbbExecutor executor(3);
    const auto together = render_together(
        world, [&](const World& w, std::uint64_t seed) { return render(w, executor, seed); });
    mir::InlineExecutor one;
    for (std::size_t i = 0; i < together.size(); ++i)
        CHECK(same(together[i], render(world, one, i)));
}
#endif
