// SPDX-License-Identifier: MIT
//
// What a render says that its VPLs leave out, against closed forms and the path tracer.
#include "bounce_means.hpp"
#include "mir/runtime/pass_statistics.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::ShareEstimate;

namespace {

constexpr std::uint64_t runs = 16;

/// What 16 seeds say of one share.
struct Stated {
    Moments share;
    Moments error;
    double worst = 0.0;  ///< largest distance from the truth in standard errors

    Stated(const mir::Scene& scene, mir::RenderSettings s,
           std::optional<ShareEstimate> mir::RenderStatistics::*member, double truth) {
        for (s.seed = 0; s.seed < runs; ++s.seed) {
            const auto e = render(scene, s).statistics.*member;
            REQUIRE(e);
            share.add(e->share);
            error.add(e->standard_error);
            worst = std::max(worst, std::abs(e->share - truth) / e->standard_error);
        }
    }
};

mir::RenderSettings few_vpls(mir::SamplerKind sampler) {
    mir::RenderSettings s = small_settings(16, 64);
    s.measure_missing = true;
    s.sampler = sampler;
    s.direct_samples = 1;
    s.metropolis.bootstrap = {1.0, 1u << 12, 1u << 12};
    return s;
}

/// Mean luminance of the indirect light over the film, of one part under a bound.
double traced(const Studio<mir::CookTorrance>& studio, mir::BoundPart part, float bound) {
    mir::ReferenceOptions options;
    options.samples = 512;
    options.replicates = 1;
    options.film = mir::FilmPosition::pixel;
    options.last_bounce = 1;
    mir::TbbExecutor executor;
    const auto image = trace_reference(studio.tracer({.bound = bound, .part = part}),
                                       studio.rays(32, 71), options, executor);
    return mean_luminance(image.beauty()) - mean_luminance(image.up_to(1));
}

/// A room with a glossy floor, seen so closely that its corner fills the picture.
mir::Scene glossy_corner() {
    mir::Scene scene = mir::builtin::make("corner");
    for (mir::Material& m : scene.materials)
        if (!m.emits()) {
            m.metallic = 1.0f;
            m.roughness = 0.4f;
        }
    return scene;
}

}  // namespace

// H0: the mean share is rho^(N - 1) in a furnace, N the largest number of reflections, for any
// sampler. Student's t over 16 seeds, level 1 % over 4 means.
TEST_CASE("a render says what its largest number of reflections cuts", "[statistical]") {
    const mir::Scene scene = mir::builtin::furnace_box(0.95f, 1.0f);
    for (const mir::SamplerKind sampler : samplers) {
        const Stated usual(scene, few_vpls(sampler), &mir::RenderStatistics::cut,
                           std::pow(0.95, 31));
        CAPTURE(int(sampler), usual.share.mean(), usual.share.standard_error(), usual.worst);
        CHECK(mean_p_value(usual.share, std::pow(0.95, 31)) > sidak(0.01, 4));
        CHECK(usual.worst < 4.0);
    }
    mir::RenderSettings s = few_vpls(mir::SamplerKind::instant_radiosity);
    s.max_bounce = 8;
    const Stated few(scene, s, &mir::RenderStatistics::cut, std::pow(0.95, 7));
    CHECK(mean_p_value(few.share, std::pow(0.95, 7)) > sidak(0.01, 4));
    CHECK(few.worst < 4.0);
}

// H0: the VPLs bring what is said not to be cut of L_e rho^2 / (1 - rho). Student's t over 16
// seeds, level 1 %.
TEST_CASE("what VPLs bring and what is cut are all light of a bright furnace", "[statistical]") {
    const mir::Scene scene = mir::builtin::furnace_box(0.95f, 1.0f);
    mir::RenderSettings s = few_vpls(mir::SamplerKind::instant_radiosity);
    s.vpls = 512;
    Moments all;
    for (s.seed = 0; s.seed < runs; ++s.seed) {
        const mir::RenderStatistics r = render(scene, s).statistics;
        REQUIRE(r.cut);
        all.add(r.indirect_luminance / (1.0 - r.cut->share));
    }
    CAPTURE(all.mean(), all.standard_error());
    CHECK(mean_p_value(all, 0.95 * 0.95 / 0.05) > 0.01);
}

