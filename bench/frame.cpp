// SPDX-License-Identifier: MIT
//
// A whole frame by stage, from triangles in memory to filtered pictures in memory: what the program
// does but for reading and writing files. Runs on the processor by each of its structures, and on a
// GPU where there is one; the ratio of any two counters of one run survives a noisy machine.
#include "mir/runtime/all_renderers.hpp"
#include "support/bench_scene.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace {

/// A machine, and the structure to trace by.
struct Way {
    const char* name;
    mir::BackendKind backend;
    mir::Acceleration acceleration;
};

constexpr Way ways[] = {
    {"cuda/bvh", mir::BackendKind::cuda, mir::Acceleration::bvh},
    {"cuda/auto", mir::BackendKind::cuda, mir::Acceleration::automatic},
    {"cuda/kdtree", mir::BackendKind::cuda, mir::Acceleration::kd_tree},
    {"cpu/bvh", mir::BackendKind::cpu, mir::Acceleration::bvh},
    {"cpu/embree", mir::BackendKind::cpu, mir::Acceleration::automatic},
};

/// Frames of 1600 x 1200 by one renderer, as a program that draws many: the first, which loads
/// kernels and takes memory, is not counted. Counters are milliseconds of each stage in the frame
/// whose total is the median, and of the fastest and slowest frame.
void frame(benchmark::State& state, const std::string& scene_name, const Way& way) {
    mir::Registry registry;
    mir::add_all_to(registry);
    mir::RenderSettings settings;
    settings.image = mirbench::paper_image;
    settings.vpls = static_cast<std::uint32_t>(state.range(0));
    settings.acceleration = way.acceleration;
    std::unique_ptr<mir::Renderer> renderer;
    try {
        renderer = registry.make(way.backend, "");
    } catch (const mir::Error& e) {
        state.SkipWithError(e.what());
        return;
    }
    const mir::Scene& scene = mirbench::bench_scene(scene_name).scene;
    static_cast<void>(renderer->render(scene, settings, nullptr));
    std::vector<mir::StageSeconds> frames;
    for (auto _ : state) {
        const mir::RenderResult result = renderer->render(scene, settings, nullptr);
        frames.push_back(result.statistics.seconds);
        state.SetIterationTime(result.statistics.seconds.total);
    }
    std::sort(frames.begin(), frames.end(),
              [](const auto& a, const auto& b) { return a.total < b.total; });
    const mir::StageSeconds& median = frames[frames.size() / 2];
    for (const mir::RenderStage& stage : mir::render_stages)
        state.counters["ms_" + std::string(stage.name)] = 1e3 * median.*stage.seconds;
    state.counters["ms"] = 1e3 * median.total;
    state.counters["ms_least"] = 1e3 * frames.front().total;
    state.counters["ms_most"] = 1e3 * frames.back().total;
}

const int registered = [] {
    for (const std::string& scene : mirbench::scenes_of_run())
        for (const Way& way : ways) {
            const std::string name = "frame/" + scene + "/" + way.name;
            benchmark::RegisterBenchmark(
                name.c_str(), [scene, way](benchmark::State& s) { frame(s, scene, way); })
                ->ArgName("vpls")
                ->Arg(256)
                ->UseManualTime()
                ->Iterations(way.backend == mir::BackendKind::cuda ? 20 : 3)
                ->Unit(benchmark::kMillisecond);
        }
    return 0;
}();

}  // namespace
