// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sampling/image_probe.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"

#include <algorithm>
#include <cmath>

namespace mir {

/// Odds by which VplRoulette keeps a candidate.
struct VplRouletteOptions {
    /// Smallest odds of survival, above 0 to 1. It keeps the estimate unbiased where a probe sees
    /// nothing of a VPL that lights the image. Small: such VPLs come seldom and bright; large: more
    /// of the kept VPLs light nothing.
    float floor = 0.02f;
    /// Mean fluxes from which on a VPL is sure to survive, above 0. Larger: more candidates are
    /// drawn and the survivors' fluxes are more alike.
    float threshold = 1.0f;
    std::uint32_t pilot_vpls = 4096;  ///< VPLs that estimate the mean flux beforehand

    /// @throws Error(invalid_argument) when a value is out of range.
    void validate() const {
        expects(floor > 0.0f && floor <= 1.0f,
                "the floor of the VPL roulette must be above 0 (else VPLs that the probe misses "
                "are lost and the image is biased) and at most 1; use 0.02");
        expects(threshold > 0.0f && std::isfinite(threshold),
                "the threshold of the VPL roulette must be positive (in mean fluxes); use 1");
        expects(pilot_vpls > 0, "the pilot of the VPL roulette must have at least 1 VPL");
    }
};

/// Russian roulette on VPLs by what they give to the image. A VPL survives with odds min(1, flux /
/// mean flux), no less than the floor, and is divided by them. Unbiased: the odds are positive, and
/// probe, mean flux and chance are independent of the draws behind the VPLs. Source: Georgiev and
/// Slusallek, "Simple and robust iterative importance sampling of virtual point lights",
/// Eurographics 2010, section 3. The probe must outlive it; const use from any thread.
template <Bsdf B, Visibility V>
class VplRoulette {
 public:
    /// Takes the mean flux from `pilot`, records drawn independently of all that will be filtered.
    /// @throws Error(invalid_argument) when an option is out of range.
    template <Executor E>
    VplRoulette(const ImageProbe<B, V>& probe, const VplRecords& pilot, VplRouletteOptions options,
                E& executor);

    /// Odds of survival of record i of `from`, floor..1.
    [[nodiscard]] float survival(const VplRecords& from, std::size_t i) const {
        return odds(flux(from, i));
    }

    /// The survivors of `from` in their order, divided by their odds. Record i's chance is number i
    /// of Stream::candidate of `seed`.
    template <Executor E>
    [[nodiscard]] VplRecords filter(const VplRecords& from, std::uint64_t seed, E& executor) const;

    /// Mean image luminance of one VPL per light path, W m^-2 sr^-1. 0 when the pilot lit nothing.
    [[nodiscard]] double mean_flux() const { return mean_flux_; }
    /// Mean odds of the pilot's records: the share that survives; 1 without records.
    [[nodiscard]] double acceptance() const { return acceptance_; }

 private:
    /// Per light path, so that sets of different size compare.
    [[nodiscard]] double flux(const VplRecords& from, std::size_t i) const {
        const Vpl& vpl = from.records[i].vpl;
        return static_cast<double>(probe_.flux(vpl, vpl.intensity)) *
               static_cast<double>(from.paths);
    }
    [[nodiscard]] float odds(double flux) const {
        // The pilot lit nothing: there is no ground to drop anything.
        if (!(mean_flux_ > 0.0)) return 1.0f;
        return std::clamp(static_cast<float>(flux / (mean_flux_ * options_.threshold)),
                          options_.floor, 1.0f);
    }

