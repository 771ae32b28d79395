// SPDX-License-Identifier: MIT
//
// How errors shrink with the number of VPLs, and how often tests of right estimators fail.
#include "bounce_means.hpp"
#include "mir/sampling/visible_area.hpp"
#include "support/catch.hpp"

using namespace mirtest;
using mir::SamplerKind;

namespace {

constexpr std::uint32_t side = 48;

/// Indirect light of the Cornell box at 48 x 48 luxels that are the same for every seed, bounces 2
/// to 5 under one bound for any number of VPLs.
mir::RenderSettings box_settings(SamplerKind sampler, std::uint32_t vpls) {
    mir::RenderSettings s = small_settings(side, vpls);
    s.sampler = sampler;
    s.direct_samples = 1;
    s.max_bounce = BounceMeans::last_bounce;
    s.bound = {mir::BoundPolicy::Kind::fixed, 14.0f};
    s.metropolis.chains = 4;
    s.metropolis.stride = 16;
    s.metropolis.chain.tries = 4;
    // P_c is an error that all pixels share: it must shrink as well.
    const std::uint64_t paths = std::uint64_t{64} * vpls;
    s.metropolis.bootstrap = {1.0, paths, paths};
    return s;
}

const mir::Scene& box() {
    static const mir::Scene scene = mir::builtin::make("cornell-box");
    return scene;
}

/// Root mean square of the luminance error over pixels and `seeds` seeds.
double error(const mir::Image<mir::Rgb>& truth, mir::RenderSettings s, std::uint64_t seeds) {
    double sum = 0.0;
    for (s.seed = 1; s.seed <= seeds; ++s.seed) {
        const mir::Image<mir::Rgb> light = render(box(), s).indirect;
        for (std::size_t i = 0; i < light.pixels().size(); ++i) {
            const double d = luminance(light.pixels()[i]) - luminance(truth.pixels()[i]);
            sum += d * d;
        }
    }
    return std::sqrt(sum / static_cast<double>(seeds * truth.pixels().size()));
}

/// Slope of log(error) against log(number of VPLs) by least squares.
double rate(const mir::Image<mir::Rgb>& truth, SamplerKind sampler,
            const std::vector<std::uint32_t>& counts, std::uint64_t seeds) {
    Moments x;
    Moments y;
    double products = 0.0;
    for (const std::uint32_t n : counts) {
        const double log_n = std::log(static_cast<double>(n));
        const double log_error = std::log(error(truth, box_settings(sampler, n), seeds));
        x.add(log_n);
        y.add(log_error);
        products += log_n * log_error;
    }
    const auto count = static_cast<double>(counts.size());
    return (products / count - x.mean() * y.mean()) / (x.variance() * (count - 1.0) / count);
}

}  // namespace

// The truth is instant radiosity with 2^15 VPLs, of another seed: its own error is below a tenth of
// any that is measured. Criterion: slope -0.5 +- 0.05; over as many seeds its standard error is
// about 0.015.
TEST_CASE("errors shrink with the square root of the number of VPLs", "[statistical]") {
    const mir::Image<mir::Rgb> truth =
        render(box(), box_settings(SamplerKind::instant_radiosity, 1u << 15)).indirect;
    const double light_paths = rate(truth, SamplerKind::instant_radiosity, {16, 64, 256, 1024}, 32);
    const double resampled = rate(truth, SamplerKind::bidirectional, {16, 64, 256}, 32);
    const double chained = rate(truth, SamplerKind::metropolis, {64, 256, 1024}, 32);
    CAPTURE(light_paths, resampled, chained);
    CHECK(light_paths == Approx(-0.5).margin(0.05));
    CHECK(resampled == Approx(-0.5).margin(0.05));
    CHECK(chained == Approx(-0.5).margin(0.05));
}
