// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/chain.hpp"
#include "mir/metropolis/metropolis_options.hpp"
#include "mir/metropolis/mixing_trace.hpp"
#include "mir/metropolis/suffix_refresh.hpp"
#include "mir/sampling/path_record.hpp"

#include <type_traits>
#include <utility>

namespace mir {

/// What a chain remembers while it runs, 26 kB: too much for a thread's own memory.
struct ChainMemory {
    ChainState state;
    /// With the current suffix, unless that is the state's own, and with a proposal.
    WeightedPath refreshed[2];
};

/// What a chain says of itself at its end.
struct ChainTally {
    ChainHealth health;  ///< summaries over chains are left at zero
    WeightMoments large_step_weights;
    bool is_broken = false;  ///< PathChain::is_broken(), or the same in a suffix
};

/// How much a chain may write.
struct ChainExtent {
    std::uint32_t wanted = 0;  ///< states, or new VPLs before ChainStop::paper stops
    std::uint64_t states = 0;  ///< recorded at most
    std::uint64_t steps = 0;   ///< of its trace, at most

    MIR_HD static ChainExtent of(const MetropolisOptions& options, std::uint32_t chain,
                                 std::uint32_t chains) {
        ChainExtent e;
        e.wanted = options.states / chains + (chain < options.states % chains ? 1 : 0);
        e.states = options.stop == ChainStop::paper ? paper_stop_cap * e.wanted : e.wanted;
        e.steps = e.states * options.stride;
        return e;
    }
};

/// Runs a whole chain, from its start to its last record. `intensity(path)` is what the record of a
/// path gets. The same on host and device, but for where records go. `Suffix` is a SuffixProposal.
template <class Generator, class Suffix, class Intensity>
struct ChainWalk {
    using World = std::remove_cvref_t<decltype(std::declval<const Generator&>().world())>;

    Generator generator;
    Suffix suffix;
    Intensity intensity;
    MetropolisOptions options;
    std::uint32_t chains = 1;

    /// Chain `chain` of `chains`. `out.record(VplRecord)` takes its records, `out.step(path)` the
    /// states between them for the trace.
    template <class Out>
    MIR_HD ChainTally operator()(std::uint32_t chain, LargeStep start, ChainMemory& memory,
                                 Out& out) const {
        PathChain<World, ChainRules, Generator> walk(generator, options.chain, options.seed, chain,
                                                     start, memory.state);
        const ChainExtent extent = ChainExtent::of(options, chain, chains);
        const bool paper = options.stop == ChainStop::paper;
        ChainTally tally;
        VplRecord last;
        std::uint64_t recorded = 0;
        std::uint32_t new_vpls = 0;
        while (recorded < extent.states && !(paper && new_vpls > extent.wanted)) {
            if (recorded > 0) advance(walk, out);
            const VplRecord next =
                record(walk.current(), index_of(chain, recorded), memory, tally, out);
            new_vpls += recorded == 0 || !is_same_vpl(last, next) ? 1u : 0u;
            last = next;
            ++recorded;
        }
        const MutationCount suffixes = tally.health.suffix;
        tally.health = walk.health();
        tally.health.suffix = suffixes;
        tally.health.recorded_states = recorded;
        tally.health.distinct_vpls = new_vpls;
        tally.health.capped = paper && new_vpls <= extent.wanted;
        tally.large_step_weights = walk.large_step_weights();
        tally.is_broken = tally.is_broken || walk.is_broken();
        return tally;
    }

 private:
    /// Names the random numbers of a state's suffixes, but for the refresh: 16 bits of the chain, 8
    /// of the refresh, 32 of the state.
    MIR_HD static std::uint64_t index_of(std::uint32_t chain, std::uint64_t state) {
        return (std::uint64_t{chain} << 40) | static_cast<std::uint32_t>(state);
    }

    template <class Walk, class Out>
    MIR_HD void advance(Walk& walk, Out& out) const {
        for (std::uint32_t i = 0; i < options.stride; ++i) {
            walk.step();
            out.step(walk.current());
        }
    }

    /// Records a state and further suffixes behind its VPL; returns the first record.
    template <class Out>
    MIR_HD VplRecord record(const WeightedPath& path, std::uint64_t index, ChainMemory& memory,
                            ChainTally& tally, Out& out) const {
        const World& world = generator.world();
        const std::uint32_t refreshes = path.path.edges() > 2 ? options.suffix_refresh : 0;
        const double share = 1.0 / (1.0 + refreshes);
        const VplRecord first = record_of(world, path, intensity(path), share);
        out.record(first);
        const WeightedPath* current = &path;
        double weight = suffix.weight(path.measure, path.path.edges());
        std::uint32_t spare = 0;
        for (std::uint32_t r = 0; r < refreshes; ++r) {
            const Random u(options.seed, Stream::suffix, index | (std::uint64_t{r} << 32));
            WeightedPath& proposal = memory.refreshed[spare];
            suffix.draw(path, u, proposal);
            const double a = acceptance(weight, proposal.weight);
            tally.is_broken = tally.is_broken || !is_finite(a);
            const bool moved = static_cast<double>(u.at(path_dimension::count)) < a;
            tally.health.suffix.add(moved);
            if (moved) {
                current = &proposal;
                weight = proposal.weight;
                spare = 1 - spare;
            }
            out.record(record_of(world, *current, intensity(*current), share));
        }
        return first;
    }
};

/// Where a chain in a kernel writes: arrays of the extent of a chain.
struct ChainArrays {
    VplRecord* records = nullptr;
    TraceSample* samples = nullptr;
    TraceRhythm rhythm;
    std::uint64_t record_count = 0;
    std::uint64_t sample_count = 0;

    MIR_HD void record(const VplRecord& r) { records[record_count++] = r; }
    MIR_HD void step(const WeightedPath& state) {
        if (rhythm.keeps_next()) samples[sample_count++] = TraceSample::of(state);
    }
};

/// What is kept of a chain that ran in a kernel, besides its arrays.
struct ChainReport {
    ChainTally tally;
    std::uint64_t records = 0;
    std::uint64_t samples = 0;
};

/// Runs chains `first` to `first` + n - 1. Kernel over n * spread indices, of which every
/// spread-th works: neighbouring threads of a device wait for each other, and chains part at once.
template <class Walk>
struct ChainWalks {
    Walk walk;
    std::uint32_t first = 0;
    std::uint32_t spread = 1;
    const std::uint32_t* starts = nullptr;  ///< paths of the bootstrap, by chain
    ChainMemory* memory = nullptr;          ///< below, all are of chain first + i at i
    VplRecord* records = nullptr;
    std::uint64_t records_per_chain = 0;
    TraceSample* samples = nullptr;
    std::uint64_t samples_per_chain = 0;
    ChainReport* reports = nullptr;

    MIR_HD void operator()(std::uint32_t index) const {
        if (index % spread != 0) return;
        const std::uint32_t i = index / spread;
        const std::uint32_t chain = first + i;
        ChainArrays out;
        out.records = records + i * records_per_chain;
        out.samples = samples + i * samples_per_chain;
        out.rhythm = TraceRhythm(ChainExtent::of(walk.options, chain, walk.chains).steps);
        const LargeStep start{Stream::bootstrap, starts[chain]};
        reports[i].tally = walk(chain, start, memory[i], out);
        reports[i].records = out.record_count;
        reports[i].samples = out.sample_count;
    }
};

}  // namespace mir
