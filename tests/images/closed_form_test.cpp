// SPDX-License-Identifier: MIT
//
// Whole renders against numbers known in closed form.
#include "reference/studio.hpp"
#include "support.hpp"
#include "support/catch.hpp"

using namespace mirtest;

namespace {

/// Mean radiance of all pixels that see the material whose reflectance is 1 and that shines not.
double mean_of_receiver(const mir::RenderResult& r, const mir::Image<mir::Rgb>& light) {
    double sum = 0.0;
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < light.pixels().size(); ++i) {
        if (r.guides.albedo.pixels()[i].r < 0.999f) continue;
        sum += light.pixels()[i].r;
        ++n;
    }
    REQUIRE(n > 100);
    return sum / static_cast<double>(n);
}

/// Looks straight down on the unit square receiver so that pixels cover it evenly, from below the
/// lamp's plane: for a receiver of albedo 1 the mean radiance is the form factor times L.
mir::Scene seen_from_above(mir::Scene scene, mir::Vec3 centre, float height) {
    scene.cameras = {mir::Camera::look_at(centre + mir::Vec3(0, height, 0), centre, {0, 0, -1},
                                          2.0f * std::atan(0.5f / height))};
    return scene;
}

}  // namespace

TEST_CASE("facing unit squares exchange light by their form factor", "[statistical]") {
    // H0: mean radiance of the receiver is F = 0.199824896 (Howell). The pixels cover it evenly
    // and their next-event samples are independent: z over 16 seeds, level 0.1 % (|z| < 3.29).
    // The lamp of the scene is seen through, because the camera stands between the squares.
    const mir::Scene scene = seen_from_above(mir::builtin::parallel_squares(), {0, 0, 0}, 0.9f);
    std::vector<double> values;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        auto settings = small_settings(64, 16);
        settings.sampler = mir::SamplerKind::instant_radiosity;
        settings.seed = seed;
        settings.luxels_per_pixel = 4;
        const auto r = render(scene, settings);
        values.push_back(mean_of_receiver(r, r.direct));
    }
    const Estimate e = estimate(values);
    CHECK(e.error < 2e-4);
    CHECK(std::abs(e.mean - 0.199824896) < 3.29 * e.error + 1e-5);
}

TEST_CASE("VPLs on the lamp give the same form factor", "[statistical]") {
    // H0: as above, with direct light by 256 VPLs on the lamp; Student's t over 16 seeds, level 1 %
    // over 3 samplers. A lamp 3 % too bright must be rejected.
    const mir::Scene scene = seen_from_above(mir::builtin::parallel_squares(), {0, 0, 0}, 0.9f);
    for (const mir::SamplerKind sampler : samplers) {
        Moments f;
        auto settings = small_settings(32, 256);
        settings.sampler = sampler;
        settings.direct = mir::DirectLight::vpl;
        settings.max_bounce = 1;
        for (settings.seed = 0; settings.seed < 16; ++settings.seed) {
            const auto r = render(scene, settings);
            REQUIRE(mean_luminance(r.direct) == 0.0);
            f.add(mean_of_receiver(r, r.indirect));
        }
        CAPTURE(int(sampler), f.mean(), f.standard_error());
        CHECK(mean_p_value(f, 0.199824896, 1e-5) > sidak(0.01, samplers.size()));
        CHECK(mean_p_value(f, 0.199824896 / 1.03, 1e-5) < sidak(0.01, samplers.size()));
    }
}

TEST_CASE("VPLs on the lamp light each ninth of a facing square as it should be", "[statistical]") {
    // H0: mean radiance of each ninth is int int 1 / (pi d^4), by quadrature, for squares 1 m
    // apart. Student's t over 16 seeds, level 1 % over 9 parts and 3 samplers. The tolerance of
    // 1e-4 is for means over luxels instead of areas.
    const auto radiance = [](double x, double y) {
        return mirtest::integrate(0.0, 1.0, 0.0, 1.0, 4, [&](double u, double v) {
            const double d2 = 1.0 + (x - u) * (x - u) + (y - v) * (y - v);
            return 1.0 / (mirtest::pi * d2 * d2);
        });
    };
    const std::vector<double> expected = cell_integrals(3, 3, 4, radiance);
    const mir::Scene scene = seen_from_above(mir::builtin::parallel_squares(), {0, 0, 0}, 0.9f);
    for (const mir::SamplerKind sampler : samplers) {
        TileMeans parts(8);
        auto settings = small_settings(24, 256);
        settings.sampler = sampler;
        settings.direct = mir::DirectLight::vpl;
        settings.max_bounce = 1;
        for (settings.seed = 0; settings.seed < 16; ++settings.seed)
            parts.add(render(scene, settings).indirect);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const Moments& part = parts.moments()[i];
            CAPTURE(int(sampler), i, part.mean(), part.standard_error());
            CHECK(mean_p_value(part, 9.0 * expected[i], 1e-4) > sidak(0.01, 9 * samplers.size()));
        }
    }
}

