// SPDX-License-Identifier: MIT
//
// What a host's own executor, BSDF, ray caster or visibility throws reaches the host as it is, from
// every stage and from any thread; the next run is right. With the address sanitizer these are
// tests for leaks as well.
#include "faults/failing_host.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/compare/flip.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/film/film.hpp"
#include "mir/film/guides.hpp"
#include "mir/host/backend.hpp"
#include "mir/host/shaft_scene.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/place_vpls.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/reference/trace_reference.hpp"
#include "mir/resident/backend_film.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/scenes.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/sched/shading_only.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

using mirtest::FailingCall;
using mirtest::FailingMoment;
using mirtest::HostFailure;

namespace {

using Bsdf = mirtest::FailingLambert;
using Executor = mirtest::FailingExecutor<mir::TbbExecutor>;
using Caster = mirtest::FailingRayCaster<mir::KdRayCaster<mir::Space::host>>;
using Sight = mirtest::FailingVisibility<mir::KdTreeVisibility<mir::Space::host>>;
using Luxels = mir::BlockedGBuffer<Bsdf::Params>;
using Picture = mir::Image<mir::Rgb>;

/// Every stage that a host can call with an executor, a BSDF, a ray caster or a visibility of its
/// own, one after the other.
class Stages {
 public:
    /// What of the host fails.
    Executor executor{threads_};
    FailingCall sight;
    FailingCall rays;
    FailingCall views;

    /// The pictures of all stages.
    std::vector<Picture> run() {
        const mir::WorldGeometry geometry(scene_, {}, executor);
        return run(geometry);
    }

 private:
    std::vector<Picture> run(const mir::WorldGeometry& geometry);
    void reconstruct_with_each(std::vector<Picture>& pictures, const Luxels& luxels,
                               const mir::VplList& vpls, const Sight& visibility);

    mir::TbbExecutor threads_{3};
    mir::Scene scene_ = mir::builtin::make("cornell-box");
    mir::VplShading<Bsdf> shading_{.bound = 20.0f};
};

mir::MetropolisOptions few_chains() {
    mir::MetropolisOptions o;
    o.states = 16;
    o.chains = 4;
    o.stride = 2;
    o.emitter_vpls = true;
    o.bootstrap = {0.3, 200, 1000};
    return o;
}

std::vector<Picture> Stages::run(const mir::WorldGeometry& geometry) {
    const mir::SurfaceTable<Bsdf> surfaces(scene_);
    const mir::LightTable lights(scene_, geometry);
    const mir::KdTreeScene tree(geometry, executor);
    const mir::ShaftScene shafts(geometry, executor);
    const Caster caster{tree.ray_caster(), &rays};
    const Sight visibility{tree.visibility(), &sight};

    const mir::CameraRays camera{scene_.cameras[0], {{18, 17}}};
    Luxels luxels(camera.grid.luxels(), {16, 16});
    fill_gbuffer(luxels, 0, camera, caster, surfaces, executor);
    const mir::PathWorld world{geometry,   lights,        surfaces, caster,
                               visibility, camera.camera, 1.0f,     shading_.bound};
    const mir::PlacedVpls placed = place_vpls(mir::MetropolisSampler(world, few_chains()), luxels,
                                              visibility, shading_, executor);
    std::vector<Picture> pictures;
    reconstruct_with_each(pictures, luxels, placed.vpls, visibility);
    pictures.push_back(reconstruct(mir::sched::CpuBlocks{executor}, luxels, placed.vpls.span(),
                                   shafts.visibility(), shading_));
    const mirtest::FailingLuxels<Luxels> shown{luxels, &views};
    for (const Picture& one :
         {reconstruct(mir::sched::Cpu{executor}, shown, placed.vpls.span(), visibility, shading_),
          reconstruct(mir::sched::CpuBlocks{executor}, shown, placed.vpls.span(), visibility,
                      shading_)})
        pictures.push_back(one);
    mir::Film film(camera.grid, mir::default_filter(mir::FilterKind::lanczos), 1);
    film.add_rows(executor, 0, pictures.front());
    pictures.push_back(film.develop(executor, 0));
    mir::Guides guides(camera.grid.pixels);
    add_guides<Bsdf>(guides, luxels, 0, camera.grid, camera.camera, executor);
    pictures.push_back(guides.albedo);
    const mir::PathTracer<Bsdf, Caster, Sight> tracer(
        {geometry, lights, surfaces, caster, visibility}, {});
    pictures.push_back(
        trace_reference(tracer, camera, {.samples = 1, .replicates = 1}, executor).beauty());
    const mir::Image<float> error = ldr_flip(pictures[0], pictures[1], 60.0f, executor);
    REQUIRE(*std::max_element(error.pixels().begin(), error.pixels().end()) == 0.0f);
    return pictures;
}

void Stages::reconstruct_with_each(std::vector<Picture>& pictures, const Luxels& luxels,
                                   const mir::VplList& vpls, const Sight& visibility) {
    const mir::host::Backend backend(executor);
    const auto add = [&](const auto& scheduler) {
        pictures.push_back(reconstruct(scheduler, luxels, vpls.span(), visibility, shading_));
    };
    add(mir::sched::Cpu{executor});
    add(mir::sched::CpuBlocks{executor});
    add(mir::sched::ShadingOnly{backend, executor});
    add(mir::sched::Reconstruct{backend});
}

bool same(const std::vector<Picture>& a, const std::vector<Picture>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
        return std::equal(p.pixels().begin(), p.pixels().end(), q.pixels().begin(),
                          q.pixels().end());
    });
}

