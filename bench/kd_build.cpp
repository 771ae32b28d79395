// SPDX-License-Identifier: MIT
//
// How long the kd-tree takes to build, what comes out, and what either costs in memory. The tree is
// the same for any number of threads.
#include "mir/accel/kd/kd_build.hpp"

#include "support/bench_scene.hpp"

#include <benchmark/benchmark.h>
#include <sys/resource.h>

namespace {

using namespace mirbench;

/// Largest memory that the process has held so far, bytes: an upper bound for what a build needs.
double peak_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

void report(benchmark::State& state, const mir::KdTreeStatistics& s) {
    state.counters["nodes"] = static_cast<double>(s.nodes);
    state.counters["leaves"] = static_cast<double>(s.leaves);
    state.counters["empty_leaves"] = static_cast<double>(s.empty_leaves);
    state.counters["references_per_triangle"] = s.references_per_triangle();
    state.counters["triangles_per_leaf"] = s.triangles_per_leaf();
    state.counters["depth"] = s.depth;
    state.counters["largest_leaf"] = s.largest_leaf;
    state.counters["sah_cost"] = s.sah_cost;
    state.counters["bytes_per_triangle"] = s.bytes_per_triangle();
    state.counters["prepare_s"] = s.prepare_seconds;
    state.counters["top_s"] = s.top_seconds;
    state.counters["subtrees_s"] = s.subtrees_seconds;
    state.counters["assemble_s"] = s.assemble_seconds;
    state.counters["peak_bytes"] = peak_bytes();
}

void kd_build(benchmark::State& state, const std::string& name, const mir::KdTreeOptions& options) {
    const mir::WorldGeometry& geometry = bench_scene(name).geometry;
    mir::TbbExecutor executor(static_cast<unsigned>(state.range(0)));
    mir::KdTreeStatistics fastest;
    double triangles = 0.0;
    for (auto _ : state) {
        const mir::KdTree tree(geometry, options, executor);
        const mir::KdTreeStatistics& s = tree.statistics();
        state.SetIterationTime(s.seconds());
        if (triangles == 0.0 || s.seconds() < fastest.seconds()) fastest = s;
        triangles += static_cast<double>(s.triangles);
    }
    report(state, fastest);
    state.counters["fastest_triangles/s"] =
        static_cast<double>(fastest.triangles) / fastest.seconds();
    state.counters["triangles/s"] = benchmark::Counter(triangles, benchmark::Counter::kIsRate);
    state.SetLabel(bench_scene(name).hash);
}

void register_builds(const std::string& title, const mir::KdTreeOptions& options) {
    for (const std::string& scene : scenes_of_run()) {
        std::string name = title;
        name.append("/").append(scene);
        for (int threads : {1, 2, 0})
            benchmark::RegisterBenchmark(
                name.c_str(),
                [scene, options](benchmark::State& s) { kd_build(s, scene, options); })
                ->ArgName("threads")
                ->Arg(threads)
                ->UseManualTime()
                ->Iterations(5)
                ->Unit(benchmark::kMillisecond);
    }
}

const int registered = [] {
    register_builds("kd_build", {});
    register_builds("kd_build_for_gpu", mir::KdTreeOptions::for_gpu());
    return 0;
}();

}  // namespace
