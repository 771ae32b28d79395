// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/chain.hpp"
#include "mir/metropolis/metropolis_options.hpp"
#include "mir/metropolis/mixing_trace.hpp"
#include "mir/metropolis/suffix_refresh.hpp"
#include "mir/paths/path_record.hpp"

#include <type_traits>
#include <utility>

namespace mir {

/// What a chain remembers while it runs, 26 kB. Too much for a thread's own memory.
struct ChainMemory {
    ChainState state;  ///< where the chain stands
    /// With the current suffix, unless that is the state's own, and with a proposal.
    WeightedPath refreshed[2];
    VplRecord last;  ///< the first record of the state recorded last
};

/// What a chain says of itself at its end.
struct ChainTally {
    ChainHealth health;                ///< summaries over chains are left at zero
    WeightMoments large_step_weights;  ///< PathChain::large_step_weights()
    bool is_broken = false;            ///< ChainState::is_broken
};

/// How much a chain may write.
struct ChainExtent {
    std::uint32_t wanted = 0;  ///< states, or new VPLs before ChainStop::paper stops
    std::uint64_t states = 0;  ///< recorded at most
    std::uint64_t steps = 0;   ///< of its trace, at most

    /// Of chain number `chain` out of `chains`, which share options.states as evenly as they can.
    MIR_HD static ChainExtent of(const MetropolisOptions& options, std::uint32_t chain,
                                 std::uint32_t chains) {
        ChainExtent e;
        e.wanted = options.states / chains + (chain < options.states % chains ? 1 : 0);
        e.states = options.stop == ChainStop::paper ? paper_stop_cap * e.wanted : e.wanted;
        e.steps = e.states * options.stride;
        return e;
    }
};

/// Runs chains, each from its start to its last record. Slices may have any length and leave no
/// trace in the result. `intensity(path)` is what the record of a path gets. The same on host and
/// device, except for where records go. `Suffix` is a SuffixProposal.
template <class Generator, class Suffix, class Intensity>
struct ChainWalk {
    /// The scene that paths run through.
    using World = std::remove_cvref_t<decltype(std::declval<const Generator&>().world())>;
    /// What makes the mutations.
    using Chain = PathChain<World, ChainRules, Generator>;

    Generator generator;        ///< of paths
    Suffix suffix;              ///< draws further light paths behind a VPL
    Intensity intensity;        ///< intensity(path) is an Rgb
    MetropolisOptions options;  ///< valid ones
    std::uint32_t chains = 1;   ///< of the run, those of other threads included

    /// Begins chain `chain` of `chains` at a path of the bootstrap that carries light. Of what the
    /// memory was before nothing is read.
    MIR_HD void start(std::uint32_t chain, LargeStep first, ChainMemory& memory) const {
        Chain(generator, options.chain, options.seed, chain, memory.state).start(first);
    }

    /// Goes on by `mutations`, or by as many as the chain lacks. `out.record(VplRecord)` takes its
    /// records, `out.step(path)` the states between them for the trace.
    template <class Out>
    MIR_HD void advance(std::uint32_t chain, std::uint64_t mutations, ChainMemory& memory,
                        Out& out) const {
        Chain walk(generator, options.chain, options.seed, chain, memory.state);
        const ChainExtent extent = ChainExtent::of(options, chain, chains);
        const ChainHealth& health = memory.state.health;
        for (std::uint64_t made = 0;; ++made) {
            if (walk.steps() == health.recorded_states * options.stride)
                record(walk.current(), chain, memory, out);
            if (made == mutations || has_ended(health, extent)) return;
            walk.step();
            out.step(walk.current());
        }
    }

    /// Whether advance() has nothing left to do.
    [[nodiscard]] MIR_HD bool has_ended(std::uint32_t chain, const ChainMemory& memory) const {
        return has_ended(memory.state.health, ChainExtent::of(options, chain, chains));
    }

    /// Of a chain that has ended.
    [[nodiscard]] MIR_HD ChainTally tally(std::uint32_t chain, const ChainMemory& memory) const {
        const ChainState& state = memory.state;
        ChainTally t{state.health, state.large_weights, state.is_broken};
        t.health.capped = options.stop == ChainStop::paper &&
                          !found_enough(t.health, ChainExtent::of(options, chain, chains));
        return t;
    }

 private:
    /// Names the random numbers of a state's suffixes, except for the refresh. It holds 22 bits of
    /// the chain, 8 of the refresh, 32 of the state.
    MIR_HD static std::uint64_t index_of(std::uint32_t chain, std::uint64_t state) {
        return (std::uint64_t{chain} << 40) | static_cast<std::uint32_t>(state);
    }

    MIR_HD static bool found_enough(const ChainHealth& health, const ChainExtent& extent) {
        return health.distinct_vpls > extent.wanted;
    }
    [[nodiscard]] MIR_HD bool has_ended(const ChainHealth& health,
                                        const ChainExtent& extent) const {
        return health.recorded_states == extent.states ||
               (options.stop == ChainStop::paper && found_enough(health, extent));
    }

    /// Records a state and counts it.
    template <class Out>
    MIR_HD void record(const WeightedPath& path, std::uint32_t chain, ChainMemory& memory,
                       Out& out) const {
        ChainHealth& health = memory.state.health;
        const VplRecord next =
            record_suffixes(path, index_of(chain, health.recorded_states), memory, out);
        const bool is_new = health.recorded_states == 0 || !is_same_vpl(memory.last, next);
        health.distinct_vpls += is_new ? 1 : 0;
        ++health.recorded_states;
        memory.last = next;
    }

    /// Records a state and further suffixes behind its VPL; returns the first record.
    template <class Out>
    MIR_HD VplRecord record_suffixes(const WeightedPath& path, std::uint64_t index,
                                     ChainMemory& memory, Out& out) const {
        const World& world = generator.world();
        ChainState& state = memory.state;
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
            state.is_broken = state.is_broken || !is_finite(a);
            const bool moved = static_cast<double>(u.at(path_dimension::count)) < a;
            state.health.suffix.add(moved);
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

}  // namespace mir
