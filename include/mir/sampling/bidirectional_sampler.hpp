// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/sampler.hpp"
#include "mir/core/limits.hpp"
#include "mir/metropolis/systematic_resampling.hpp"
#include "mir/paths/path_place.hpp"
#include "mir/paths/path_record.hpp"
#include "mir/sampling/target_floor.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mir {

/// How many VPLs a BidirectionalSampler draws, from what, and how far paths go.
struct BidirectionalOptions {
    std::uint32_t vpls = 256;       ///< N': drawn from the candidates; some may coincide
    std::uint32_t candidates = 32;  ///< per VPL, at least 1
    TargetFloor floor;              ///< least worth of light that the probe does not see
    bool emitter_vpls = false;      ///< also place VPLs on the lamps: direct light by VPLs
    std::uint8_t max_bounce = 32;   ///< largest number of scattering events, 1..63
    std::uint64_t seed = 0;         ///< of candidates and of the choice among them
};

/// What the weights of resampled importance sampling are made of.
struct ResamplingRules : VplDensity {
    /// Estimate of the target's integral: candidates without light count.
    static double mean(std::span<const double> weights) {
        return std::accumulate(weights.begin(), weights.end(), 0.0) /
               static_cast<double>(weights.size());
    }
};

/// Bidirectional instant radiosity by resampled importance sampling. Many candidates are drawn from
/// the lamps and from what the camera sees (VplGenerator); those that give most to the image, as a
/// probe judges, are kept. With weights w = P~ / q of the candidates, a VPL that is drawn by weight
/// brings J = (mean(w) / N') R / P~: about the same flux each. Unbiased for any number of
/// candidates, because P~ is positive wherever there is light and fixed beforehand. Model of
/// Sampler. Sources: Segovia, Iehl, Mitanchey, Peroche, "Bidirectional instant radiosity", EGSR
/// 2006; Talbot, Cline, Egbert, "Importance resampling for global illumination", EGSR 2005. Scene
/// data and probe must outlive it; const use from any thread.
template <class World, class Rules = ResamplingRules>
class BidirectionalSampler {
 public:
    static constexpr Normalisation normalisation = Normalisation::none;  ///< intensities are J

    /// What makes a candidate from numbers.
    using Generator = VplGenerator<World, Rules>;
    /// What judges candidates.
    using Probe = typename Generator::Probe;

    /// @throws Error(invalid_argument) when options are out of range. Error(limit_exceeded) when
    /// more VPLs are wanted than `limits` allows.
    BidirectionalSampler(World world, const Probe& probe, const BidirectionalOptions& options,
                         const Limits& limits = {})
        : world_(std::move(world)), probe_(probe), options_(options) {
        expects(options.vpls > 0,
                "0 VPLs were asked for (there would be no light); ask for at least 1, 256 is "
                "usual");
        expects(options.candidates > 0 && options.candidates <= 1u << 16,
                "the candidates per VPL must be 1 to 65536; 32 are usual");
        expects(std::uint64_t{options.vpls} * options.candidates <= max_candidates,
                "more than 2^28 candidates were asked for (all are kept at once); ask for fewer "
                "per VPL");
        options.floor.validate();
        check_limit(options.vpls, limits.vpls, "vpls");
        static_cast<void>(TechniqueTable(min_edges(), max_edges(), PathTechniques::bidirectional));
    }

    /// Weighs the candidates and draws from them. One record for each that is drawn, its weight
    /// the number of times; none when no candidate carries light.
    template <Executor E>
    [[nodiscard]] VplRecords sample(E& executor) const {
        VplRecords out;
        out.emitted_power = static_cast<float>(world_.lights.power());
        if (world_.lights.empty()) return out;
        const auto generator = generator_with_floor<Generator>(
            world_, probe_, min_edges(), max_edges(), options_.floor, options_.seed, executor);
        out.paths = std::uint64_t{options_.vpls} * options_.candidates;
        out.records = draw(generator, weigh(generator, out.paths, executor));
        out.non_lambertian_share = share_of_non_lambertian(out.records);
        return out;
    }

 private:
    static constexpr std::uint64_t max_candidates = 1u << 28;

    [[nodiscard]] std::uint32_t min_edges() const { return options_.emitter_vpls ? 2 : 3; }
    [[nodiscard]] std::uint32_t max_edges() const { return std::uint32_t{options_.max_bounce} + 1; }

    struct Candidate {
        std::uint64_t index = 0;
        std::uint64_t order = 0;
        double weight = 0.0;
    };

    /// The candidates, ordered so that neighbours in path space are adjacent. Systematic resampling
    /// then spreads the VPLs evenly over bounces and places. Source: Gerber, Chopin, Whiteley,
    /// "Negative association, ordering and convergence of resampling methods", 2019.
    template <Executor E>
    [[nodiscard]] std::vector<Candidate> weigh(const Generator& generator, std::uint64_t count,
                                               E& executor) const {
        std::vector<Candidate> candidates(count);
        each_path(generator, {options_.seed, Stream::candidate, 0, count}, executor,
                  [&](std::uint64_t i, const WeightedPath& p) {
                      const bool lit = p.weight > 0.0;
                      candidates[i] = {i, lit ? place_in_path_space(p.path) : 0, p.weight};
                  });
        std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
            return a.order != b.order ? a.order < b.order : a.index < b.index;
        });
        return candidates;
    }

    /// Bounce first, then a space-filling curve through the places of the VPLs.
    [[nodiscard]] std::uint64_t place_in_path_space(const Path& path) const {
        return std::uint64_t{path.bounce()} << 30 | place_of_vpl(world_, path);
    }

    [[nodiscard]] std::vector<VplRecord> draw(const Generator& generator,
                                              const std::vector<Candidate>& candidates) const {
        std::vector<double> weights;
        for (const Candidate& c : candidates) weights.push_back(c.weight);
        const double mean = Rules::mean(weights);
        std::vector<VplRecord> records;
        if (!(mean > 0.0)) return records;
        std::vector<std::uint32_t> times(weights.size());
        const Random number(options_.seed, Stream::seeding, 0);
        for (const std::uint32_t i : systematic_resampling(
                 weights, options_.vpls, fine_uniform(number.at(0), number.at(1))))
            ++times[i];
        WeightedPath p;
        for (std::size_t i = 0; i < times.size(); ++i) {
            if (times[i] == 0) continue;
            generator.generate(Random(options_.seed, Stream::candidate, candidates[i].index), p);
            const double share = mean * times[i] / options_.vpls;
            const WideRgb j = p.measure.leaving * (share / generator.target(p.measure));
            records.push_back(record_of(world_, p, narrowed(j), times[i]));
        }
        return records;
    }

    World world_;
    const Probe& probe_;
    BidirectionalOptions options_;
};

}  // namespace mir
