// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/stopwatch.hpp"
#include "mir/metropolis/bootstrap.hpp"
#include "mir/metropolis/chain_walk.hpp"

#include <algorithm>
#include <vector>

namespace mir {

/// What one chain brings home.
struct ChainRun {
    std::vector<VplRecord> records;  ///< in the order of the chain's states
    MixingTrace trace;               ///< of all states, recorded or not, thinned
    ChainTally tally;                ///< of the chain's end
};

namespace detail {

inline void check_runs(const std::vector<ChainRun>& runs) {
    for (const ChainRun& run : runs)
        if (run.tally.is_broken)
            throw Error(ErrorCode::internal,
                        "a number in the acceptance of a mutation is negative or not finite (a "
                        "contribution or a density overflowed on the device); please report the "
                        "scene");
}

inline ChainHealth health_of(const std::vector<ChainRun>& runs, const Bootstrap& seeds,
                             std::vector<std::uint32_t> starts) {
    ChainHealth h;
    h.luminance = seeds.luminance;
    WeightMoments large;
    std::vector<const MixingTrace*> traces;
    for (const ChainRun& run : runs) {
        h.add(run.tally.health);
        large.add(run.tally.large_step_weights);
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

}  // namespace detail

/// Bootstrap and chains on any machine, from first path to records. `lights` tells power() and
/// whether there are any; `machine.draw(first, weights, places)` is the `draw` of grow_bootstrap(),
/// `machine.walk(starts)` returns a ChainRun for each start. No record comes out when no path
/// carries light: a result of zero that health.luminance explains.
template <class Lights, class Machine>
VplRecords run_chains(const Lights& lights, const MetropolisOptions& options, Machine& machine) {
    VplRecords out;
    out.emitted_power = static_cast<float>(lights.power());
    out.health.emplace();
    if (lights.empty()) return out;
    const std::uint32_t wanted = std::min(options.chains, options.states);
    const Bootstrap seeds = [&] {
        const Stopwatch watch(out.bootstrap_seconds);
        return grow_bootstrap(
            options.bootstrap.for_starts(wanted),
            [&](std::uint64_t first, std::span<double> weights, std::span<std::uint32_t> places) {
                machine.draw(first, weights, places);
            });
    }();
    out.paths = seeds.luminance.paths;
    out.health->luminance = seeds.luminance;
    if (!(seeds.luminance.mean > 0.0)) return out;

    const Random choice(options.seed, Stream::seeding, 0);
    const double turn = fine_uniform(choice.at(0), choice.at(1));
    const std::uint32_t chains =
        options.bootstrap.starts_at(seeds.luminance.relative_error(), wanted);
    const auto starts = chain_starts(seeds, chains, turn);
    const std::vector<ChainRun> runs = machine.walk(starts);
    detail::check_runs(runs);
    for (const ChainRun& run : runs)
        out.records.insert(out.records.end(), run.records.begin(), run.records.end());
    out.health = detail::health_of(runs, seeds, starts);
    out.path_luminance = seeds.luminance.mean;
    out.states = static_cast<double>(out.health->recorded_states);
    out.non_lambertian_share = share_of_non_lambertian(out.records);
    return out;
}

}  // namespace mir
