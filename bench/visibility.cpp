// SPDX-License-Identifier: MIT
//
// What shafts are worth: seconds for the visibility of all pairs by shafts over those of the same
// segments one by one through the same hierarchy, and what becomes of pairs.
#include "mir/core/stopwatch.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/host/wide_bvh_scene.hpp"
#include "support/bench_runs.hpp"
#include "support/clustered_hits.hpp"
#include "support/shafts/pair_tally.hpp"
#include "support/shafts/shaft_pass.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mirbench;

constexpr mir::Extent image{800, 600};
constexpr std::uint32_t vpl_count = 16;

using VplSpan = mir::VplSpan<mir::Space::host>;

/// Luxels of an image in cluster order, padded to whole blocks.
struct Clusters {
    std::uint32_t luxels = 0;
    std::vector<std::uint32_t> planes;
    std::vector<mir::ClusterRecord> blocks;
    std::vector<mir::ClusterRecord> clusters;

    Clusters(const GBuffer& gbuffer, float sigma, mir::TbbExecutor& executor)
        : luxels((gbuffer.view(0).size() + mir::block_luxels - 1) / mir::block_luxels *
                 mir::block_luxels),
          planes(clustered_hits(gbuffer.view(0).hits, luxels, executor)) {
        record(blocks, mir::block_luxels, sigma, executor);
        record(clusters, mir::cluster_luxels, sigma, executor);
    }

    [[nodiscard]] mir::SoaView<const mir::Hit> hits() const { return {planes.data(), luxels}; }

 private:
    void record(std::vector<mir::ClusterRecord>& records, std::uint32_t run, float sigma,
                mir::TbbExecutor& executor) const {
        records.resize(luxels / run);
        const mir::ClusterRecords kernel{hits(), run, sigma, records.data()};
        executor.for_each(records.size(),
                          [&](std::size_t i) { kernel(static_cast<std::uint32_t>(i)); });
    }
};

/// A scene, its clusters and VPLs.
class Bench {
 public:
    Bench(const BenchScene& s, mir::TbbExecutor& executor)
        : executor_(executor),
          wide_(s.geometry, executor),
          vpls_(s.vpls(vpl_count)),
          sigma_(static_cast<float>(mir::sigma_of(mir::magnitude_of(s.geometry.bounds())))),
          clusters_(s.gbuffer(image, image), sigma_, executor),
          words_(mir::VisibilityWords<mir::Space::host>::count(clusters_.luxels, vpls_.size())) {}

    /// `watch` is told what becomes of pairs.
    template <class Watch>
    void by_shafts(Watch watch) {
        const mir::ShaftPass<mir::Space::host, VplSpan, Watch> pass{clusters_.hits(),
                                                                    clusters_.blocks.data(),
                                                                    clusters_.clusters.data(),
                                                                    vpls_.span(),
                                                                    wide_.tree().view(),
                                                                    sigma_,
                                                                    {},
                                                                    words_.data(),
                                                                    watch};
        executor_.for_each(clusters_.luxels / mir::block_luxels, [&](std::size_t b) {
            const auto first = static_cast<std::uint32_t>(b) * vpls_.size();
            for (std::uint32_t j = 0; j < vpls_.size(); ++j) pass(first + j);
        });
    }

    /// Every segment that faces, by itself.
    void by_segments() {
        const auto hits = clusters_.hits();
        executor_.for_each(clusters_.luxels / mir::cluster_luxels, [&](std::size_t c) {
            for (std::uint32_t j = 0; j < vpls_.size(); ++j)
                words_[c * vpls_.size() + j] =
                    word_of(hits, static_cast<std::uint32_t>(c), vpls_.span()[j]);
        });
    }

    [[nodiscard]] const std::vector<std::uint32_t>& words() const { return words_; }
    [[nodiscard]] double pairs() const { return static_cast<double>(image.area()) * vpls_.size(); }

 private:
    [[nodiscard]] std::uint32_t word_of(const mir::SoaView<const mir::Hit>& hits, std::uint32_t c,
                                        const mir::Vpl& vpl) const {
        std::uint32_t word = 0;
        for (std::uint32_t k = 0; k < mir::cluster_luxels; ++k) {
            const mir::Hit hit = hits.load(c * mir::cluster_luxels + k);
            if (mir::faces(hit, vpl) && !is_hidden(wide_.tree().view(), vpl.position, hit.position))
                word |= 1u << k;
        }
        return word;
    }

    mir::TbbExecutor& executor_;
    mir::WideBvhScene wide_;
    mir::VplList vpls_;
    float sigma_ = 0.0f;
    Clusters clusters_;
    std::vector<std::uint32_t> words_;
};

void report_shares(benchmark::State& state, const std::string& of,
                   const mir::PairTally::Counts& counts) {
    double all = 0.0;
    for (const auto& c : counts) all += static_cast<double>(c);
    const char* const names[] = {"_clear", "_covered", "_listed", "_unknown"};
    for (std::size_t s = 0; s < 4; ++s)
        state.counters[of + names[s]] = static_cast<double>(counts[s]) / all;
}

void visibility(benchmark::State& state, const std::string& name) {
    mir::TbbExecutor executor(static_cast<int>(state.range(0)));
    Bench bench(bench_scene(name), executor);
    double shafts = 0.0;
    double segments = 0.0;
    std::vector<std::uint32_t> truth;
    for (auto _ : state) {
        {
            const mir::Stopwatch watch(segments);
            bench.by_segments();
        }
        truth = bench.words();
        const double before = shafts;
        {
            const mir::Stopwatch watch(shafts);
            bench.by_shafts(mir::UnwatchedPairs{});
        }
        state.SetIterationTime(shafts - before);
    }
    if (bench.words() != truth) state.SkipWithError("shafts changed a bit");
    mir::PairTally counts;
    bench.by_shafts(mir::TallyPairs{&counts});
    report_shares(state, "block", counts.blocks);
    report_shares(state, "cluster", counts.clusters);
    state.counters["shafts_over_segments"] = shafts / segments;
    state.counters["pairs/s"] = bench.pairs() * static_cast<double>(state.iterations()) / shafts;
    state.SetLabel(bench_scene(name).hash);
}

const int registered = [] {
    register_by_threads("visibility", visibility);
    return 0;
}();

}  // namespace
