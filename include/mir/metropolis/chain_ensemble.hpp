// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/bootstrap.hpp"
#include "mir/metropolis/chain.hpp"
#include "mir/metropolis/metropolis_options.hpp"
#include "mir/metropolis/mixing_trace.hpp"
#include "mir/metropolis/suffix_refresh.hpp"
#include "mir/sampling/path_record.hpp"

namespace mir {

/// Chains over the paths of one generator, from their bootstrap to their records. Generator,
/// `suffix` and what they refer to must outlive it; const use from any thread.
template <class World, class Generator>
class ChainEnsemble {
 public:
    /// `options` must be valid.
    ChainEnsemble(const Generator& generator, const SuffixProposal<World>& suffix,
                  const MetropolisOptions& options)
        : generator_(generator), suffix_(suffix), options_(options) {}

    /// Runs bootstrap and chains. `intensity(path)` is what the record of a path gets. No record
    /// comes out when no path carries light: a result of zero that health.luminance explains.
    template <class Intensity, Executor E>
    [[nodiscard]] VplRecords run(const Intensity& intensity, E& executor) const;

 private:
    /// What one chain brings home.
    struct Run {
        std::vector<VplRecord> records;
        MixingTrace trace;
        WeightMoments large_step_weights;
        MutationCount suffix;
        ChainHealth health;
    };

    [[nodiscard]] std::uint32_t states_of(std::uint32_t chain, std::uint32_t chains) const {
        return options_.states / chains + (chain < options_.states % chains ? 1 : 0);
    }
    template <class Intensity>
    [[nodiscard]] Run run_chain(const Intensity& intensity, std::uint32_t chain,
                                std::uint32_t chains, LargeStep start) const;
    template <class Intensity>
    void record(const Intensity& intensity, const WeightedPath& path, std::uint32_t chain,
                std::uint32_t number, Run& run) const;
    [[nodiscard]] static ChainHealth summary(const std::vector<Run>& runs, const Bootstrap& seeds,
                                             std::vector<std::uint32_t> starts);

    const Generator& generator_;
    const SuffixProposal<World>& suffix_;
    const MetropolisOptions& options_;
};

template <class World, class Generator>
template <class Intensity, Executor E>
VplRecords ChainEnsemble<World, Generator>::run(const Intensity& intensity, E& executor) const {
    VplRecords out;
    out.emitted_power = static_cast<float>(generator_.world().lights.power());
    out.health.emplace();
    if (generator_.world().lights.empty()) return out;
    const Bootstrap seeds = bootstrap(generator_, options_.bootstrap, options_.seed, executor);
    out.paths = seeds.luminance.paths;
    out.health->luminance = seeds.luminance;
    if (!(seeds.luminance.mean > 0.0)) return out;

    const std::uint32_t chains = std::min(options_.chains, options_.states);
    Random choice(options_.seed, Stream::seeding, 0);
    const double turn = fine_uniform(choice.at(0), choice.at(1));
    const auto starts = chain_starts(seeds, chains, turn);
    std::vector<Run> runs(chains);
    executor.for_each(chains, [&](std::size_t c) {
        runs[c] = run_chain(intensity, static_cast<std::uint32_t>(c), chains,
                            {Stream::bootstrap, std::uint64_t{starts[c]}});
    });
    for (const Run& run : runs)
        out.records.insert(out.records.end(), run.records.begin(), run.records.end());
    out.health = summary(runs, seeds, starts);
    out.path_luminance = seeds.luminance.mean;
    out.states = static_cast<double>(out.health->recorded_states);
    out.non_lambertian_share = share_of_non_lambertian(out.records);
    return out;
}

template <class World, class Generator>
template <class Intensity>
auto ChainEnsemble<World, Generator>::run_chain(const Intensity& intensity, std::uint32_t chain,
                                                std::uint32_t chains, LargeStep start) const
    -> Run {
    Run run;
    PathChain<World, ChainRules, Generator> walk(generator_, options_.chain, options_.seed, chain,
                                                 start);
    const std::uint32_t wanted = states_of(chain, chains);
    const bool paper = options_.stop == ChainStop::paper;
    const std::uint64_t most = paper ? paper_stop_cap * wanted : wanted;
    run.trace = MixingTrace(most * options_.stride);
    std::uint64_t recorded = 0;
    std::uint32_t new_vpls = 0;
    while (recorded < most && !(paper && new_vpls > wanted)) {
        if (recorded > 0)
            for (std::uint32_t i = 0; i < options_.stride; ++i) {
                walk.step();
                run.trace.add(walk.current());
            }
        const std::size_t before = run.records.size();
        record(intensity, walk.current(), chain, static_cast<std::uint32_t>(recorded++), run);
        const bool moved =
            before == 0 || !is_same_vpl(run.records[before - 1], run.records[before]);
        new_vpls += moved ? 1 : 0;
    }
    run.health = walk.health();
    run.health.suffix = run.suffix;
    run.health.recorded_states = recorded;
    run.health.distinct_vpls = new_vpls;
    run.health.capped = paper && new_vpls <= wanted;
    run.large_step_weights = walk.large_step_weights();
    return run;
}

template <class World, class Generator>
template <class Intensity>
void ChainEnsemble<World, Generator>::record(const Intensity& intensity, const WeightedPath& path,
                                             std::uint32_t chain, std::uint32_t number,
                                             Run& run) const {
    const World& world = generator_.world();
    const std::uint32_t refreshes = path.path.edges() > 2 ? options_.suffix_refresh : 0;
    const double share = 1.0 / (1.0 + refreshes);
    run.records.push_back(record_of(world, path, intensity(path), share));
    WeightedPath current = path;
    current.weight = suffix_.weight(path.measure, path.path.edges());
    WeightedPath proposal;
    for (std::uint32_t r = 0; r < refreshes; ++r) {
        const Random u(options_.seed, Stream::suffix,
                       (std::uint64_t{chain} << 40) | (std::uint64_t{r} << 32) | number);
        suffix_.draw(path, u, proposal);
        const double a = acceptance(current.weight, proposal.weight);
        const bool moved = static_cast<double>(u.at(path_dimension::count)) < a;
        run.suffix.add(moved);
        if (moved) std::swap(current, proposal);
        run.records.push_back(record_of(world, current, intensity(current), share));
    }
}

template <class World, class Generator>
ChainHealth ChainEnsemble<World, Generator>::summary(const std::vector<Run>& runs,
                                                     const Bootstrap& seeds,
                                                     std::vector<std::uint32_t> starts) {
    ChainHealth h;
    h.luminance = seeds.luminance;
    WeightMoments large;
    std::vector<const MixingTrace*> traces;
    for (const Run& run : runs) {
        h.add(run.health);
        large.add(run.large_step_weights);
        traces.push_back(&run.trace);
    }
    h.large_step_luminance = large.estimate();
    const Mixing mixing = mixing_of(traces);
    h.split_r_hat = mixing.split_r_hat;
    // Starts are independent draws of the target; traces of chains that never moved look ideal.
    std::sort(starts.begin(), starts.end());
    const auto distinct = std::unique(starts.begin(), starts.end()) - starts.begin();
    const std::uint64_t visited =
        h.chains + h.large.accepted + h.small.accepted + h.bidirectional.accepted;
    h.effective_samples =
        std::min(std::max(mixing.effective_sample_size, static_cast<double>(distinct)),
                 static_cast<double>(std::min(h.recorded_states, visited)));
    return h;
}

}  // namespace mir
