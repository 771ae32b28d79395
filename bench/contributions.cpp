// SPDX-License-Identifier: MIT
//
// Contributions per second against the number of VPLs (the paper's figure 10), for the tuned path
// and for the plain loop, on one thread and on all.
#include "mir/sched/cpu.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "support/bench_scene.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mirbench;

// A quarter of the paper's image: rates do not depend on it, waiting does.
constexpr mir::Extent image{800, 600};

template <class MakeScheduler>
void contributions(benchmark::State& state, const std::string& name, MakeScheduler make) {
    const BenchScene& s = bench_scene(name);
    const GBuffer gbuffer = s.gbuffer(image, {64, 64});
    const mir::VplList vpls = s.vpls(static_cast<std::uint32_t>(state.range(0)));
    mir::TbbExecutor executor(static_cast<unsigned>(state.range(1)));
    for (auto _ : state)
        benchmark::DoNotOptimize(mir::reconstruct(make(executor), gbuffer, vpls.span(),
                                                  s.engine.visibility(), s.shading(vpls.size())));
    const double pairs = static_cast<double>(image.area()) * vpls.size();
    state.counters["contributions/s"] =
        benchmark::Counter(pairs, benchmark::Counter::kIsIterationInvariantRate);
    state.SetLabel(s.hash);
}

template <class MakeScheduler>
void add(const std::string& scheduler, const std::string& scene, std::int64_t most,
         MakeScheduler make) {
    benchmark::RegisterBenchmark(
        (scheduler + "/" + scene).c_str(),
        [scene, make](benchmark::State& s) { contributions(s, scene, make); })
        ->ArgNames({"vpls", "threads"})
        ->ArgsProduct({benchmark::CreateRange(16, most, 4), {1, 0}})
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
}

const int registered = [] {
    using mir::TbbExecutor;
    for (const std::string& scene : scenes_of_run()) {
        add("cpu-blocks", scene, 1024, [](TbbExecutor& e) { return mir::sched::CpuBlocks{e}; });
        add("cpu", scene, 64, [](TbbExecutor& e) { return mir::sched::Cpu{e}; });
    }
    return 0;
}();

}  // namespace
