// SPDX-License-Identifier: MIT
//
// What the order of luxels in memory is worth: 4x4 squares inside 16x16 blocks (the library's own),
// runs of 16 along a row, whole rows, and no order at all. A packet is 16 consecutive luxels.
#include "mir/core/random.hpp"
#include "support/bench_runs.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>

namespace {

using namespace mirbench;

constexpr mir::Extent image{800, 600};

enum Order { squares, block_rows, rows, shuffled };

/// Place in the image of the luxel stored at blocked index `i` of the one tile.
std::vector<std::uint32_t> order_of(Order order) {
    const auto layout = mir::BlockedLayout::of({0, 0, image.width, image.height});
    std::vector<std::uint32_t> luxel_at;
    for (std::uint32_t b = 0; b < layout.blocks(); ++b) {
        const std::uint32_t x0 = (b % layout.blocks_x) * 16;
        const std::uint32_t y0 = (b / layout.blocks_x) * 16;
        for (std::uint32_t i = 0; i < 256; ++i)
            if (y0 + i / 16 < image.height && x0 + i % 16 < image.width)
                luxel_at.push_back((y0 + i / 16) * image.width + x0 + i % 16);
    }
    if (order == block_rows) return luxel_at;
    std::iota(luxel_at.begin(), luxel_at.end(), 0u);
    if (order == rows) return luxel_at;
    mir::Random random(1, mir::Stream::test, 0);
    for (std::size_t i = luxel_at.size(); i > 1; --i)
        std::swap(luxel_at[i - 1],
                  luxel_at[static_cast<std::size_t>(random.next() * static_cast<float>(i))]);
    return luxel_at;
}

GBuffer reordered(const GBuffer& from, Order order) {
    if (order == squares) {
        GBuffer same = from;
        return same;
    }
    const auto layout = mir::BlockedLayout::of(from.tiles().front());
    const auto view = from.view(0);
    GBuffer to(image, image);
    const std::vector<std::uint32_t> luxel_at = order_of(order);
    for (std::uint32_t i = 0; i < luxel_at.size(); ++i) {
        const mir::LuxelIndex source = layout(luxel_at[i] % image.width, luxel_at[i] / image.width);
        to.store(0, i, view.hit(source), view.surface(source));
    }
    return to;
}

void luxel_order(benchmark::State& state, const std::string& name, Order order) {
    const BenchScene& s = bench_scene(name);
    time_reconstructions(state, s, reordered(s.gbuffer(image, image), order));
}

const int registered = [] {
    const std::pair<const char*, Order> orders[] = {
        {"squares", squares}, {"block_rows", block_rows}, {"rows", rows}, {"shuffled", shuffled}};
    for (const std::string& scene : scenes_of_run())
        for (const auto& [label, order] : orders)
            benchmark::RegisterBenchmark(
                ("luxel_order/" + std::string(label) + "/" + scene).c_str(),
                [scene, order = order](benchmark::State& s) { luxel_order(s, scene, order); })
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond);
    return 0;
}();

}  // namespace
