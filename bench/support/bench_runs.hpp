// SPDX-License-Identifier: MIT
#pragma once

#include "mir/sched/cpu_blocks.hpp"
#include "support/bench_scene.hpp"

#include <benchmark/benchmark.h>

namespace mirbench {

/// Times the tuned reconstruction of an image with 256 VPLs on all threads.
inline void time_reconstructions(benchmark::State& state, const BenchScene& s,
                                 const GBuffer& gbuffer) {
    const mir::VplList vpls = s.vpls(256);
    mir::TbbExecutor executor;
    for (auto _ : state)
        benchmark::DoNotOptimize(mir::reconstruct(mir::sched::CpuBlocks{executor}, gbuffer,
                                                  vpls.span(), s.engine.visibility(),
                                                  s.shading(vpls.size())));
    const double pairs = static_cast<double>(gbuffer.extent().area()) * vpls.size();
    state.counters["contributions/s"] =
        benchmark::Counter(pairs, benchmark::Counter::kIsIterationInvariantRate);
    state.SetLabel(s.hash);
}

/// Registers `run(state, scene)`, which takes its own time, for each scene of the run on one thread
/// and on all of them: state.range(0) is 1 or 0.
template <class Run>
void register_by_threads(const std::string& title, const Run& run) {
    for (const std::string& scene : scenes_of_run()) {
        std::string name = title;
        name.append("/").append(scene);
        benchmark::RegisterBenchmark(name.c_str(),
                                     [run, scene](benchmark::State& s) { run(s, scene); })
            ->ArgName("threads")
            ->Arg(1)
            ->Arg(0)
            ->UseManualTime()
            ->Iterations(3)
            ->Unit(benchmark::kMillisecond);
    }
}

}  // namespace mirbench
