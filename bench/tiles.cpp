// SPDX-License-Identifier: MIT
//
// Contributions per second against the tile size (the paper's figure 11), on all threads.
#include "mir/sched/cpu_blocks.hpp"
#include "support/bench_scene.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mirbench;

void tiles(benchmark::State& state, const std::string& name) {
    const BenchScene& s = bench_scene(name);
    const mir::Extent tile{static_cast<std::uint32_t>(state.range(0)),
                           static_cast<std::uint32_t>(state.range(1))};
    const mir::Extent image{800, 600};
    const GBuffer gbuffer = s.gbuffer(image, tile);
    const mir::VplList vpls = s.vpls(256);
    mir::cpu::TbbExecutor executor;
    for (auto _ : state)
        benchmark::DoNotOptimize(mir::reconstruct(mir::sched::CpuBlocks{executor}, gbuffer,
                                                  vpls.span(), s.engine.visibility(),
                                                  s.shading(vpls.size())));
    const double pairs = static_cast<double>(image.area()) * vpls.size();
    state.counters["contributions/s"] =
        benchmark::Counter(pairs, benchmark::Counter::kIsIterationInvariantRate);
    state.SetLabel(s.hash);
}

const int registered = [] {
    for (const std::string& name : scenes_of_run()) {
        auto* b = benchmark::RegisterBenchmark(("tiles/" + name).c_str(),
                                               [name](benchmark::State& s) { tiles(s, name); });
        b->ArgNames({"width", "height"})->UseRealTime()->Unit(benchmark::kMillisecond);
        // The paper's sizes, then one block, one strip, the whole image.
        b->Args({100, 100})->Args({100, 256})->Args({256, 256})->Args({512, 256})->Args({512, 512});
        b->Args({16, 16})->Args({64, 64})->Args({800, 16})->Args({800, 600});
    }
    return 0;
}();

}  // namespace
