// SPDX-License-Identifier: MIT
//
// How errors shrink with the number of VPLs, and how often tests of right estimators fail.
#include "bounce_means.hpp"
#include "self_normalised.hpp"
#include "support/catch.hpp"
#include "support/kolmogorov.hpp"

using namespace mirtest;
using mir::SamplerKind;

namespace {

constexpr std::uint32_t side = 32;

/// A sampler whose P_c is wrong by a factor.
template <mir::Sampler S>
struct Brighter {
    static constexpr mir::Normalisation normalisation = S::normalisation;

    S sampler;
    double factor;

    template <mir::Executor E>
    [[nodiscard]] mir::VplRecords sample(E& executor) const {
        mir::VplRecords records = sampler.sample(executor);
        records.path_luminance *= factor;
        return records;
    }
};
template <mir::Sampler S>
Brighter(S, double) -> Brighter<S>;

/// Indirect light of the Cornell box at 32 x 32 luxels that are the same for every seed, bounces 2
/// to 5 under one bound for any number of VPLs.
mir::RenderSettings box_settings(SamplerKind sampler, std::uint32_t vpls) {
    mir::RenderSettings s = small_settings(side, vpls);
    s.sampler = sampler;
    s.sum = mir::LightSum::all;
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

/// Slope of log(error) against log(number of VPLs) by least squares, over 32 seeds.
template <class Settings>
double rate(const mir::Image<mir::Rgb>& truth, const std::vector<std::uint32_t>& counts,
            const Settings& settings) {
    Moments x;
    Moments y;
    double products = 0.0;
    for (const std::uint32_t n : counts) {
        const double log_n = std::log(static_cast<double>(n));
        const double log_error = std::log(error(truth, settings(n), 32));
        x.add(log_n);
        y.add(log_error);
        products += log_n * log_error;
    }
    const auto count = static_cast<double>(counts.size());
    return (products - count * x.mean() * y.mean()) / (x.variance() * (count - 1.0));
}

}  // namespace

// The truth is instant radiosity with 2^15 VPLs, of another seed: its own error is a fifth or less
// of any that is measured. Criterion: slope -0.5 +- 0.05, whose standard error over as many seeds
// is about 0.015. Resampled VPLs are stratified over places and bounces and may do better.
TEST_CASE("errors shrink with the square root of the number of VPLs", "[statistical]") {
    const mir::Image<mir::Rgb> truth =
        render(box(), box_settings(SamplerKind::instant_radiosity, 1u << 15)).indirect;
    const auto slope = [&](SamplerKind sampler, const std::vector<std::uint32_t>& counts) {
        return rate(truth, counts, [&](std::uint32_t n) { return box_settings(sampler, n); });
    };
    CHECK(slope(SamplerKind::instant_radiosity, {16, 64, 256, 1024}) == Approx(-0.5).margin(0.05));
    CHECK(slope(SamplerKind::metropolis, {64, 256, 1024}) == Approx(-0.5).margin(0.05));
    CHECK(slope(SamplerKind::bidirectional, {16, 64, 256}) == Approx(-0.55).margin(0.1));
    // P_c of a few paths is an error that more VPLs do not lessen.
    CHECK(rate(truth, {64, 256, 1024}, [](std::uint32_t n) {
              auto s = box_settings(SamplerKind::metropolis, n);
              s.metropolis.bootstrap = {1.0, 256, 256};
              return s;
          }) > -0.45);
}

namespace {

/// p-values of "MIR and the path tracer bring the same light", of experiments that share no
/// numbers: Welch's test on a quarter of the image, 8 replicates each. MIR's P_c is multiplied by
/// `factor`.
std::vector<double> p_values(std::uint64_t experiments, double factor) {
    constexpr std::uint32_t runs = 8;
    mir::RenderSettings s = box_settings(SamplerKind::metropolis, 64);
    s.image = {16, 16};
    s.luxels_per_pixel = 4;
    s.bounce_layers = true;
    s.metropolis.stride = 4;
    const Studio<mir::Lambert> studio(box());
    const auto tracer = studio.tracer({.max_bounce = s.max_bounce, .bound = s.bound.value});
    mir::ReferenceOptions reference;
    reference.samples = 4;
    reference.film = mir::FilmPosition::pixel;
    std::vector<double> p;
    for (std::uint64_t e = 0; e < experiments; ++e) {
        BounceMeans traced;
        BounceMeans rendered;
        for (const auto& image : replicates(tracer, studio.rays(16, e), reference, runs))
            traced.add(image);
        for (std::uint32_t r = 0; r < runs; ++r, ++s.seed)
            rendered.add(render(studio, s, Brighter{chains(studio, s, s.bound.value), factor}));
        const auto quarter = [e](const BounceMeans& m) {
            return m.tiles().back().moments()[e % 4];
        };
        p.push_back(welch_p_value(quarter(traced), quarter(rendered)));
    }
    return p;
}

}  // namespace

// H0: Welch's test of a right estimator gives uniform p-values. Kolmogorov and Smirnov's test over
// 64 experiments, level 1 %, seeds 0 to 511. Bias would gather them near 0, replicates that are
// not independent would spread them too far.
TEST_CASE("p-values of Metropolis instant radiosity are uniform", "[statistical]") {
    CHECK(uniform_p_value(p_values(64, 1.0)) > 0.01);
    CHECK(uniform_p_value(p_values(24, 1.1)) < 0.01);
}
