// SPDX-License-Identifier: MIT
//
// Passes of the compiled renderer: what they share and what differs between them.
#include "images/support.hpp"
#include "mir/runtime/progressive_render.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

using mirtest::same_bits;

namespace {

/// A picture that takes some milliseconds.
mir::RenderSettings tiny(mir::SamplerKind sampler = mir::SamplerKind::instant_radiosity) {
    mir::RenderSettings s = mirtest::small_settings(24, 16);
    s.image = {24, 18};
    s.sampler = sampler;
    s.direct_samples = 1;
    s.backend = mir::BackendKind::cpu;
    s.bounce_layers = true;
    s.seed = 3;
    return s;
}

mir::RenderResult passes(const mir::Scene& scene, const mir::RenderSettings& settings,
                         std::uint32_t count) {
    mir::Registry registry;
    mir::add_cpu_to(registry);
    const auto renderer = registry.make(settings.backend, settings.scheduler);
    mir::ProgressiveRender render(*renderer, scene, settings, {.passes = count});
    while (!render.is_complete()) render.next_pass();
    return render.result();
}

/// (a + b) / 2 in double precision, rounded once.
mir::Image<mir::Rgb> mean(const mir::Image<mir::Rgb>& a, const mir::Image<mir::Rgb>& b) {
    mir::Image<mir::Rgb> m(a.extent());
    const auto half = [](double x, double y) { return static_cast<float>((x + y) / 2.0); };
    for (std::size_t i = 0; i < m.pixels().size(); ++i) {
        const mir::Rgb p = a.pixels()[i];
        const mir::Rgb q = b.pixels()[i];
        m.pixels()[i] = {half(p.r, q.r), half(p.g, q.g), half(p.b, q.b)};
    }
    return m;
}

}  // namespace

TEST_CASE("one pass is the plain render in every bit") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    for (const mir::SamplerKind sampler : mirtest::samplers) {
        const mir::RenderSettings s = tiny(sampler);
        const mir::RenderResult plain = mirtest::render(scene, s);
        const mir::RenderResult one = passes(scene, s, 1);
        CHECK(same_bits(plain.beauty, one.beauty));
        CHECK(same_bits(plain.emission, one.emission));
        CHECK(same_bits(plain.direct, one.direct));
        CHECK(same_bits(plain.indirect, one.indirect));
        CHECK(same_bits(plain.guides.albedo, one.guides.albedo));
        REQUIRE(plain.bounces.size() == one.bounces.size());
        for (std::size_t b = 0; b < plain.bounces.size(); ++b)
            CHECK(same_bits(plain.bounces[b], one.bounces[b]));
        CHECK(plain.warnings == one.warnings);
        CHECK(plain.vpls.size() == one.vpls.size());
    }
}

TEST_CASE("two passes are the mean of two renders with their seeds, layer by layer") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::RenderSettings s = tiny();
    s.luxels_per_pixel = 2;  // several, so that luxels too are other ones in each pass
    const mir::RenderResult both = passes(scene, s, 2);
    const mir::RenderResult first = mirtest::render(scene, s);
    s.seed = mir::pass_seed(s.seed, 1);
    const mir::RenderResult second = mirtest::render(scene, s);
    CHECK(same_bits(both.emission, mean(first.emission, second.emission)));
    CHECK(same_bits(both.direct, mean(first.direct, second.direct)));
    CHECK(same_bits(both.indirect, mean(first.indirect, second.indirect)));
    CHECK(same_bits(both.guides.albedo, mean(first.guides.albedo, second.guides.albedo)));
    for (std::size_t i = 0; i < both.beauty.pixels().size(); ++i)
        CHECK(both.beauty.pixels()[i] ==
              both.emission.pixels()[i] + (both.direct.pixels()[i] + both.indirect.pixels()[i]));
    // Every kind of random number differs between passes.
    CHECK_FALSE(same_bits(first.emission, second.emission));
    CHECK_FALSE(same_bits(first.direct, second.direct));
    CHECK_FALSE(same_bits(first.indirect, second.indirect));
    CHECK_FALSE(same_bits(first.guides.albedo, second.guides.albedo));
}

// Pixels share VPLs, so their errors are not independent. H0: all the same the squared estimate of
// a render of four passes is, on average over renders, the variance of such a render, measured by
// half the mean squared difference of two of them. t-test over 20 pairs, level 1 %, seeds 0..39.
TEST_CASE("the estimated error is the spread of whole progressive renders") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    mir::RenderSettings s = tiny();
    s.bounce_layers = false;
    s.luxels_per_pixel = 2;  // a luxel alone moves evenly, which the estimate does not know
    mirtest::Moments difference;
    for (std::uint64_t pair = 0; pair < 20; ++pair) {
        s.seed = 2 * pair;
        const mir::RenderResult a = passes(scene, s, 4);
        s.seed = 2 * pair + 1;
        const mir::RenderResult b = passes(scene, s, 4);
        double variance = 0.0;
        for (std::size_t i = 0; i < a.beauty.pixels().size(); ++i)
            variance += 0.5 * std::pow(static_cast<double>(luminance(a.beauty.pixels()[i])) -
                                           static_cast<double>(luminance(b.beauty.pixels()[i])),
                                       2);
        variance /= static_cast<double>(a.beauty.pixels().size());
        const auto estimate = [](const mir::RenderResult& r) {
            return std::pow(*r.statistics.relative_error * mirtest::mean_luminance(r.beauty), 2);
        };
        difference.add(variance - 0.5 * (estimate(a) + estimate(b)));
    }
    CHECK(mirtest::mean_p_value(difference, 0.0) > 0.01);
}
