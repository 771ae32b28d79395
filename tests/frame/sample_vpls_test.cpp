// SPDX-License-Identifier: MIT
#include "runtime/sample_vpls.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/stage.hpp"
#include "runtime/host_frame.hpp"
#include "support/catch.hpp"

#include <optional>
#include <utility>

// Which sampler settings get, and what a frame that samples itself is told.

namespace {

using mir::DirectLight;
using mir::MetropolisOptions;
using mir::NormalisationPolicy;
using mir::RenderSettings;
using mir::SamplerKind;
using mirtest::BruteForceScene;

constexpr float bound = 3.5f;

/// What a frame was asked for.
struct Asked {
    int times = 0;
    MetropolisOptions options;
    float bound = 0.0f;
};

using Vpls = mir::VplSpan<mir::Space::host>;

/// A frame that has one answer to the question for chains, and remembers it; it can do nothing
/// else but trace rays.
class SamplingFrame final : public mir::RenderFrame {
 public:
    static constexpr std::uint64_t answer = 4711;  ///< VplRecords::paths

    SamplingFrame(mir::RenderJob& job, const mir::AnyEngine& rays)
        : RenderFrame(job, {1, false}), rays_(rays) {}

    const mir::AnyEngine& rays() override {
        ++rays_wanted;
        return rays_;
    }
    mir::VplRecords sample_chains(const MetropolisOptions& options, float under) override {
        asked = {asked.times + 1, options, under};
        mir::VplRecords records;
        records.paths = answer;
        return records;
    }
    mir::VplRecords sample_light_paths(const mir::InstantRadiosityOptions& options) override {
        light_paths_wanted = options;
        mir::VplRecords records;
        records.paths = answer;
        return records;
    }
    mir::PathLuminance light_path_luminance(const mir::VplRecords& records, float under) override {
        CHECK(records.paths == answer);
        CHECK(under == bound);
        return {2.5, 0.5, answer, 7};
    }
    std::vector<mir::CausticSplat> trace_caustics(const mir::CausticPaths&, std::uint64_t,
                                                  std::uint64_t) override {
        return never(std::vector<mir::CausticSplat>{});
    }
    double visible_area() override { return never(0.0); }
    mir::BandPtr trace(mir::Extent, mir::Extent, std::uint32_t) override { return never(nullptr); }
    mir::BandPtr trace(const mir::ProbeRays&) override { return never(nullptr); }
    void find_visible(mir::FrameBand&, mir::VplSpan<mir::Space::host>) override { never(0); }
    void add_responses(const mir::FrameBand&, Vpls, float, mir::BandTurn&,
                       mir::ResponseSum&) override {
        never(0);
    }
    mir::CausticLayers seen_caustics(const mir::FrameBand&,
                                     std::span<const mir::LayerPtr>) override {
        return never(mir::CausticLayers{});
    }
    mir::LayerPtr black(const mir::FrameBand&) override { return never(nullptr); }
    mir::LayerPtr direct(const mir::FrameBand&, mir::DirectSamples) override {
        return never(nullptr);
    }
    mir::LayerPtr emission(const mir::FrameBand&) override { return never(nullptr); }
    mir::LayerPtr coverage(const mir::FrameBand&) override { return never(nullptr); }
    mir::LayerPtr light(const mir::FrameBand&, mir::VplSpan<mir::Space::host>, mir::VplKernel,
                        mir::Monitor*) override {
        return never(nullptr);
    }
    mir::LayerPtr light_by_cuts(const mir::FrameBand&, const mir::CutVpls&, float,
                                mir::Monitor*) override {
        return never(nullptr);
    }
    mir::LayerPtr residual(const mir::FrameBand&, float, std::span<const mir::LayerPtr>) override {
        return never(nullptr);
    }
    mir::LayerPtr layer_of(const mir::FrameBand&, mir::Image<mir::Rgb>) override {
        return never(nullptr);
    }
    void add(mir::FrameLayer&, const mir::FrameLayer&) override { never(0); }
    std::vector<double> row_luminances(const mir::FrameLayer&) override {
        return never(std::vector<double>{});
    }
    void put(const mir::FrameBand&, std::vector<mir::LayerPtr>, mir::BandTurn&) override {
        never(0);
    }
    std::vector<mir::Image<mir::Rgb>> develop() override {
        return never(std::vector<mir::Image<mir::Rgb>>{});
    }
    void develop_rows(std::uint32_t, std::uint32_t, std::vector<mir::Image<mir::Rgb>>&) override {
        never(0);
    }

