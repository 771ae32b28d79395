// SPDX-License-Identifier: MIT
//
// VPLs under a bound and the light that is traced back: together the light of an unbounded path
// tracer, bounce by bounce, and by themselves what the VPLs say was removed.
#include "bounce_means.hpp"
#include "mir/runtime/pass_sums.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::Lambert;
using mir::SamplerKind;

namespace {

constexpr std::uint32_t runs = 16;
constexpr std::uint32_t side = 24;  // pixels of one luxel

/// Few VPLs under a bound that removes a good share of their light.
mir::RenderSettings bounded(SamplerKind sampler) {
    mir::RenderSettings s = small_settings(side, 256);
    s.sampler = sampler;
    s.bound = {mir::BoundPolicy::Kind::fixed, 0.5f};
    s.bounce_layers = true;
    s.direct_samples = 1;
    s.max_bounce = BounceMeans::last_bounce;
    s.metropolis.chains = 128;  // fewer than VPLs, or nothing would mutate
    s.metropolis.stride = 16;
    s.metropolis.bootstrap = {1.0, 1u << 14, 1u << 14};
    return s;
}

BounceMeans rendered(const mir::Scene& scene, mir::RenderSettings s) {
    BounceMeans means;
    for (s.seed = 0; s.seed < runs; ++s.seed) means.add(render(scene, s));
    return means;
}

/// What the path tracer says of the same luxels.
std::vector<mir::ReferenceImage> traced(const mir::Scene& scene) {
    const Studio<Lambert> studio(scene);
    mir::ReferenceOptions options;
    options.samples = 64;
    return replicates(studio.tracer({.max_bounce = BounceMeans::last_bounce}),
                      studio.rays(side, 911), options, runs);
}

BounceMeans means_of(const std::vector<mir::ReferenceImage>& images) {
    BounceMeans means;
    for (const mir::ReferenceImage& image : images) means.add(image);
    return means;
}

/// The corner with a lamp all over its wall.
mir::Scene shining_corner() {
    mir::Scene scene = mir::builtin::make("corner");
    scene.materials[1].emission = {1.0f, 0.5f, 0.25f};
    return scene;
}

}  // namespace

// H0: equal means of D_2 .. D_5 and of their sum, in 9 tiles and over the image. Welch's test over
// 16 replicates each, seeds 0 to 15, path tracer 911, level 1 % over 2 scenes and 3 samplers.
TEST_CASE("bounded VPLs and what is traced back bring the light of the path tracer",
          "[statistical]") {
    const double level = sidak(0.01, 2 * samplers.size());
    for (const char* name : {"corner", "cornell-box"}) {
        const mir::Scene scene = mir::builtin::make(name);
        const BounceMeans truth = means_of(traced(scene));
        for (const SamplerKind sampler : samplers) {
            mir::RenderSettings s = bounded(sampler);
            CAPTURE(name, int(sampler));
            CHECK(agreement(rendered(scene, s), truth) < level);
            s.compensate = 4;
            CHECK(agreement(rendered(scene, s), truth) > level);
        }
    }
}

// H0: the means over the image are equal. Welch's test over 32 seeds, level 1 % over 3 samplers;
// half as much again is rejected.
TEST_CASE("what is traced back is what the VPLs say that the bound removed", "[statistical]") {
    const mir::Scene scene = mir::builtin::make("corner");
    for (const SamplerKind sampler : samplers) {
        mir::RenderSettings s = bounded(sampler);
        s.bounce_layers = false;
        s.compensate = 4;
        Moments removed;
        Moments residual;
        Moments more;
        Moments kept;
        for (s.seed = 0; s.seed < 32; ++s.seed) {
            const mir::RenderStatistics r = render(scene, s).statistics;
            removed.add(r.removed_luminance);
            residual.add(r.residual_luminance);
            more.add(1.5 * r.residual_luminance);
            kept.add(r.indirect_luminance);
        }
        CAPTURE(int(sampler), removed.mean(), removed.standard_error(), residual.mean(),
                residual.standard_error());
        CHECK(residual.mean() > 0.05 * kept.mean());
        CHECK(welch_p_value(removed, residual) > sidak(0.01, samplers.size()));
        CHECK(welch_p_value(removed, more) < sidak(0.01, samplers.size()));
    }
}

// H0: equal means of D_1 and D_2 over the image where lamps are VPLs; as above, 2 bounces.
TEST_CASE("direct light of bounded VPLs on lamps is traced back too", "[statistical]") {
    const mir::Scene scene = shining_corner();
    const auto reference = traced(scene);
    mir::RenderSettings s = bounded(SamplerKind::instant_radiosity);
    s.direct = mir::DirectLight::vpl;
    for (const bool compensated : {false, true}) {
        s.compensate = compensated ? 4 : 0;
        std::vector<TileMeans> bounces(2, TileMeans(side));
        for (s.seed = 0; s.seed < runs; ++s.seed) {
            const mir::RenderResult r = render(scene, s);
            for (std::size_t b = 0; b < 2; ++b) bounces[b].add(r.bounces[b]);
        }
        for (std::uint8_t b = 0; b < 2; ++b) {
            const double p = smallest_p(bounces[b], tiles_of(reference, b + 1u, side));
            CAPTURE(compensated, b + 1, p);
            CHECK((p > sidak(0.01, 2)) == compensated);
        }
    }
}

