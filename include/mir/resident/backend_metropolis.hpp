// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/metropolis/metropolis_sampler.hpp"
#include "mir/resident/uploaded_array.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace mir {

/// MetropolisSampler on a backend: bootstrap and chains run as kernels, only the chains' starts are
/// chosen on the host. Same records and health, in every bit, as MetropolisSampler over the same
/// scene, ray caster and visibility, where neither compiler fuses products (docs/embedding.md).
/// Memory: for each of the chains that run at a time a ChainMemory, the records that it may make
/// and up to 4096 samples of its trace; `bytes` for all of them, unless one chain alone needs more.
/// Const use by one thread per queue.
template <Backend B, class World>
    requires(World::space == B::space)
class BackendMetropolis {
 public:
    /// What `world` views must outlive it.
    /// @throws Error(invalid_argument) when options are out of range, Error(limit_exceeded) when
    ///         more states are wanted than `limits` allows VPLs.
    BackendMetropolis(const B& backend, const World& world, const MetropolisOptions& options,
                      const Limits& limits = {}, std::uint64_t bytes = std::uint64_t{1} << 29)
        : backend_(backend),
          options_(options),
          bytes_(bytes),
          generator_(world,
                     TechniqueTable(options.min_edges(), options.max_edges(), options.techniques)),
          suffix_(world, generator_.techniques()) {
        options.check(limits);
    }

    /// Runs bootstrap and chains; all work is done when it returns. No record comes out when no
    /// path carries light. `monitor` may be null.
    /// @throws Error(cancelled) between kernels, each of which runs a batch of chains to their
    ///         ends; what the backend throws.
    [[nodiscard]] VplRecords sample(typename B::Queue& queue, Monitor* monitor = nullptr) const {
        Machine machine{*this, queue, monitor};
        return run_chains(generator_.world().lights, options_, machine);
    }

 private:
    using Generator = PathGenerator<World>;
    using Walk = ChainWalk<Generator, SuffixProposal<World>, UnitRadiance>;
    template <class T>
    using Buffer = typename B::template Buffer<T>;

    /// Arrays of the chains that run at a time.
    struct Batch {
        std::uint32_t chains;
        std::uint64_t records_per_chain;
        std::uint64_t samples_per_chain;
        Buffer<ChainMemory> memory;
        Buffer<VplRecord> records;
        Buffer<TraceSample> samples;
        Buffer<ChainReport> reports;

        Batch(const B& backend, std::uint32_t count, std::uint64_t records_each,
              std::uint64_t samples_each)
            : chains(count),
              records_per_chain(records_each),
              samples_per_chain(samples_each),
              memory(backend.template buffer<ChainMemory>(count)),
              records(backend.template buffer<VplRecord>(count * records_each)),
              samples(backend.template buffer<TraceSample>(count * samples_each)),
              reports(backend.template buffer<ChainReport>(count)) {}
    };

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
    void walk_batch(typename B::Queue& queue, const Walk& walk, const std::uint32_t* starts,
                    std::uint32_t first, Batch& batch, std::span<ChainRun> runs) const;
    [[nodiscard]] Batch make_batch(std::uint32_t chains) const;

    B backend_;
    MetropolisOptions options_;
    std::uint64_t bytes_;
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
auto BackendMetropolis<B, World>::make_batch(std::uint32_t chains) const -> Batch {
    // Chains have one of two lengths. The longer one writes most records, but may keep fewer
    // samples.
    const ChainExtent longer = ChainExtent::of(options_, 0, chains);
    const ChainExtent shorter = ChainExtent::of(options_, chains - 1, chains);
    const std::uint64_t records = longer.states * (1 + options_.suffix_refresh);
    const std::uint64_t samples = std::max(TraceRhythm(longer.steps).kept(longer.steps),
                                           TraceRhythm(shorter.steps).kept(shorter.steps));
    const std::uint64_t bytes = sizeof(ChainMemory) + sizeof(ChainReport) +
                                records * sizeof(VplRecord) + samples * sizeof(TraceSample);
    const auto count = std::clamp<std::uint64_t>(bytes_ / bytes, 1, chains);
    return {backend_, static_cast<std::uint32_t>(count), records, samples};
}

template <Backend B, class World>
    requires(World::space == B::space)
std::vector<ChainRun> BackendMetropolis<B, World>::walk(typename B::Queue& queue, Monitor* monitor,
                                                        const std::vector<std::uint32_t>& starts)
const {
    const auto chains = static_cast<std::uint32_t>(starts.size());
    const Walk walk{generator_, suffix_, {}, options_, chains};
    const UploadedArray<B, std::uint32_t> starts_there(backend_, queue, starts);
    Batch batch = make_batch(chains);
    std::vector<ChainRun> runs(chains);
    for (std::uint32_t first = 0; first < chains; first += batch.chains) {
        if (monitor != nullptr) monitor->check();
        const std::uint32_t n = std::min(batch.chains, chains - first);
        walk_batch(queue, walk, starts_there.data(), first, batch,
                   std::span(runs).subspan(first, n));
    }
    return runs;
}

template <Backend B, class World>
    requires(World::space == B::space)
void BackendMetropolis<B, World>::walk_batch(typename B::Queue& queue, const Walk& walk,
                                             const std::uint32_t* starts, std::uint32_t first,
                                             Batch& batch, std::span<ChainRun> runs) const {
    const auto n = static_cast<std::uint32_t>(runs.size());
    // Before the kernel: memory that cannot be had must not leave it running.
    std::vector<ChainReport> reports(n);
    std::vector<VplRecord> records(n * batch.records_per_chain);
    std::vector<TraceSample> samples(n * batch.samples_per_chain);
    // A thread block for each chain, while there are few of them: they share nothing.
    const std::uint32_t spread = n <= 1024 ? 256 : n <= 8192 ? 32 : 1;
    queue.for_each(n * spread, ChainWalks<Walk>{walk, first, spread, starts, batch.memory.data(),
                                                batch.records.data(), batch.records_per_chain,
                                                batch.samples.data(), batch.samples_per_chain,
                                                batch.reports.data()});
    queue.download(batch.reports, std::span(reports));
    queue.download(batch.records, std::span(records));
    queue.download(batch.samples, std::span(samples));
    queue.record().sync();
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto own = std::span(std::as_const(records))
                             .subspan(i * batch.records_per_chain, reports[i].records);
        const auto trace = std::span(std::as_const(samples))
                               .subspan(i * batch.samples_per_chain, reports[i].samples);
        runs[i] = {{own.begin(), own.end()}, MixingTrace(trace), reports[i].tally};
    }
}

}  // namespace mir