TEST_CASE("the furnace has radiance L / (1 - rho) in every bounce", "[statistical]") {
    // H0: D_0 = L, D_1 = rho L, D_b = rho^b L with rho = L = 0.5; Student's t over 32 seeds, level
    // 1 % over 5 means and 3 samplers. No bound, so nothing is removed.
    const mir::Scene scene = mir::builtin::furnace_box(0.5f, 0.5f);
    const double expected[] = {0.5, 0.25, 0.125, 0.0625, 0.03125, 1.0};
    for (const mir::SamplerKind sampler : samplers) {
        std::vector<Moments> d(std::size(expected));
        auto settings = small_settings(24, 256);
        settings.sampler = sampler;
        settings.bounce_layers = true;
        settings.direct_samples = 16;
        settings.metropolis.chains = 128;  // fewer than VPLs, or nothing would mutate
        settings.metropolis.stride = 16;
        for (settings.seed = 0; settings.seed < 32; ++settings.seed) {
            const auto r = render(scene, settings);
            CHECK(mean_luminance(r.emission) == Approx(0.5).epsilon(1e-6));
            d[1].add(mean_luminance(r.direct));
            for (std::size_t b = 2; b <= 4; ++b)
                d[b].add(b - 1 < r.bounces.size() ? mean_luminance(r.bounces[b - 1]) : 0.0);
            d[5].add(mean_luminance(r.beauty));
        }
        for (std::size_t b = 1; b < d.size(); ++b) {
            CAPTURE(int(sampler), b, d[b].mean(), d[b].standard_error());
            CHECK(mean_p_value(d[b], expected[b]) > sidak(0.01, 5 * samplers.size()));
        }
    }
}

TEST_CASE("shading and its remainder under a bound add up to unbounded shading") {
    auto settings = small_settings(32, 64);
    // Chains look at the image through the bound, so theirs would be other VPLs.
    settings.sampler = mir::SamplerKind::instant_radiosity;
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    const double all = render(scene, settings).statistics.indirect_luminance;
    const auto under = [&](float bound) {
        settings.bound = {mir::BoundPolicy::Kind::fixed, bound};
        return render(scene, settings).statistics;
    };
    const auto usual = under(2.0f);
    CHECK(usual.removed_share() > 0.01);
    CHECK(usual.indirect_luminance + usual.removed_luminance == Approx(all).epsilon(1e-5));
    // The extremes: everything is the remainder, or nothing is.
    const auto least = under(1e-12f);
    CHECK(least.removed_share() > 1.0 - 1e-9);
    CHECK(least.removed_luminance == Approx(all).epsilon(1e-5));
    const auto most = under(1e12f);
    CHECK(most.removed_luminance == 0.0);
    CHECK(most.indirect_luminance == Approx(all).epsilon(1e-6));
    // A remainder of a bound that is a tenth larger is missed.
    const auto other = under(2.2f);
    CHECK_FALSE(usual.indirect_luminance + other.removed_luminance == Approx(all).epsilon(1e-5));
}

TEST_CASE("the layers add up to the beauty and the bounces to the indirect light") {
    auto settings = small_settings(32, 64);
    settings.luxels_per_pixel = 4;
    settings.bounce_layers = true;
    settings.filter = mir::default_filter(mir::FilterKind::lanczos);
    const auto r = render(mir::builtin::sphere_room(mir::builtin::Lamp::down), settings);
    mir::Image<mir::Rgb> sum = r.emission;
    mir::Image<mir::Rgb> bounces(r.indirect.extent());
    for (std::size_t i = 0; i < sum.pixels().size(); ++i) {
        sum.pixels()[i] += r.direct.pixels()[i] + r.indirect.pixels()[i];
        for (const auto& b : r.bounces) bounces.pixels()[i] += b.pixels()[i];
    }
    CHECK(relative_difference(r.beauty, sum) < 1e-6);
    CHECK(relative_difference(r.indirect, bounces) < 1e-6);
    REQUIRE(r.bounces.size() > 2);
    CHECK(mean_luminance(r.bounces[0]) == 0.0);  // bounce 1 is direct light, sampled separately
}