TEST_CASE("light that is traced back stands in the layer of its bounce, up to the largest") {
    const mir::Scene scene = mir::builtin::make("corner");
    mir::RenderSettings s = bounded(SamplerKind::instant_radiosity);
    s.vpls = 8;
    const mir::RenderResult without = render(scene, s);
    s.compensate = 2;
    const mir::RenderResult with = render(scene, s);
    REQUIRE(with.bounces.size() == s.bounce_limit());
    CHECK(same_bits(with.direct, without.direct));
    CHECK(with.statistics.indirect_luminance == without.statistics.indirect_luminance);
    CHECK(with.statistics.removed_luminance == without.statistics.removed_luminance);
    CHECK(with.statistics.residual_paths == 2 * side * side);
    CHECK(mean_luminance(with.bounces[0]) == 0.0);
    double bounces = 0.0;
    for (std::size_t b = 1; b < with.bounces.size(); ++b) {
        const double vpls = b < without.bounces.size() ? mean_luminance(without.bounces[b]) : 0.0;
        CHECK(mean_luminance(with.bounces[b]) > vpls);
        bounces += mean_luminance(with.bounces[b]);
    }
    CHECK(mean_luminance(with.indirect) == Approx(bounces).epsilon(1e-6));
    CHECK(mean_luminance(with.indirect) ==
          Approx(mean_luminance(without.indirect) + with.statistics.residual_luminance)
              .epsilon(1e-6));
    s.max_bounce = 1;
    CHECK(render(scene, s).statistics.residual_luminance == 0.0);
}

TEST_CASE("every ray engine traces back the same light") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::RenderSettings s = bounded(SamplerKind::instant_radiosity);
    s.compensate = 4;
    const auto with = [&](mir::Acceleration acceleration) {
        s.acceleration = acceleration;
        return render(scene, s);
    };
    const mir::RenderResult tree = with(mir::Acceleration::kd_tree);
    const mir::RenderResult bvh = with(mir::Acceleration::bvh);
    const mir::RenderResult embree = with(mir::Acceleration::embree);
    CHECK(same_bits(tree.indirect, bvh.indirect));
    CHECK(tree.statistics.residual_luminance == bvh.statistics.residual_luminance);
    // Paths that meet an edge part.
    CHECK(share_of_changed_pixels(tree.indirect, embree.indirect, 1e-3f) < 0.05);
    CHECK(tree.statistics.residual_luminance ==
          Approx(embree.statistics.residual_luminance).epsilon(0.02));
}

TEST_CASE("settings under which nothing is removed refuse to trace it back") {
    mir::RenderSettings s;
    s.compensate = 1;
    CHECK_NOTHROW(s.validate());
    s.bound.kind = mir::BoundPolicy::Kind::none;
    CHECK_THROWS_AS(s.validate(), mir::Error);
    s.bound.kind = mir::BoundPolicy::Kind::automatic;
    s.integrator = mir::Integrator::path;
    CHECK_THROWS_AS(s.validate(), mir::Error);
    s.integrator = mir::Integrator::vpl;
    s.compensate = 65537;
    CHECK_THROWS_AS(s.validate(), mir::Error);
    s.compensate = 0;
    s.removed_layer = true;
    CHECK_NOTHROW(s.validate());
    s.integrator = mir::Integrator::micro;
    CHECK_THROWS_AS(s.validate(), mir::Error);
}

TEST_CASE("a layer shows what the bound removed, which is missing in all others") {
    const mir::Scene scene = mir::builtin::make("corner");
    mir::RenderSettings s = bounded(SamplerKind::instant_radiosity);
    const mir::RenderResult usual = render(scene, s);
    CHECK(usual.removed.pixels().empty());
    s.removed_layer = true;
    const mir::RenderResult r = render(scene, s);
    CHECK(same_bits(r.beauty, usual.beauty));
    REQUIRE(r.bounces.size() == usual.bounces.size());
    CHECK(same_bits(r.bounces.back(), usual.bounces.back()));
    CHECK(mean_luminance(r.removed) == Approx(r.statistics.removed_luminance).epsilon(1e-6));

    s.bound.kind = mir::BoundPolicy::Kind::none;
    const mir::RenderResult unbounded = render(scene, s);
    CHECK(mean_luminance(unbounded.removed) == 0.0);
    mir::Image<mir::Rgb> sum = r.indirect;
    for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum.pixels()[i] += r.removed.pixels()[i];
    CHECK(relative_difference(unbounded.indirect, sum) < 1e-5);
    CHECK(relative_difference(unbounded.indirect, r.indirect) > 0.1);
}

TEST_CASE("the layer of what was removed is a mean over passes, as others are") {
    const mir::Scene scene = mir::builtin::make("corner");
    mir::RenderSettings s = bounded(SamplerKind::instant_radiosity);
    s.removed_layer = true;
    mir::PassSums sums;
    mir::Image<mir::Rgb> mean(s.image);
    for (s.seed = 0; s.seed < 2; ++s.seed) {
        mir::RenderResult pass = render(scene, s);
        for (std::size_t i = 0; i < mean.pixels().size(); ++i)
            mean.pixels()[i] += 0.5f * pass.removed.pixels()[i];
        sums.add(std::move(pass));
    }
    CHECK(relative_difference(sums.result().removed, mean) < 1e-6);
}
