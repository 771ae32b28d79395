// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/chain_walk.hpp"

#include <algorithm>

namespace mir {

/// Most that one chain brings home from a slice of its run.
struct SliceExtent {
    std::uint64_t records = 0;  ///< of VPLs
    std::uint64_t samples = 0;  ///< of its trace

    /// For slices of at most `mutations` of a chain.
    static SliceExtent of(const MetropolisOptions& options, std::uint32_t chain,
                          std::uint32_t chains, std::uint64_t mutations) {
        const ChainExtent whole = ChainExtent::of(options, chain, chains);
        const std::uint64_t states = std::min(whole.states, mutations / options.stride + 1);
        return {states * (1 + options.suffix_refresh),
                TraceRhythm(whole.steps).kept(std::min(whole.steps, mutations))};
    }
};

/// What is to be known of a chain after a slice.
struct SliceReport {
    ChainTally tally;           ///< once the chain has ended
    std::uint64_t records = 0;  ///< of this slice
    std::uint64_t samples = 0;  ///< of this slice
    bool has_ended = false;     ///< no slice of it is left
};

/// Where a chain in a kernel writes: a column of two tables. What all chains leave empty is the
/// tables' end.
struct ChainColumn {
    VplRecord* records = nullptr;    ///< of the chain: the j-th at records[j columns]
    TraceSample* samples = nullptr;  ///< as above
    std::size_t columns = 1;         ///< chains that share the tables
    TraceRhythm rhythm;              ///< which states are kept as samples
    std::uint64_t record_count = 0;  ///< written so far
    std::uint64_t sample_count = 0;  ///< written so far

    /// Writes the next record.
    MIR_HD void record(const VplRecord& r) { records[record_count++ * columns] = r; }
    /// Takes the next state, which becomes a sample if the rhythm keeps it.
    MIR_HD void step(const WeightedPath& state) {
        if (rhythm.keeps_next()) samples[sample_count++ * columns] = TraceSample::of(state);
    }
};

/// A slice of chains `first` to `first` + `count` - 1. Kernel over count * spread indices, and
/// every spread-th works: neighbouring threads of a device wait for each other, and chains part at
/// once.
template <class Walk>
struct ChainSlices {
    Walk walk;                              ///< a ChainWalk
    std::uint32_t mutations = 1;            ///< of each chain, at most
    bool is_first = true;                   ///< chains begin here; else they go on
    std::uint32_t first = 0;                ///< chain that the slice begins with
    std::uint32_t count = 0;                ///< chains of the slice
    std::uint32_t spread = 1;               ///< indices per chain
    const std::uint32_t* starts = nullptr;  ///< paths of the bootstrap, by chain
    ChainMemory* memory = nullptr;          ///< of chain first + i at i, like the reports
    SliceReport* reports = nullptr;         ///< one for each chain of the slice
    VplRecord* records = nullptr;    ///< the j-th of chain first + i at j * count + i, like samples
    TraceSample* samples = nullptr;  ///< both with room for the SliceExtent of each chain

    /// Chain first + index / spread, where index is a multiple of `spread`; else nothing.
    MIR_HD void operator()(std::uint32_t index) const {
        if (index % spread != 0) return;
        const std::uint32_t i = index / spread;
        const std::uint32_t chain = first + i;
        if (is_first) walk.start(chain, {Stream::bootstrap, starts[chain]}, memory[i]);
        const std::uint64_t steps = ChainExtent::of(walk.options, chain, walk.chains).steps;
        ChainColumn out{records + i, samples + i, count, TraceRhythm(steps, memory[i].state.step)};
        walk.advance(chain, mutations, memory[i], out);
        reports[i] = {walk.tally(chain, memory[i]), out.record_count, out.sample_count,
                      walk.has_ended(chain, memory[i])};
    }
};

}  // namespace mir