/// Whether `use` is an error that names a band that was added in part.
template <class Use>
bool is_refused(const Use& use) {
    try {
        use();
    } catch (const mir::Error& e) {
        return e.code() == mir::ErrorCode::invalid_argument &&
               std::string(e.what()).find("part") != std::string::npos;
    }
    return false;
}

/// Whether `stages` end by the failure that was armed, number `n`.
bool fails_with(Stages& stages, std::uint64_t n) {
    try {
        stages.run();
    } catch (const HostFailure& failure) {
        return failure.number == n;
    }
    return false;
}

}  // namespace

TEST_CASE("what an executor throws reaches the caller from every loop, and the next run is right") {
    Stages stages;
    const std::vector<Picture> whole = stages.run();
    const std::uint64_t loops = stages.executor.loops();
    INFO(loops << " loops");
    REQUIRE(loops > 30);
    const auto moment =
        GENERATE(FailingMoment::before, FailingMoment::in_the_middle, FailingMoment::at_the_end);
    std::vector<std::uint64_t> silent;
    for (std::uint64_t loop = 1; loop <= loops; ++loop) {
        stages.executor.arm(loop, moment);
        if (!fails_with(stages, loop)) silent.push_back(loop);
    }
    CHECK(silent == std::vector<std::uint64_t>{});
    stages.executor.arm(FailingCall::never, moment);
    CHECK(same(stages.run(), whole));
}

TEST_CASE("what a host's BSDF, rays, visibility and luxels throw reaches it, at whatever call") {
    Stages stages;
    const std::vector<Picture> whole = stages.run();
    const std::array<FailingCall*, 4> parts{&Bsdf::call, &stages.rays, &stages.sight,
                                            &stages.views};
    FailingCall* const call = parts[GENERATE(0u, 1u, 2u, 3u)];
    call->arm(FailingCall::never);
    static_cast<void>(stages.run());
    const std::uint64_t calls = call->calls();
    REQUIRE(calls > 5);
    std::vector<std::uint64_t> silent;
    for (std::uint64_t n = 1; n < calls; n = n + n / 4 + 1) {
        call->arm(n);
        if (!fails_with(stages, n)) silent.push_back(n);
    }
    CHECK(silent == std::vector<std::uint64_t>{});
    call->arm(FailingCall::never);
    CHECK(same(stages.run(), whole));
}

TEST_CASE("a film to which a band was added in part says so, and adds and shows nothing more") {
    mir::InlineExecutor one;
    mirtest::FailingExecutor executor(one);
    const mir::LuxelGrid grid{{600, 4}};
    const Picture band({600, 2}, {1.0f, 1.0f, 1.0f});
    const auto moment =
        GENERATE(FailingMoment::before, FailingMoment::in_the_middle, FailingMoment::at_the_end);
    mir::Film film(grid, mir::default_filter(mir::FilterKind::box), 1);
    film.add_rows(executor, 0, band);
    executor.arm(1, moment);
    CHECK_THROWS_AS(film.add_rows(executor, 2, band), HostFailure);
    CHECK(is_refused([&] { film.add_rows(executor, 2, band); }));
    CHECK(is_refused([&] { static_cast<void>(film.develop()); }));
    const mir::Film copy = film;
    CHECK(is_refused([&] { static_cast<void>(copy.develop()); }));
}

TEST_CASE("a film on a backend refuses further bands after an error of the backend") {
    mir::InlineExecutor one;
    mirtest::FailingExecutor executor(one);
    const mir::host::Backend backend(executor);
    auto queue = backend.queue();
    const mir::LuxelGrid grid{{40, 4}};
    const auto band = [&] {
        std::vector<mir::BackendLayer<std::remove_const_t<decltype(backend)>>> layers;
        layers.emplace_back(backend,
                            mir::TileGrid::of({40, 2}, mir::cut_into_tiles({40, 2}, {16, 16})));
        return layers;
    };
    const std::uint64_t loop = GENERATE(1u, 2u, 3u);
    mir::BackendFilm film(backend, queue, grid, mir::default_filter(mir::FilterKind::box), 1, 1, 2);
    auto first = band();
    executor.arm(loop, FailingMoment::in_the_middle);
    CHECK_THROWS_AS(film.add_rows(queue, 0, first), HostFailure);
    for (const std::uint32_t row : {0u, 2u})
        CHECK(is_refused([&] { film.add_rows(queue, row, first); }));
}
