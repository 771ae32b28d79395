// SPDX-License-Identifier: MIT
//
// How long wide hierarchies of boxes take to build, beside Embree's builder in the same run, and
// what comes out. The tree is the same for any number of threads; segments between points of
// surfaces are walked through it by one.
#include "mir/host/wide_build.hpp"

#include "mir/accel/wide/wide_traverse.hpp"
#include "mir/core/stopwatch.hpp"
#include "mir/core/warp.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "support/bench_scene.hpp"
#include "support/wide_statistics.hpp"

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

namespace {

using namespace mirbench;

/// A point somewhere on a surface, triangles being equally likely, as rays start there.
mir::Vec3 surface_point(const mir::WorldGeometry& geometry, mir::Random& random) {
    const auto count = static_cast<std::uint32_t>(geometry.triangles().size());
    const auto drawn = static_cast<std::uint32_t>(random.next() * static_cast<float>(count));
    const std::uint32_t t = std::min(drawn, count - 1);
    const mir::Vec2 at = mir::square_to_triangle(random.next_2d());
    const mir::Vec3 a = geometry.corner(t, 0);
    const mir::Vec3 p = a + at.x * (geometry.corner(t, 1) - a) + at.y * (geometry.corner(t, 2) - a);
    return mir::lift(p, geometry.front_normal(t), geometry.ray_offset());
}

/// Nanoseconds that is_hidden() takes for a segment between such points, at best.
double segment_ns(const mir::WorldGeometry& geometry, mir::WideBvhView<mir::Space::host> bvh) {
    constexpr std::size_t count = 100000;
    mir::Random random{1, mir::Stream::test, 0};
    std::vector<mir::Vec3> points;
    for (std::size_t i = 0; i <= count; ++i) points.push_back(surface_point(geometry, random));
    double best = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < 3; ++repeat) {
        double seconds = 0.0;
        {
            const mir::Stopwatch watch(seconds);
            std::size_t hidden = 0;
            for (std::size_t i = 0; i < count; ++i)
                hidden += mir::is_hidden(bvh, points[i], points[i + 1]) ? 1 : 0;
            benchmark::DoNotOptimize(hidden);
        }
        best = std::min(best, seconds);
    }
    return 1e9 * best / static_cast<double>(count);
}

void build(benchmark::State& state, const std::string& name) {
    const auto threads = static_cast<int>(state.range(0));
    mir::TbbExecutor executor(threads);
    tbb::task_arena arena(threads);  // in which Embree builds
    const mir::WorldGeometry& geometry = bench_scene(name).geometry;
    const mir::WideBvhOptions options = wide_options_of_run();
    double ours = 0.0;
    double embree = 0.0;
    for (auto _ : state) {
        const double before = ours;
        {
            const mir::Stopwatch watch(ours);
            benchmark::DoNotOptimize(mir::build_wide_bvh(geometry, executor, options).nodes());
        }
        {
            const mir::Stopwatch watch(embree);
            arena.execute([&] { const mir::cpu::EmbreeScene other(geometry); });
        }
        state.SetIterationTime(ours - before);
    }
    const mir::WideBvh bvh = mir::build_wide_bvh(geometry, executor, options);
    const mir::WideBvhStatistics s = mir::wide_statistics(bvh.nodes());
    state.counters["time_over_embree"] = ours / embree;
    state.counters["triangles"] = static_cast<double>(geometry.triangles().size());
    state.counters["references"] = static_cast<double>(s.triangles);
    state.counters["bytes"] = static_cast<double>(bvh.bytes());
    state.counters["nodes"] = static_cast<double>(s.nodes);
    state.counters["depth"] = s.depth;
    state.counters["sah_cost"] = s.sah_cost();
    state.counters["segment_ns"] = segment_ns(geometry, bvh.view());
    state.SetLabel(bench_scene(name).hash);
}

const int registered = [] {
    for (const std::string& scene : scenes_of_run())
        for (int threads : {1, 2})
            benchmark::RegisterBenchmark(("wide_build/" + scene).c_str(),
                                         [scene](benchmark::State& s) { build(s, scene); })
                ->ArgName("threads")
                ->Arg(threads)
                ->UseManualTime()
                ->Iterations(5)
                ->Unit(benchmark::kMillisecond);
    return 0;
}();

}  // namespace
