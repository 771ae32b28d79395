// SPDX-License-Identifier: MIT
//
// Contributions per second against the tile size (the paper's figure 11), on all threads.
#include "support/bench_runs.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mirbench;

void tiles(benchmark::State& state, const std::string& name) {
    const BenchScene& s = bench_scene(name);
    const mir::Extent tile{static_cast<std::uint32_t>(state.range(0)),
                           static_cast<std::uint32_t>(state.range(1))};
    time_reconstructions(state, s, s.gbuffer({800, 600}, tile));
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
