// SPDX-License-Identifier: MIT
//
// What the block face of visibility is worth: seconds for the visibility of all pairs, block by
// block as sched::CpuBlocks asks, by Embree's packets of sixteen rays from the VPL, by our packets
// and by single segments, over those of blocks by shafts. Blocks are squares of the image; or the
// clusters that renders make, page by page, which is in the time and shared by all VPLs; or
// clusters of the whole image.
#include "mir/blocks/luxel_block.hpp"
#include "mir/core/stopwatch.hpp"
#include "mir/cpu/embree_visibility.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/host/shaft_scene.hpp"
#include "support/bench_scene.hpp"
#include "support/clustered_hits.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <bit>

namespace {

using namespace mirbench;
using mir::BlockMask;
using mir::InstructionSet;

constexpr mir::Extent image = paper_image;

enum class Blocks { squares, pages, clusters };

/// Words of all pairs, 16 per block and VPL, and who asks for them.
class Bench {
 public:
    Bench(const BenchScene& s, Blocks blocks, InstructionSet set, std::uint32_t vpl_count,
          mir::TbbExecutor& executor)
        : blocks_are_(blocks),
          executor_(executor),
          set_(set),
          embree_(s.engine.visibility()),
          scene_(s.geometry, executor, wide_options_of_run()),
          gbuffer_(s.gbuffer(image, image)),
          vpls_(s.vpls(vpl_count)),
          matrix_(gbuffer_.tiles(), vpls_.size()) {
        if (blocks == Blocks::clusters)
            clustered_ = clustered_hits(gbuffer_.view(0).hits, gbuffer_.view(0).size(), executor);
        mir::blocks::append_blocks(blocks_, 0, gbuffer_.tiles()[0]);
        words_.resize(blocks_.size() * vpls_.size());
    }

    void by_embree() {
        by_packets([this](const mir::Vpl& vpl, const mir::PointPacket& points, std::uint32_t on) {
            return embree_.visible_packet(vpl.position, points, on);
        });
    }
    void by_own_packets() {
        const auto visibility = scene_.visibility();
        by_packets([=](const mir::Vpl& vpl, const mir::PointPacket& points, std::uint32_t on) {
            return visibility.visible_packet(vpl.position, points, on);
        });
    }
    void by_segments() {
        const auto visibility = scene_.visibility();
        by_packets([=](const mir::Vpl& vpl, const mir::PointPacket& points, std::uint32_t on) {
            std::uint32_t seen = 0;
            for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k)
                if ((on >> k & 1u) != 0 &&
                    visibility.visible(vpl.position, {points.x[k], points.y[k], points.z[k]}))
                    seen |= 1u << k;
            return seen;
        });
    }
    /// Before by_blocks(), which fills an empty matrix.
    void forget() { matrix_ = mir::VisibilityMatrix(gbuffer_.tiles(), vpls_.size()); }
    void by_blocks() {
        const auto visibility = scene_.visibility();
        if (blocks_are_ == Blocks::pages) {
            mir::fill_visibility(matrix_, gbuffer_, vpls_.span(), visibility, executor_, set_);
            return;
        }
        for_blocks([&](const BoundedHitBlock& block, BlockMask* masks) {
            const auto known = visibility.block(block.hits, set_);
            for (std::uint32_t j = 0; j < vpls_.size(); ++j) {
                masks[j] = facing(block, vpls_.span()[j]);
                if (masks[j].any())
                    visibility.visible_block(known, vpls_.span()[j].position, masks[j]);
            }
        });
    }

    /// Share of the bits that are set in one of two sets of words alone.
    [[nodiscard]] static double different(const std::vector<BlockMask>& a,
                                          const std::vector<BlockMask>& b) {
        std::size_t bits = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
                bits += static_cast<std::size_t>(std::popcount(a[i].packet[g] ^ b[i].packet[g]));
        return static_cast<double>(bits) / static_cast<double>(a.size() * BlockMask::luxels);
    }

    [[nodiscard]] const std::vector<BlockMask>& words() const { return words_; }
    /// Of by_blocks(), wherever it leaves them.
    [[nodiscard]] std::vector<BlockMask> words_by_blocks() const {
        if (blocks_are_ != Blocks::pages) return words_;
        std::vector<BlockMask> words(words_.size());
        for (std::uint32_t b = 0; b < blocks_.size(); ++b)
            for (std::uint32_t j = 0; j < vpls_.size(); ++j)
                for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
                    words[std::size_t{b} * vpls_.size() + j].packet[g] =
                        matrix_.view().mask(0, b * BlockMask::packets + g, j);
        return words;
    }
    [[nodiscard]] double pairs() const { return static_cast<double>(image.area()) * vpls_.size(); }

 private:
    using BoundedHitBlock = mir::blocks::BoundedHitBlock;

