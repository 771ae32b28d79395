// SPDX-License-Identifier: MIT
//
// A whole frame by stage, from triangles in memory to filtered pictures in memory: what the program
// does but for reading and writing files. Runs on the processor by each of its structures, and on a
// GPU where there is one; the ratio of any two counters of one run survives a noisy machine.
#include "support/bench_scene.hpp"
#include "support/frame_runs.hpp"

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
    {"cpu/embree", mir::BackendKind::cpu, mir::Acceleration::embree},
};

/// Frames of 1600 x 1200 by one renderer; the first, which loads kernels and takes memory, is not
/// counted.
void frame(benchmark::State& state, const std::string& scene_name, const Way& way) {
    mir::RenderSettings settings;
    settings.image = mirbench::paper_image;
    settings.luxels_per_pixel = 1;
    settings.vpls = static_cast<std::uint32_t>(state.range(0));
    settings.acceleration = way.acceleration;
    const auto renderer = mirbench::renderer_of(way.backend, state);
    if (!renderer) return;
    const mir::Scene& scene = mirbench::bench_scene(scene_name).scene;
    static_cast<void>(renderer->render(scene, settings, nullptr));
    mirbench::time_frames(state, *renderer, scene, settings);
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