    Asked asked;
    int rays_wanted = 0;
    std::optional<mir::InstantRadiosityOptions> light_paths_wanted;

 private:
    template <class T>
    static T never(T value) {
        FAIL("a sampler asked for luxels");
        return value;
    }

    const mir::AnyEngine& rays_;
};

RenderSettings settings() {
    RenderSettings s;
    s.image = {40, 30};
    s.luxels_per_pixel = 1;
    s.vpls = 9;
    s.max_bounce = 5;
    s.seed = 77;
    s.metropolis.chains = 3;
    return s;
}

struct Render {
    mirtest::World world{mirtest::glossy_box()};
    mir::TracedScene traced{std::make_unique<const BruteForceScene>(world.geometry)};
    RenderSettings settings;
    mir::InlineExecutor executor;
    mir::StageClock clock;
    mir::RenderJob job;
    SamplingFrame frame{job, traced.rays()};

    explicit Render(RenderSettings s)
        : settings(std::move(s)),
          job({world.scene, world.geometry, mir::AnyExecutor(executor), nullptr, clock}, settings) {
    }
};

}  // namespace

TEST_CASE("A frame is asked for Metropolis' records, with all there is to know") {
    RenderSettings s = settings();
    s.direct = GENERATE(DirectLight::separate, DirectLight::vpl);
    Render render(s);
    const mir::SampledVpls sampled = sample_vpls(render.frame, bound);
    CHECK(sampled.records.paths == SamplingFrame::answer);
    CHECK(sampled.normalisation == mir::Normalisation::image_response);
    const Asked& asked = render.frame.asked;
    CHECK(asked.times == 1);
    CHECK(render.frame.rays_wanted == 0);
    CHECK(asked.bound == bound);
    CHECK(asked.options.states == 9);
    CHECK(asked.options.chains == 3);
    CHECK(asked.options.max_bounce == 5);
    CHECK(asked.options.seed == 77);
    CHECK(asked.options.emitter_vpls == (s.direct == DirectLight::vpl));
}

TEST_CASE("A frame is asked for light paths, and how well they know the brightness") {
    RenderSettings s = settings();
    s.sampler = SamplerKind::instant_radiosity;
    s.termination = mir::Termination::levels;
    s.measure_missing = GENERATE(true, false);
    SECTION("by light paths") {}
    SECTION("that leave nothing to Metropolis") {
        s.sampler = SamplerKind::metropolis;
        s.max_bounce = 1;
        s.measure_missing = true;
    }
    Render render(s);
    const mir::SampledVpls sampled = sample_vpls(render.frame, bound);
    CHECK(sampled.normalisation == mir::Normalisation::none);
    CHECK(sampled.records.paths == SamplingFrame::answer);
    CHECK(render.frame.asked.times == 0);
    CHECK(render.frame.rays_wanted == 0);
    REQUIRE(render.frame.light_paths_wanted);
    CHECK(render.frame.light_paths_wanted->vpls == 9);
    CHECK(render.frame.light_paths_wanted->termination == mir::Termination::levels);
    CHECK(render.frame.light_paths_wanted->seed == 77);
    const bool told = s.measure_missing && s.sampler == SamplerKind::instant_radiosity;
    REQUIRE(sampled.records.light_paths.has_value() == told);
    if (told) CHECK(sampled.records.light_paths->mean == 2.5);
}

TEST_CASE("Other samplers stay with the executor, whatever the frame can do") {
    RenderSettings s = settings();
    SECTION("instant radiosity behind a roulette") {
        s.sampler = SamplerKind::instant_radiosity;
        s.vpl_roulette = true;
    }
    SECTION("resampled paths") { s.sampler = SamplerKind::bidirectional; }
    SECTION("the proposal's normalisation") { s.normalisation = NormalisationPolicy::proposal; }
    Render render(s);
    CHECK(sample_vpls(render.frame, bound).normalisation == mir::Normalisation::none);
    CHECK(render.frame.asked.times == 0);
    CHECK(render.frame.rays_wanted > 0);
}

TEST_CASE("A frame on the host runs chains on the executor") {
    Render render(settings());
    const auto frame = mir::host_frame(render.job, render.traced, mir::HostScheduler::cpu_blocks);
    const mir::SampledVpls sampled = sample_vpls(*frame, bound);
    CHECK(sampled.normalisation == mir::Normalisation::image_response);
    CHECK(sampled.records.health);
}