    const ImageProbe<B, V>& probe_;
    VplRouletteOptions options_;
    double mean_flux_ = 0.0;
    double acceptance_ = 1.0;
};

template <Bsdf B, Visibility V>
template <Executor E>
VplRoulette<B, V>::VplRoulette(const ImageProbe<B, V>& probe, const VplRecords& pilot,
                               VplRouletteOptions options, E& executor)
    : probe_(probe), options_(options) {
    options.validate();
    if (pilot.records.empty()) return;
    std::vector<double> fluxes(pilot.records.size());
    executor.for_each(fluxes.size(), [&](std::size_t i) { fluxes[i] = flux(pilot, i); });
    const auto count = static_cast<double>(fluxes.size());
    for (const double f : fluxes) mean_flux_ += f / count;
    acceptance_ = 0.0;
    for (const double f : fluxes) acceptance_ += static_cast<double>(odds(f)) / count;
}

template <Bsdf B, Visibility V>
template <Executor E>
VplRecords VplRoulette<B, V>::filter(const VplRecords& from, std::uint64_t seed,
                                     E& executor) const {
    std::vector<float> survivals(from.records.size());
    executor.for_each(survivals.size(), [&](std::size_t i) { survivals[i] = survival(from, i); });
    VplRecords out = from;
    out.records.clear();
    out.arrivals.clear();
    for (std::size_t i = 0; i < survivals.size(); ++i) {
        if (!(Random(seed, Stream::candidate, i).at(0) < survivals[i])) continue;
        out.records.push_back(from.records[i]);
        const float scale = 1.0f / survivals[i];
        out.records.back().vpl.intensity = from.records[i].vpl.intensity * scale;
        if (from.arrivals.empty()) continue;
        out.arrivals.push_back(from.arrivals[i]);
        out.arrivals.back().power = from.arrivals[i].power * scale;
    }
    out.non_lambertian_share = share_of_non_lambertian(out.records);
    return out;
}

/// Instant radiosity that keeps VPLs by VplRoulette. It traces more light paths for as many VPLs,
/// most of which light the image. Model of Sampler. Scene data and probe must outlive it; const use
/// from any thread.
template <Bsdf B, RayCaster R, Visibility V>
class RouletteRadiositySampler {
 public:
    static constexpr Normalisation normalisation = Normalisation::none;  ///< intensities are J

    /// What draws VPLs before the roulette.
    using Candidates = InstantRadiositySampler<B, R>;
    /// What their paths run through.
    using World = typename Candidates::World;

    /// @throws Error(invalid_argument) when options are out of range. Error(limit_exceeded) when
    /// more VPLs are wanted than `limits` allows.
    RouletteRadiositySampler(const World& world, const InstantRadiosityOptions& options,
                             const ImageProbe<B, V>& probe, VplRouletteOptions roulette = {},
                             const Limits& limits = {})
        : world_(world), options_(options), probe_(probe), roulette_(roulette), limits_(limits) {
        static_cast<void>(candidates(options.vpls, options.seed));
        roulette.validate();
    }

    /// Draws a pilot, then the candidates, and filters them. The pilot's acceptance says how many
    /// are needed for options.vpls survivors, at most options.vpls / floor.
    /// @throws Error(limit_exceeded) when that would be more candidates than Limits::vpls.
    template <Executor E>
    [[nodiscard]] VplRecords sample(E& executor) const {
        const std::uint64_t pilot_vpls =
            std::min<std::uint64_t>(roulette_.pilot_vpls, limits_.vpls);
        const VplRecords pilot =
            candidates(pilot_vpls, independent_seed(options_.seed)).sample(executor);
        const VplRoulette<B, V> roulette(probe_, pilot, roulette_, executor);
        const double enlarged = std::ceil(options_.vpls / roulette.acceptance());
        const VplRecords from =
            candidates(static_cast<std::uint64_t>(enlarged), options_.seed).sample(executor);
        return roulette.filter(from, options_.seed, executor);
    }

 private:
    [[nodiscard]] Candidates candidates(std::uint64_t vpls, std::uint64_t seed) const {
        check_limit(vpls, limits_.vpls, "vpls");
        InstantRadiosityOptions options = options_;
        options.vpls = static_cast<std::uint32_t>(vpls);
        options.seed = seed;
        return {world_, options, limits_};
    }
    static std::uint64_t independent_seed(std::uint64_t seed) {
        // The index is one that no record has.
        constexpr auto stream = static_cast<std::uint32_t>(Stream::candidate);
        const Bits128 bits = philox4x32({{0, stream, ~0u, ~0u}}, seed);
        return std::uint64_t{bits.word[0]} << 32 | bits.word[1];
    }

    World world_;
    InstantRadiosityOptions options_;
    const ImageProbe<B, V>& probe_;
    VplRouletteOptions roulette_;
    Limits limits_;
};

}  // namespace mir
