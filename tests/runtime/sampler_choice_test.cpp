// SPDX-License-Identifier: MIT
#include "mir/runtime/sampler_choice.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/stage.hpp"
#include "mir/runtime/render_job.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "support/catch.hpp"

#include <type_traits>
#include <utility>

// Which sampler settings get, and what an engine that samples itself is told.

namespace {

using mir::DirectLight;
using mir::MetropolisOptions;
using mir::NormalisationPolicy;
using mir::RenderSettings;
using mir::SamplerKind;
using mirtest::BruteForceScene;

using Bsdf = mir::CookTorrance;
constexpr float bound = 3.5f;

/// What an engine was asked for.
struct Asked {
    int times = 0;
    const mir::LightTable* lights = nullptr;
    mir::PathView view;
    MetropolisOptions options;
    std::uint64_t vpls = 0;  ///< of the limits
    mir::Monitor* monitor = nullptr;
};

/// An engine that has one answer to everything, and remembers the question.
struct SamplingScene : BruteForceScene {
    using BruteForceScene::BruteForceScene;
    static constexpr std::uint64_t answer = 4711;  ///< VplRecords::paths

    [[nodiscard]] mir::VplRecords sample_metropolis(const mir::LightTable& lights,
                                                    const mir::PathView& view,
                                                    const MetropolisOptions& options,
                                                    const mir::Limits& limits,
                                                    mir::Monitor* monitor) const {
        asked = {asked.times + 1, &lights, view, options, limits.vpls, monitor};
        mir::VplRecords records;
        records.paths = answer;
        return records;
    }
    mutable Asked asked;
};
static_assert(mir::SamplingEngine<SamplingScene>);
static_assert(!mir::SamplingEngine<BruteForceScene>);

RenderSettings settings() {
    RenderSettings s;
    s.image = {40, 30};
    s.luxels_per_pixel = 1;
    s.vpls = 9;
    s.max_bounce = 5;
    s.seed = 77;
    s.metropolis.chains = 3;
    s.limits.vpls = 1234;
    return s;
}

template <class Engine>
struct Render {
    mirtest::World world{mirtest::glossy_box()};
    Engine engine{world.geometry};
    RenderSettings settings;
    mir::InlineExecutor executor;
    mir::Monitor monitor;
    mir::StageClock clock;
    mir::RenderJob<Bsdf, Engine, mir::InlineExecutor> job{
        world.scene, settings, world.geometry, engine, executor, &monitor, clock};

    explicit Render(RenderSettings s) : settings(std::move(s)) {}

    template <class Use>
    auto with_sampler(const Use& use) {
        return mir::with_sampler(job.context(), job.lights, bound, use);
    }
    mir::VplRecords sample() {
        return with_sampler([&](const auto& sampler) { return sampler.sample(executor); });
    }
    /// Whether the engine would be asked.
    bool leaves_it_to_the_engine() {
        return with_sampler([](const auto& sampler) {
            return std::is_same_v<std::remove_cvref_t<decltype(sampler)>,
                                  mir::EngineMetropolis<SamplingScene>>;
        });
    }
};

}  // namespace

TEST_CASE("An engine that samples is asked for Metropolis' records, with all there is to know") {
    RenderSettings s = settings();
    s.direct = GENERATE(DirectLight::separate, DirectLight::vpl);
    Render<SamplingScene> render(s);
    CHECK(render.leaves_it_to_the_engine());
    CHECK(render.engine.asked.times == 0);
    CHECK(render.sample().paths == SamplingScene::answer);
    const Asked& asked = render.engine.asked;
    CHECK(asked.times == 1);
    CHECK(asked.lights == &render.job.lights);
    CHECK(asked.monitor == &render.monitor);
    CHECK(asked.vpls == 1234);
    CHECK(asked.view.bound == bound);
    CHECK(asked.view.aspect == 40.0f / 30.0f);
    const mir::CameraOptics camera = render.job.rays.camera.optics();
    const auto direction = [](const mir::CameraOptics& c) {
        return c.ray({0.2f, 0.7f}, 1, {}).direction;
    };
    CHECK(direction(asked.view.camera) == direction(camera));
    CHECK(asked.options.states == 9);
    CHECK(asked.options.chains == 3);
    CHECK(asked.options.max_bounce == 5);
    CHECK(asked.options.seed == 77);
    CHECK(asked.options.emitter_vpls == (s.direct == DirectLight::vpl));
}

TEST_CASE("Other samplers stay with the executor, whatever the engine can do") {
    RenderSettings s = settings();
    SECTION("instant radiosity") { s.sampler = SamplerKind::instant_radiosity; }
    SECTION("resampled paths") { s.sampler = SamplerKind::bidirectional; }
    SECTION("the proposal's normalisation") { s.normalisation = NormalisationPolicy::proposal; }
    SECTION("nothing to sample") { s.max_bounce = 1; }
    Render<SamplingScene> render(s);
    CHECK_FALSE(render.leaves_it_to_the_engine());
    CHECK(render.engine.asked.times == 0);
}

TEST_CASE("An engine that does not sample leaves chains to the executor") {
    Render<BruteForceScene> render(settings());
    CHECK(render.with_sampler([](const auto& sampler) {
        return mir::Normalisation{sampler.normalisation};
    }) == mir::Normalisation::image_response);
    CHECK_FALSE(render.leaves_it_to_the_engine());
}
