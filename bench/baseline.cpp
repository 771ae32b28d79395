// SPDX-License-Identifier: MIT
//
// The tuned CPU path, shading included, against single rays without shading over the same facing
// pairs, one after the other in every iteration: the ratio of two times taken side by side survives
// a noisy machine. Counter time_over_occluded1 is what docs/performance.md reports.
#include "mir/core/stopwatch.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/contribution.hpp"
#include "support/bench_runs.hpp"

#include <benchmark/benchmark.h>

#include <atomic>

namespace {

using namespace mirbench;

/// Seconds that single shadow rays take over all facing pairs.
double time_single_rays(const BenchScene& s, const GBuffer& gbuffer, const mir::VplList& vpls,
                        mir::TbbExecutor& executor) {
    double seconds = 0.0;
    const auto visibility = s.engine.visibility();
    std::atomic<std::uint64_t> seen{0};
    {
        const mir::Stopwatch watch(seconds);
        executor.for_each(gbuffer.tiles().size(), [&](std::size_t t) {
            const auto view = gbuffer.view(static_cast<mir::TileIndex>(t));
            std::uint64_t here = 0;
            for (mir::LuxelIndex i = 0; i < view.size(); ++i) {
                const mir::Hit hit = view.hit(i);
                for (const mir::Vpl& vpl : vpls.vpls())
                    if (mir::faces(hit, vpl) && visibility.visible(vpl.position, hit.position))
                        ++here;
            }
            seen += here;
        });
    }
    benchmark::DoNotOptimize(seen.load());
    return seconds;
}

double time_tuned(const BenchScene& s, const GBuffer& gbuffer, const mir::VplList& vpls,
                  mir::TbbExecutor& executor) {
    double seconds = 0.0;
    mir::Image<mir::Rgb> image;
    {
        const mir::Stopwatch watch(seconds);
        image = mir::reconstruct(mir::sched::CpuBlocks{executor}, gbuffer, vpls.span(),
                                 s.engine.visibility(), s.shading(vpls.size()));
    }
    benchmark::DoNotOptimize(image.pixels().data());
    return seconds;
}

void tuned_over_occluded1(benchmark::State& state, const std::string& name) {
    const BenchScene& s = bench_scene(name);
    const GBuffer gbuffer = s.gbuffer(paper_image, {64, 64});
    const mir::VplList vpls = s.vpls(256);
    mir::TbbExecutor executor(static_cast<unsigned>(state.range(0)));
    double tuned = 0.0;
    double single = 0.0;
    for (auto _ : state) {
        const double t = time_tuned(s, gbuffer, vpls, executor);
        single += time_single_rays(s, gbuffer, vpls, executor);
        tuned += t;
        state.SetIterationTime(t);
    }
    const auto pairs = static_cast<double>(paper_image.area()) * vpls.size();
    const auto facing = static_cast<double>(count_facing(gbuffer, vpls, executor));
    const auto n = static_cast<double>(state.iterations());
    state.counters["time_over_occluded1"] = tuned / single;
    state.counters["contributions/s"] = pairs * n / tuned;
    state.counters["occluded1_rays/s"] = facing * n / single;
    state.counters["facing_share"] = facing / pairs;
    state.SetLabel(s.hash);
}

const int registered = [] {
    register_by_threads("tuned_over_occluded1", tuned_over_occluded1);
    return 0;
}();

}  // namespace
