// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/resident/chain_batch.hpp"
#include "mir/resident/uploaded_array.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/sampling/metropolis_sampler.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace mir {

/// How much a BackendMetropolis does at a time. Its result does not depend on it.
struct ChainPortions {
    /// Memory of the chains that run at a time, unless one alone needs more.
    std::uint64_t bytes = std::uint64_t{1} << 29;
    /// Of each chain in one kernel, at least 1. A mutation traces some dozens of rays one after the
    /// other, 0.3 ms of an H200: this many end before the watchdog of a display (2 s) or somebody
    /// who cancels loses patience, and hide what starting a kernel costs.
    std::uint32_t mutations = 1024;
};

/// MetropolisSampler on a backend. Bootstrap and chains run as kernels, only the chains' starts are
/// chosen on the host. Same records and health, in every bit, as MetropolisSampler over the same
/// scene, ray caster and visibility, where neither compiler fuses products (docs/embedding.md).
/// Memory: for each of the chains that run at a time a ChainMemory, and the records and the samples
/// of its trace that one kernel may make. Const use by one thread per queue.
template <Backend B, class World>
    requires(World::space == B::space)
class BackendMetropolis {
 public:
    /// What `world` views must outlive it.
    /// @throws Error(invalid_argument) when options or portions are out of range,
    ///         Error(limit_exceeded) when more states are wanted than `limits` allows VPLs.
    BackendMetropolis(const B& backend, const World& world, const MetropolisOptions& options,
                      const Limits& limits = {}, const ChainPortions& portions = {})
        : backend_(backend),
          options_(options),
          portions_(portions),
          generator_(world,
                     TechniqueTable(options.min_edges(), options.max_edges(), options.techniques)),
          suffix_(world, generator_.techniques()) {
        options.check(limits);
        expects(portions.mutations > 0,
                "0 mutations were asked for in one kernel (no chain would ever end); ask for at "
                "least 1, 1024 is usual");
    }

    /// Runs bootstrap and chains; all work is done when it returns or throws. No record comes out
    /// when no path carries light. `monitor` may be null.
    /// @throws Error(cancelled) between kernels; what the backend throws.
    [[nodiscard]] VplRecords sample(typename B::Queue& queue, Monitor* monitor = nullptr) const {
        Machine machine{*this, queue, monitor};
        return run_chains(generator_.world().lights, options_, machine);
    }

 private:
    using Generator = PathGenerator<World>;
    using Walk = ChainWalk<Generator, SuffixProposal<World>, UnitRadiance>;

    struct Machine {
        const BackendMetropolis& sampler;
        typename B::Queue& queue;
        Monitor* monitor;

        void draw(std::uint64_t first, std::span<double> weights,
                  std::span<std::uint32_t> places) const {
            sampler.draw(queue, monitor, first, weights, places);
        }
        [[nodiscard]] std::vector<ChainRun> walk(const std::vector<std::uint32_t>& starts) const {
            return sampler.walk(queue, monitor, starts);
        }
    };

    void draw(typename B::Queue& queue, Monitor* monitor, std::uint64_t first,
              std::span<double> weights, std::span<std::uint32_t> places) const;
    [[nodiscard]] std::vector<ChainRun> walk(typename B::Queue& queue, Monitor* monitor,
                                             const std::vector<std::uint32_t>& starts) const;
    [[nodiscard]] ChainBatch<B> make_batch(std::uint32_t chains) const;
    void walk_batch(typename B::Queue& queue, Monitor* monitor, ChainSlices<Walk> slices,
                    ChainBatch<B>& batch, std::span<ChainRun> runs) const;

    B backend_;
    MetropolisOptions options_;
    ChainPortions portions_;
    Generator generator_;
    SuffixProposal<World> suffix_;
};

template <Backend B, class World>
    requires(World::space == B::space)
void BackendMetropolis<B, World>::draw(typename B::Queue& queue, Monitor* monitor,
                                       std::uint64_t first, std::span<double> weights,
                                       std::span<std::uint32_t> places) const {
    constexpr std::size_t at_a_time = 1u << 18;
    const std::size_t most = std::min(weights.size(), at_a_time);
    auto weights_there = backend_.template buffer<double>(most);
    auto places_there = backend_.template buffer<std::uint32_t>(most);
    const WaitAtEnd wait(queue);
    for (std::size_t i = 0; i < weights.size(); i += most) {
        if (monitor != nullptr) monitor->check();
        const std::size_t n = std::min(most, weights.size() - i);
        queue.for_each(static_cast<std::uint32_t>(n),
                       BootstrapPaths<Generator>{generator_, options_.seed, first + i,
                                                 weights_there.data(), places_there.data()});
        queue.download(weights_there, weights.subspan(i, n));
        queue.download(places_there, places.subspan(i, n));
        queue.record().sync();
    }
}

template <Backend B, class World>
    requires(World::space == B::space)
ChainBatch<B> BackendMetropolis<B, World>::make_batch(std::uint32_t chains)
const {
    // Chains have one of two lengths. The longer one writes most records, but may keep fewer
    // samples.
    const auto longer = SliceExtent::of(options_, 0, chains, portions_.mutations);
    const auto shorter = SliceExtent::of(options_, chains - 1, chains, portions_.mutations);
    const SliceExtent most{longer.records, std::max(longer.samples, shorter.samples)};
    const std::uint64_t count = portions_.bytes / ChainBatch<B>::bytes_of_one(most);
    return {backend_, std::clamp(count, std::uint64_t{1}, std::uint64_t{chains}), most};
}

template <Backend B, class World>
    requires(World::space == B::space)
std::vector<ChainRun> BackendMetropolis<B, World>::walk(typename B::Queue& queue, Monitor* monitor,
                                                        const std::vector<std::uint32_t>& starts)
const {
    const auto chains = static_cast<std::uint32_t>(starts.size());
    ChainBatch<B> batch = make_batch(chains);
    std::vector<ChainRun> runs(chains);
    const UploadedArray<B, std::uint32_t> starts_there(backend_, queue, starts);
    const WaitAtEnd wait(queue);
    batch.clear(queue);
    ChainSlices<Walk> slices{{generator_, suffix_, {}, options_, chains}, portions_.mutations};
    slices.starts = starts_there.data();
    for (slices.first = 0; slices.first < chains; slices.first += slices.count) {
        slices.count = std::min(batch.chains(), chains - slices.first);
        walk_batch(queue, monitor, slices, batch,
                   std::span(runs).subspan(slices.first, slices.count));
    }
    return runs;
}

template <Backend B, class World>
    requires(World::space == B::space)
void BackendMetropolis<B, World>::walk_batch(typename B::Queue& queue, Monitor* monitor,
                                             ChainSlices<Walk> slices, ChainBatch<B>& batch,
                                             std::span<ChainRun> runs) const {
    batch.lend(slices);
    // A thread block for each chain, while there are few of them: they share nothing.
    slices.spread = slices.count <= 1024 ? 256 : slices.count <= 8192 ? 32 : 1;
    do {
        if (monitor != nullptr) monitor->check();
        queue.for_each(slices.count * slices.spread, slices);
        slices.is_first = false;
    } while (!batch.bring_home(queue, runs));
}

}  // namespace mir
