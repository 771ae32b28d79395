// SPDX-License-Identifier: MIT
//
// Rays per second on one thread, the same rays for all: to every disc one by one, through
// hierarchies of each construction, stopping at nodes as large as the ray of one of 128 directions
// times a threshold, and by Embree to the triangles. Ratios are to be taken inside of one run.
#include "micro_scene.hpp"
#include "mir/micro/surfel_traverse.hpp"

#include <benchmark/benchmark.h>

#include <map>

namespace {

using namespace mirbench;

/// Discs of the trees.
constexpr double disc_count = 50000;
constexpr std::uint32_t ray_count = 20000;
/// Every disc is asked by so few.
constexpr std::uint32_t brute_force_rays = 64;

const std::vector<mir::SurfelRay>& rays_of(const std::string& scene) {
    static std::map<std::string, std::vector<mir::SurfelRay>> cache;
    std::vector<mir::SurfelRay>& rays = cache[scene];
    if (rays.empty()) rays = gather_rays(bench_scene(scene), ray_count);
    return rays;
}

void report(benchmark::State& state, const std::string& scene, std::size_t rays, double hits) {
    state.counters["rays/s"] = benchmark::Counter(static_cast<double>(rays),
                                                  benchmark::Counter::kIsIterationInvariantRate);
    state.counters["hit"] = hits / static_cast<double>(rays);
    state.SetLabel(bench_scene(scene).hash);
}

/// `meets(ray)` is asked of `count` rays, again and again.
template <class Meets>
void time_rays(benchmark::State& state, const std::string& scene, std::uint32_t count,
               const Meets& meets) {
    const auto rays = std::span(rays_of(scene)).first(count);
    std::size_t hits = 0;
    for (auto _ : state) {
        hits = 0;
        for (const mir::SurfelRay& ray : rays) hits += meets(ray) ? 1 : 0;
        benchmark::DoNotOptimize(hits);
    }
    report(state, scene, rays.size(), static_cast<double>(hits));
}

void brute_force(benchmark::State& state, const std::string& scene) {
    const mir::SurfelTree tree = tree_of(bench_scene(scene), disc_count);
    state.counters["discs"] = static_cast<double>(tree.surfels().size());
    time_rays(state, scene, brute_force_rays, [&](const mir::SurfelRay& ray) {
        mir::SurfelHit hit;
        for (std::uint32_t i = 0; i < tree.nodes().size(); ++i)
            if (tree.nodes()[i].is_leaf())
                mir::detail::meet_disc(tree.view(), tree.nodes()[i], i, ray, hit);
        return hit.node != mir::SurfelHit::none;
    });
}

/// `threshold` is that of a gather by 128 rays, whose solid angle is pi / 128 over the cosine.
void hierarchy(benchmark::State& state, const std::string& scene,
               const mir::SurfelTreeOptions& options, float threshold) {
    const mir::SurfelTree tree = tree_of(bench_scene(scene), disc_count, options);
    state.counters["discs"] = static_cast<double>(tree.surfels().size());
    const float share = threshold * mir::pi / 128.0f;
    time_rays(state, scene, ray_count, [&](mir::SurfelRay ray) {
        ray.solid_angle = share / glm::dot(ray.direction, ray.normal);
        return closest_surfel(tree.view(), ray).node != mir::SurfelHit::none;
    });
}

void embree(benchmark::State& state, const std::string& scene) {
    const auto caster = bench_scene(scene).engine.ray_caster();
    time_rays(state, scene, ray_count, [&](const mir::SurfelRay& ray) {
        return caster.closest_hit({ray.origin, ray.direction}).has_value();
    });
}

template <class Run>
void add_rays(const std::string& what, const std::string& scene, const Run& run) {
    benchmark::RegisterBenchmark(("micro_rays/" + what + '/' + scene).c_str(),
                                 [scene, run](benchmark::State& s) { run(s, scene); })
        ->Unit(benchmark::kMillisecond);
}

void add_hierarchy(const std::string& what, const std::string& scene,
                   const mir::SurfelTreeOptions& options, float threshold) {
    add_rays(what, scene, [options, threshold](benchmark::State& state, const std::string& name) {
        hierarchy(state, name, options, threshold);
    });
}

const int rays_registered = [] {
    using mir::SphereFit;
    using mir::SurfelSplit;
    for (const std::string& scene : scenes_of_run()) {
        add_rays("brute_force", scene, brute_force);
        for (const auto& [split, cut] :
             {std::pair{SurfelSplit::median, "median"}, {SurfelSplit::orientation, "orientation"}})
            for (const auto& [sphere, fit] : {std::pair{SphereFit::mean, "mean"},
                                              {SphereFit::ritter, "ritter"},
                                              {SphereFit::smallest, "smallest"}})
                for (const float threshold : {0.0f, 1.0f})
                    add_hierarchy((threshold == 0.0f ? "exact/" : "threshold_1/") +
                                      std::string(cut) + '_' + fit,
                                  scene, {.sphere = sphere, .split = split}, threshold);
        add_hierarchy("threshold_0.25/default", scene, {}, 0.25f);
        add_hierarchy("threshold_4/default", scene, {}, 4.0f);
        add_rays("embree", scene, embree);
    }
    return 0;
}();

}  // namespace
