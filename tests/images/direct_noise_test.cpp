// SPDX-License-Identifier: MIT
// How noisy direct light is said to be, against the spread of whole pictures.
#include "support.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::RenderSettings;

namespace {

RenderSettings settings_of(std::uint32_t samples, std::uint64_t seed) {
    RenderSettings s = small_settings(64, 16);
    s.luxels_per_pixel = 1;  // one place a pixel, whatever the seed
    s.measure_missing = true;
    s.direct_samples = samples;
    s.seed = seed;
    return s;
}

double said_noise(const mir::Scene& scene, std::uint32_t samples, std::uint64_t seed) {
    return render(scene, settings_of(samples, seed)).statistics.direct_noise.value();
}

/// The same measure from two pictures of other seeds.
double seen_noise(const mir::Scene& scene, std::uint32_t samples, std::uint64_t seed) {
    const mir::Image<mir::Rgb> a = render(scene, settings_of(samples, seed)).direct;
    const mir::Image<mir::Rgb> b = render(scene, settings_of(samples, seed + 1)).direct;
    const double dim = 0.05 * (mean_luminance(a) + mean_luminance(b));
    double squares = 0.0;
    double lit = 0.0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const double of_a = luminance(a.pixels()[i]);
        const double of_b = luminance(b.pixels()[i]);
        const double mean = 0.5 * (of_a + of_b);
        if (mean > 0.0) ++lit;
        squares += 0.5 * (of_a - of_b) * (of_a - of_b) / (mean * mean + dim * dim);
    }
    return std::sqrt(squares / lit);
}

}  // namespace

// Few pixels, in half shadows, have most of the noise: one measurement spreads by 15 %, one pair of
// pictures by 11 %. Eight and four of them agree within 4 standard errors, 30 %, seeds as below.
TEST_CASE("the noise of direct light is that of whole pictures") {
    const mir::Scene scene = mir::builtin::make("cornell-box");
    const auto samples = GENERATE(1u, 16u);
    double said = 0.0;
    double seen = 0.0;
    for (std::uint64_t i = 0; i < 8; ++i) said += said_noise(scene, samples, 100 + i) / 8.0;
    for (std::uint64_t i = 0; i < 4; ++i) seen += seen_noise(scene, samples, 2 * i) / 4.0;
    CHECK(said == Approx(seen).epsilon(0.3));
}

TEST_CASE("light without extent has no noise") {
    mir::Scene scene = mir::builtin::make("cornell-box");
    for (mir::Material& m : scene.materials) m.emission = {};
    scene.point_lights.push_back({"bulb", {0.0f, 0.9f, 0.0f}, {1, 1, 1}});
    CHECK(said_noise(scene, 1, 0) == 0.0);
}
