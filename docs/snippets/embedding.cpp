// SPDX-License-Identifier: MIT
//
// Quoted by docs/embedding.md: the library inside a program of a user's own.
#include "conformance/executor_suite.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/mir.hpp"
#include "mir/render.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace {

// region: scene
mir::Scene make_scene() {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    const std::uint32_t lamp = scene.add(mir::emitter("lamp", {0, 0, 0}, {10, 10, 10}));

    mir::Mesh floor;
    floor.material = grey;
    floor.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.place(floor);
    scene.place(mir::builtin::quad("wall", grey, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}));
    scene.place(mir::builtin::quad("lamp", lamp, {-0.2f, 1.5f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}));

    scene.cameras.push_back(mir::Camera::look_at({0, 1, 4}, {0, 0.7f, 0}, {0, 1, 0}, 0.7f));
    return scene;
}
// endregion: scene

// region: places
/// The scene at a place that a surveyor measured, in metres from the middle of the Earth.
mir::Scene make_surveyed_scene() {
    const mir::DVec3 site(4075539.8361, 931735.2713, 4801629.3525);
    mir::Scene scene = make_scene();
    mir::Placements places = mir::placements_of(scene);
    for (mir::DMat4& to_world : places.instances) to_world[3] += glm::dvec4(site, 0.0);
    for (mir::DVec3& place : places.cameras) place += site;
    const std::vector<std::string> remarks = mir::recentre(scene, places);
    if (!remarks.empty()) throw std::runtime_error(remarks.front());
    return scene;  // scene.origin + the position of its camera is where the camera stands
}
// endregion: places

// region: render
mir::RenderResult draw(const mir::Scene& scene, mir::Monitor& monitor) {
    mir::RenderSettings settings;
    settings.image = {64, 48};
    settings.vpls = 128;
    settings.seed = 1;
    return mir::render(scene, settings, &monitor);
}
// endregion: render

// region: names
/// The plain loop of the processor, which others are compared with.
std::unique_ptr<mir::Renderer> oracle() {
    mir::Registry registry;
    mir::add_all_to(registry);
    return registry.make(mir::BackendKind::cpu, "cpu");
}
// endregion: names

// region: executor
/// A thread per core for each loop. A program of its own would hand the work to its own pool.
class Threads {
 public:
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        std::atomic<std::size_t> next{0};
        std::exception_ptr failure;
        std::mutex mutex;
        const auto work = [&] {
            try {
                for (std::size_t i = next++; i < n; i = next++) body(i);
            } catch (...) {
                next = n;
                const std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
            }
        };
        {
            std::vector<std::jthread> threads;  // joined at the end, also if one cannot be started
            for (std::size_t t = 1; t < std::min(n, concurrency()); ++t) threads.emplace_back(work);
            work();
        }
        if (failure) std::rethrow_exception(failure);
    }
    [[nodiscard]] std::size_t concurrency() const {
        return std::max(1u, std::thread::hardware_concurrency());
    }
};
static_assert(mir::Executor<Threads>);
// endregion: executor

}  // namespace

TEST_CASE("The program of the documentation renders and can be watched") {
    // region: monitor
    mir::Monitor monitor;  // readable from any thread while render() runs
    const mir::RenderResult result = draw(make_scene(), monitor);
    const std::uint64_t done = monitor.contributions;
    // endregion: monitor
    CHECK(done == monitor.planned_contributions);
    CHECK(done >= result.statistics.contributions);
    CHECK(result.beauty.extent() == mir::Extent{64, 48});
    CHECK(result.statistics.indirect_luminance > 0.0);
    const mir::RenderSettings plain{.image = {16, 16}, .vpls = 8, .measure_missing = false};
    CHECK(oracle()->render(make_scene(), plain, nullptr).statistics.scheduler == "cpu");
    monitor.cancelled = true;
    CHECK_THROWS_AS(draw(make_scene(), monitor), mir::Error);
}

TEST_CASE("The far scene of the documentation looks as it does at home") {
    const mir::Scene scene = make_surveyed_scene();
    CHECK(glm::length(scene.origin - mir::DVec3(4075540, 931735, 4801629)) < 16.0);
    mir::Monitor monitor;
    const mir::RenderResult far = draw(scene, monitor);
    CHECK(far.statistics.origin == scene.origin);
    const mir::RenderResult home = draw(make_scene(), monitor);
    CHECK(far.statistics.indirect_luminance ==
          mirtest::Approx(home.statistics.indirect_luminance).epsilon(0.1));
}

TEST_CASE("The executor of the documentation keeps the axioms of Executor") {
    Threads threads;
    mirtest::executor_suite(threads);
}

TEST_CASE("The stages of the documentation run on a foreign executor") {
    const mir::Scene scene = make_scene();
    // region: stages
    using Bsdf = mir::CookTorrance;
    Threads threads;
    const mir::WorldGeometry geometry(scene);
    const mir::cpu::EmbreeScene engine(geometry);
    const mir::LightTable lights(scene, geometry);
    const mir::SurfaceTable<Bsdf> surfaces(scene);

    const mir::LuxelGrid grid = mir::luxel_grid({64, 48}, 4);
    const mir::CameraRays rays{scene.cameras[0], grid, 1};
    mir::BlockedGBuffer<Bsdf::Params> gbuffer(grid.luxels(), {256, 256});
    mir::fill_gbuffer(gbuffer, 0, rays, engine.ray_caster(), surfaces, threads);

    const mir::InstantRadiositySampler<Bsdf, mir::cpu::EmbreeRayCaster> sampler(
        {geometry, lights, surfaces, engine.ray_caster()}, {.vpls = 128, .seed = 1});
    const mir::VplList vpls = mir::aggregate(sampler.sample(threads));

    const mir::Image<mir::Rgb> luxels =
        mir::reconstruct(mir::sched::CpuBlocks{threads}, gbuffer, vpls.span(), engine.visibility(),
                         mir::VplShading<Bsdf>{.bound = 20.0f});

    mir::Film film(grid, mir::default_filter(mir::FilterKind::lanczos), 1);
    film.add_rows(threads, 0, luxels);
    const mir::Image<mir::Rgb> picture = film.develop();
    // endregion: stages
    CHECK(picture.extent() == mir::Extent{64, 48});
    double sum = 0.0;
    for (const mir::Rgb& c : picture.pixels()) sum += static_cast<double>(luminance(c));
    CHECK(sum > 0.0);
}
