// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/chain_run.hpp"

#include <memory>

namespace mir {

/// Chains over the paths of one generator, from bootstrap to records. They run on the threads of
/// an executor. Generator, `suffix` and what they refer to must outlive it; const use from any
/// thread.
template <class World, class Generator>
class ChainEnsemble {
 public:
    /// `options` must be valid.
    ChainEnsemble(const Generator& generator, const SuffixProposal<World>& suffix,
                  const MetropolisOptions& options)
        : generator_(generator), suffix_(suffix), options_(options) {}

    /// Runs bootstrap and chains. `intensity(path)` is what the record of a path gets. No record
    /// comes out when no path carries light: a result of zero that health.luminance explains.
    /// Paths of the bootstrap come from `shared`, unless it is empty.
    template <class Intensity, Executor E>
    [[nodiscard]] VplRecords run(const Intensity& intensity, E& executor,
                                 const SharedDraw& shared = {}) const {
        Threads<Intensity, E> machine{*this, intensity, executor, shared};
        return run_chains(generator_.world().lights, options_, machine);
    }

 private:
    /// What ChainWalk writes to.
    struct Vectors {
        ChainRun& run;

        void record(const VplRecord& r) { run.records.push_back(r); }
        void step(const WeightedPath& state) { run.trace.add(state); }
    };

    template <class Intensity, Executor E>
    struct Threads {
        const ChainEnsemble& ensemble;
        const Intensity& intensity;
        E& executor;
        const SharedDraw& shared;

        void draw(std::uint64_t first, std::span<double> weights,
                  std::span<std::uint32_t> places) const {
            const auto here = [this](std::uint64_t begin, std::span<double> w,
                                     std::span<std::uint32_t> p) {
                draw_paths(ensemble.generator_, ensemble.options_.seed, begin, w, p, executor);
            };
            if (shared) return shared(first, weights, places, here);
            here(first, weights, places);
        }

        [[nodiscard]] std::vector<ChainRun> walk(const std::vector<std::uint32_t>& starts) const {
            const auto chains = static_cast<std::uint32_t>(starts.size());
            const ChainWalk<Generator, SuffixProposal<World>, Intensity> walk{
                ensemble.generator_, ensemble.suffix_, intensity, ensemble.options_, chains};
            std::vector<ChainRun> runs(chains);
            executor.for_each(chains, [&](std::size_t i) {
                const auto chain = static_cast<std::uint32_t>(i);
                const std::uint64_t steps = ChainExtent::of(walk.options, chain, chains).steps;
                runs[i].trace = MixingTrace(steps);
                Vectors out{runs[i]};
                const auto memory = std::make_unique<ChainMemory>();
                walk.start(chain, {Stream::bootstrap, starts[i]}, *memory);
                walk.advance(chain, steps, *memory, out);
                runs[i].tally = walk.tally(chain, *memory);
            });
            return runs;
        }
    };

    const Generator& generator_;
    const SuffixProposal<World>& suffix_;
    const MetropolisOptions& options_;
};

}  // namespace mir