    static BlockMask facing(const BoundedHitBlock& block, const mir::Vpl& vpl) {
        return block.cannot_face(vpl) ? BlockMask{} : mir::blocks::facing_mask(block, vpl);
    }

    [[nodiscard]] mir::SoaView<const mir::Hit> hits() const {
        const auto squares = gbuffer_.view(0).hits;
        return clustered_.empty() ? squares
                                  : mir::SoaView<const mir::Hit>{clustered_.data(), squares.stride};
    }

    /// Calls `run(block, masks of all VPLs)`, compiled for the instruction set.
    template <class Run>
    void for_blocks(const Run& run) {
        executor_.for_each(blocks_.size(), [&](std::size_t b) {
            mir::run_with(set_, [&] {
                const BoundedHitBlock block(hits(), blocks_[b], [](std::uint32_t) { return true; });
                run(block, words_.data() + b * vpls_.size());
            });
        });
    }

    template <class Packet>
    void by_packets(const Packet& packet) {
        for_blocks([&](const BoundedHitBlock& block, BlockMask* masks) {
            std::array<mir::PointPacket, BlockMask::packets> points;
            for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
                mir::blocks::load_points(
                    mir::blocks::starting_at(block.hits, g * mir::PointPacket::width), points[g]);
            for (std::uint32_t j = 0; j < vpls_.size(); ++j) {
                const mir::Vpl vpl = vpls_.span()[j];
                masks[j] = facing(block, vpl);
                for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
                    if (masks[j].packet[g] != 0)
                        masks[j].packet[g] = packet(vpl, points[g], masks[j].packet[g]);
            }
        });
    }

    Blocks blocks_are_;
    mir::TbbExecutor& executor_;
    InstructionSet set_;
    mir::cpu::EmbreeVisibility embree_;
    mir::ShaftScene scene_;
    GBuffer gbuffer_;
    std::vector<std::uint32_t> clustered_;  ///< planes of hits; none for squares
    mir::VplList vpls_;
    std::vector<mir::blocks::Block> blocks_;
    std::vector<BlockMask> words_;
    mir::VisibilityMatrix matrix_;
};

void visibility(benchmark::State& state, const std::string& name, Blocks order,
                InstructionSet set) {
    mir::TbbExecutor executor(static_cast<int>(state.range(1)));
    Bench bench(bench_scene(name), order, set, static_cast<std::uint32_t>(state.range(0)),
                executor);
    double segments = 0.0;
    double packets = 0.0;
    double embree = 0.0;
    double blocks = 0.0;
    std::vector<BlockMask> truth;
    std::vector<BlockMask> others;
    const auto timed = [](double& total, const auto& run) {
        const mir::Stopwatch watch(total);
        run();
    };
    timed(segments, [&] { bench.by_segments(); });
    truth = bench.words();
    for (auto _ : state) {
        timed(packets, [&] { bench.by_own_packets(); });
        timed(embree, [&] { bench.by_embree(); });
        others = bench.words();
        const double before = blocks;
        bench.forget();
        timed(blocks, [&] { bench.by_blocks(); });
        state.SetIterationTime(blocks - before);
    }
    if (Bench::different(bench.words_by_blocks(), truth) != 0.0)
        state.SkipWithError("blocks changed a bit");
    state.counters["embree_over_blocks"] = embree / blocks;
    state.counters["packets_over_blocks"] = packets / blocks;
    state.counters["segments_over_blocks"] =
        segments * static_cast<double>(state.iterations()) / blocks;
    state.counters["embree_differs"] = Bench::different(others, truth);
    state.counters["pairs/s"] = bench.pairs() * static_cast<double>(state.iterations()) / blocks;
    state.SetLabel(bench_scene(name).hash);
}

const char* name_of(Blocks order) {
    if (order == Blocks::squares) return "squares";
    return order == Blocks::pages ? "pages" : "clusters";
}

void add(const std::string& scene, Blocks order, const std::string& set_name, InstructionSet set) {
    if (set > mir::best_instruction_set()) return;
    std::string name = "block_visibility/";
    name.append(scene).append("/").append(name_of(order)).append("/").append(set_name);
    benchmark::RegisterBenchmark(
        name.c_str(), [=](benchmark::State& state) { visibility(state, scene, order, set); })
        ->ArgNames({"vpls", "threads"})
        ->ArgsProduct({{64, 256}, {1, 0}})
        ->UseManualTime()
        ->Iterations(3)
        ->Unit(benchmark::kMillisecond);
}

const int registered = [] {
    for (const std::string& scene : scenes_of_run())
        for (const Blocks order : {Blocks::squares, Blocks::pages, Blocks::clusters}) {
            add(scene, order, "avx512", InstructionSet::avx512);
            add(scene, order, "avx2", InstructionSet::avx2);
            add(scene, order, "baseline", InstructionSet::baseline);
        }
    return 0;
}();

}  // namespace