TEST_CASE("light that is cut is warned of, in a dark room there is none") {
    mir::RenderSettings s = few_vpls(mir::SamplerKind::instant_radiosity);
    const auto warned = [&](float reflectance) {
        const auto r = render(mir::builtin::furnace_box(reflectance, 1.0f), s);
        return std::any_of(r.warnings.begin(), r.warnings.end(), [](const std::string& w) {
            return w.find("number of reflections") != std::string::npos;
        });
    };
    CHECK(warned(0.95f));
    CHECK_FALSE(warned(0.5f));
    s.max_bounce = 4;
    CHECK(warned(0.5f));
}

// The truth is the path tracer's share, known to a few percent of itself. Of 32 estimates none lies
// farther from it than 4 standard errors, and their spread is what they state.
TEST_CASE("the share that the bound removes is known within its error", "[statistical]") {
    for (const mir::Scene& scene : {mir::builtin::make("sphere"), glossy_corner()}) {
        CAPTURE(scene.name);
        mir::RenderSettings s = few_vpls(mir::SamplerKind::instant_radiosity);
        s.bound.kind = mir::BoundPolicy::Kind::automatic;
        const float bound = render(scene, s).statistics.bound;
        const Studio<mir::CookTorrance> studio(scene);
        const double removed = traced(studio, mir::BoundPart::removed, bound);
        const double truth = removed / (removed + traced(studio, mir::BoundPart::kept, bound));
        const Stated stated(scene, s, &mir::RenderStatistics::removed, truth);
        CAPTURE(truth, stated.share.mean(), stated.error.mean(), stated.worst);
        CHECK(stated.worst < 4.0);
        CHECK(stated.share.mean() == Approx(truth).epsilon(0.1));
        const double spread = std::sqrt(stated.share.variance()) / stated.error.mean();
        CHECK(spread > 0.5);
        CHECK(spread < 1.5);
    }
}

TEST_CASE("shares do not depend on threads, and sum up over passes") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::RenderSettings s = few_vpls(mir::SamplerKind::instant_radiosity);
    s.bound.kind = mir::BoundPolicy::Kind::automatic;
    s.max_bounce = 3;
    const mir::RenderStatistics one = render(scene, s).statistics;
    s.threads = 1;
    const mir::RenderStatistics same = render(scene, s).statistics;
    CHECK(one.cut->share == same.cut->share);
    CHECK(one.removed->share == same.removed->share);
    CHECK(one.removed->standard_error == same.removed->standard_error);
    s.seed = 1;
    const mir::RenderStatistics other = render(scene, s).statistics;
    mir::RenderStatistics both = one;
    add_pass(both, other, 1);
    CHECK(both.cut->share == Approx(0.5 * (one.cut->share + other.cut->share)));
    CHECK(both.cut->standard_error ==
          Approx(0.5 * std::hypot(one.cut->standard_error, other.cut->standard_error)));
    both.removed.reset();
    add_pass(both, other, 2);
    CHECK_FALSE(both.removed);
}

TEST_CASE("a render that does not measure what is missing gives the same picture") {
    const mir::Scene scene = mir::builtin::make("corner");
    mir::RenderSettings s = few_vpls(mir::SamplerKind::metropolis);
    s.bound = {mir::BoundPolicy::Kind::fixed, 0.5f};
    const mir::RenderResult measured = render(scene, s);
    s.measure_missing = false;
    const mir::RenderResult told = render(scene, s);
    CHECK(same_bits(measured.beauty, told.beauty));
    CHECK(measured.statistics.cut);
    CHECK_FALSE(told.statistics.cut);
    CHECK_FALSE(told.statistics.removed);
    CHECK(told.statistics.removed_share() > 0.0);
}

TEST_CASE("spheres and renders without bound lose nothing to it") {
    mir::RenderSettings s = few_vpls(mir::SamplerKind::instant_radiosity);
    CHECK(render(mir::builtin::make("corner"), s).statistics.removed->share == 0.0);
    s.bound = {mir::BoundPolicy::Kind::fixed, 0.5f};
    CHECK(render(mir::builtin::make("corner"), s).statistics.removed->share > 0.01);
    s.vsl.enabled = true;
    CHECK(render(mir::builtin::make("corner"), s).statistics.removed->share == 0.0);
}
