// SPDX-License-Identifier: MIT
//
// How the cost of a picture grows with VPLs, luxels, triangles and threads, one of them at a time,
// on the processor and on a GPU where there is one: milliseconds by stage, and nanoseconds for a
// contribution. What `--accel auto` chooses has beside it what asks ray by ray: Embree's packets,
// and the plain kernel over a kd-tree. tools/plot_growth.py draws it.
#include "mir/scenes.hpp"
#include "support/bench_scene.hpp"
#include "support/frame_runs.hpp"

#include <cmath>
#include <functional>
#include <thread>

namespace {

/// A machine and what asks for visibility there, and the picture that a sweep varies.
struct Machine {
    const char* name;
    mir::BackendKind backend;
    mir::Acceleration acceleration;
    mir::Extent image;
    int frames;
};

constexpr mir::Extent gpu_image{1600, 1200};
constexpr mir::Extent cpu_image{800, 600};
constexpr Machine machines[] = {
    {"cuda", mir::BackendKind::cuda, mir::Acceleration::automatic, gpu_image, 5},
    {"kdtree", mir::BackendKind::cuda, mir::Acceleration::kd_tree, gpu_image, 1},
    {"cpu", mir::BackendKind::cpu, mir::Acceleration::automatic, cpu_image, 1},
    {"embree", mir::BackendKind::cpu, mir::Acceleration::embree, cpu_image, 1}};
constexpr std::uint32_t usual_vpls = 256;
constexpr std::uint32_t many_vpls = 4'096;
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
    settings.luxels_per_pixel = 1;
    settings.vpls = usual_vpls;
    settings.acceleration = machine.acceleration;
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

/// Few VPLs and many: how many pairs there are for each triangle decides what `--accel auto` takes.
void add_spheres(const Machine& machine) {
    for (const std::uint32_t vpls : {usual_vpls, many_vpls})
        for (const std::uint32_t triangles : sphere_triangles)
            add(machine,
                (vpls == usual_vpls ? "builtin:sphere"
                                    : "sphere, " + std::to_string(vpls) + " VPLs") +
                    "/triangles:" + std::to_string(triangles),
                [machine, vpls, triangles](benchmark::State& state) {
                    mir::RenderSettings settings = usual_settings(machine);
                    settings.vpls = vpls;
                    grow(state, machine, room_with_sphere(triangles), settings);
                });
}

const int registered = [] {
    for (const Machine& machine : machines) {
        for (const std::string& scene : mirbench::scenes_of_run()) add_sweeps(machine, scene);
        add_spheres(machine);
    }
    return 0;
}();

}  // namespace
