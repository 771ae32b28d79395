// SPDX-License-Identifier: MIT
//
// How the cost of a picture grows with VPLs, luxels, triangles and threads, one of them at a time,
// on the processor and on a GPU where there is one: milliseconds by stage, and nanoseconds for a
// contribution. tools/plot_growth.py draws it.
#include "mir/scene/builtin.hpp"
#include "support/bench_scene.hpp"
#include "support/frame_runs.hpp"

#include <cmath>
#include <functional>
#include <thread>

namespace {

/// A machine, and the picture that a sweep varies.
struct Machine {
    const char* name;
    mir::BackendKind backend;
    mir::Extent image;
    int frames;
};

constexpr Machine machines[] = {{"cuda", mir::BackendKind::cuda, {1600, 1200}, 5},
                                {"cpu", mir::BackendKind::cpu, {800, 600}, 1}};
constexpr std::uint32_t usual_vpls = 256;
constexpr std::uint32_t sphere_triangles[] = {2'000, 20'000, 200'000, 2'000'000, 10'000'000};
constexpr mir::Extent images[] = {
    {816, 612}, {1152, 864}, {1632, 1224}, {2304, 1728}, {3264, 2448}};

/// The scene `sphere` with a sphere of about as many triangles.
mir::Scene room_with_sphere(std::uint32_t triangles) {
    mir::Scene scene = mir::builtin::make("sphere");
    const auto side = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles)));
    for (mir::Mesh& mesh : scene.meshes)
        if (mesh.name == "sphere")
            mesh = mir::builtin::sphere("sphere", mesh.material, {0, 1.4f, 0}, 1.0f, side,
                                        side / 2 + 1);
    return scene;
}

void grow(benchmark::State& state, const Machine& machine, const mir::Scene& scene,
          const mir::RenderSettings& settings) {
    const auto renderer = mirbench::renderer_of(machine.backend, state);
    if (!renderer) return;
    if (machine.backend == mir::BackendKind::cuda)  // loads kernels and takes memory
        static_cast<void>(renderer->render(scene, settings, nullptr));
    const mir::RenderStatistics median = mirbench::time_frames(state, *renderer, scene, settings);
    const mir::StageSeconds& s = median.seconds;
    state.counters["triangles"] = static_cast<double>(median.triangles);
    state.counters["ns_per_contribution"] = 1e9 * (s.visibility + s.response + s.reconstruction) /
                                            static_cast<double>(median.contributions);
    state.SetLabel(median.acceleration);
}

mir::RenderSettings usual_settings(const Machine& machine) {
    mir::RenderSettings settings;
    settings.image = machine.image;
    settings.vpls = usual_vpls;
    return settings;
}

using Picture = std::function<void(benchmark::State&)>;

void add(const Machine& machine, const std::string& sweep, const Picture& picture) {
    benchmark::RegisterBenchmark((std::string("growth/") + machine.name + "/" + sweep).c_str(),
                                 picture)
        ->UseManualTime()
        ->Iterations(machine.frames)
        ->Unit(benchmark::kMillisecond);
}

/// One picture of a scene of the run, `settings` being changed beforehand.
template <class Change>
Picture changed(const Machine& machine, const std::string& scene, Change change) {
    return [machine, scene, change](benchmark::State& state) {
        mir::RenderSettings settings = usual_settings(machine);
        change(settings);
        grow(state, machine, mirbench::bench_scene(scene).scene, settings);
    };
}

void add_sweeps(const Machine& machine, const std::string& scene) {
    for (std::uint32_t vpls = 64; vpls <= 16'384; vpls *= 4)
        add(machine, scene + "/vpls:" + std::to_string(vpls),
            changed(machine, scene, [vpls](mir::RenderSettings& s) { s.vpls = vpls; }));
    for (const mir::Extent image : images)
        add(machine, scene + "/luxels:" + std::to_string(image.area()),
            changed(machine, scene, [image](mir::RenderSettings& s) { s.image = image; }));
    if (machine.backend == mir::BackendKind::cuda) return;
    for (unsigned threads = 1; threads <= std::thread::hardware_concurrency(); threads *= 2)
        add(machine, scene + "/threads:" + std::to_string(threads),
            changed(machine, scene, [threads](mir::RenderSettings& s) { s.threads = threads; }));
}

const int registered = [] {
    for (const Machine& machine : machines) {
        for (const std::string& scene : mirbench::scenes_of_run()) add_sweeps(machine, scene);
        for (const std::uint32_t triangles : sphere_triangles)
            add(machine, "builtin:sphere/triangles:" + std::to_string(triangles),
                [machine, triangles](benchmark::State& state) {
                    grow(state, machine, room_with_sphere(triangles), usual_settings(machine));
                });
    }
    return 0;
}();

}  // namespace
