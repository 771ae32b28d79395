// SPDX-License-Identifier: MIT
//
// Gathers per second: 128 rays, micro-buffers of 8 x 8 to 24 x 24 texels, on one thread of the
// host, and pictures of 512 x 512 luxels with some million discs on a GPU, by its clock.
#include "micro_scene.hpp"

#include <benchmark/benchmark.h>

#include <memory>

namespace {

using namespace mirbench;
using mir::Lambert;
using mir::Space;

constexpr double some_discs = 50000;
constexpr mir::Extent small_picture{64, 64};
/// Cutting in four ends at 1 to 4 times a count that is asked for: a million in the Cornell box.
constexpr double many_discs = 600000;
constexpr mir::Extent picture{512, 512};

void report(benchmark::State& state, const std::string& scene, const MicroScene& s) {
    const auto gathers = static_cast<double>(s.luxels.extent().area());
    state.counters["gathers/s"] =
        benchmark::Counter(gathers, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["images/s"] =
        benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["discs"] = static_cast<double>(s.tree.surfels().size());
    state.SetLabel(bench_scene(scene).hash);
}

/// Gathers with `make(view of the tree, radiance)` at every luxel of a small picture.
template <class Make>
void on_host(benchmark::State& state, const std::string& scene, const Make& make) {
    const MicroScene& s = micro_scene(scene, small_picture, some_discs);
    const auto gather = make(s.tree.view(), s.radiance.data());
    const auto view = s.luxels.view(0);
    mir::Rgb sum;
    for (auto _ : state)
        for (mir::LuxelIndex i = 0; i < view.size(); ++i)
            sum += gather(view.hit(i), view.surface(i), {1, mir::Stream::gather, i});
    benchmark::DoNotOptimize(sum);
    report(state, scene, s);
}

const auto by_rays = [](const auto& tree, const mir::SurfelRadiance* radiance) {
    return mir::RayGather<Space::host, Lambert>{tree, radiance, {}};
};

auto by_buffer(std::uint32_t side) {
    return [side](const auto& tree, const mir::SurfelRadiance* radiance) {
        return mir::BufferGather<Space::host, Lambert>{tree, radiance, {.side = side}};
    };
}

GpuGathers& gpu_of(const std::string& scene) {
    static std::string made_for;
    static std::unique_ptr<GpuGathers> gpu;
    if (made_for != scene) {
        gpu.reset();
        made_for.clear();
        gpu = make_gpu_gathers(micro_scene(scene, picture, many_discs).input());
        made_for = scene;
    }
    return *gpu;
}

/// Some luxels of a GPU's picture against `make(view of the tree, radiance)` on the host.
template <class Make>
std::uint32_t different_luxels(const MicroScene& s, const mir::Image<mir::Rgb>& image,
                               const Make& make) {
    const auto gather = make(s.tree.view(), s.radiance.data());
    const auto view = s.luxels.view(0);
    const auto layout = mir::BlockedLayout::of(s.luxels.tiles()[0]);
    std::uint32_t different = 0;
    for (std::uint32_t y = 5; y < picture.height; y += 64)
        for (std::uint32_t x = 3; x < picture.width; x += 64) {
            const mir::LuxelIndex i = layout(x, y);
            const mir::Rgb here = gather(view.hit(i), view.surface(i),
                                         s.band.luxel_numbers(x, y, mir::Stream::gather));
            different += here == image(x, y) ? 0 : 1;
        }
    return different;
}

template <class Gather, class Make>
void on_gpu(benchmark::State& state, const std::string& scene, const Gather& gather,
            const Make& make) {
    const MicroScene& s = micro_scene(scene, picture, many_discs);
    try {
        GpuGathers& gpu = gpu_of(scene);
        gather(gpu);
        for (auto _ : state) state.SetIterationTime(gather(gpu));
        state.counters["different"] = different_luxels(s, gpu.image(), make);
        report(state, scene, s);
    } catch (const mir::Error& e) {
        state.SkipWithError(e.what());
    }
}

template <class Run>
auto* add(const std::string& what, const std::string& scene, const Run& run) {
    return benchmark::RegisterBenchmark(("micro_gathers/" + what + '/' + scene).c_str(),
                                        [scene, run](benchmark::State& s) { run(s, scene); })
        ->Unit(benchmark::kMillisecond);
}

void add_gpu(const std::string& scene) {
    add("gpu_rays_128", scene, [](benchmark::State& state, const std::string& name) {
        on_gpu(
            state, name, [](GpuGathers& gpu) { return gpu.by_rays({}); }, by_rays);
    })->UseManualTime();
    for (const std::uint32_t side : {8u, 16u, 24u})
        add("gpu_buffer_" + std::to_string(side), scene,
            [side](benchmark::State& state, const std::string& name) {
                const auto gather = [side](GpuGathers& gpu) {
                    return gpu.by_buffers({.side = side});
                };
                on_gpu(state, name, gather, by_buffer(side));
            })
            ->UseManualTime();
}

const int registered = [] {
    for (const std::string& scene : scenes_of_run()) {
        add("rays_128", scene, [](benchmark::State& state, const std::string& name) {
            on_host(state, name, by_rays);
        });
        for (const std::uint32_t side : {8u, 24u})
            add("buffer_" + std::to_string(side), scene,
                [side](benchmark::State& state, const std::string& name) {
                    on_host(state, name, by_buffer(side));
                });
        if (has_cuda()) add_gpu(scene);
    }
    return 0;
}();

}  // namespace
