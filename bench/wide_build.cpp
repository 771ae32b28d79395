// SPDX-License-Identifier: MIT
//
// How long wide hierarchies of boxes take to build and what comes out: by the host's builder, from
// the root down, and by the one for backends, from the leaves up, here on the host as well. Either
// tree is the same for any number of threads; segments between points of surfaces are walked
// through it by one.
#include "mir/accel/wide_build.hpp"

#include "mir/accel/wide_traverse.hpp"
#include "mir/core/warp.hpp"
#include "mir/cpu/backend.hpp"
#include "mir/resident/backend_wide_bvh.hpp"
#include "support/bench_scene.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mirbench;

/// Half the surface of the box around a child of a node, m^2.
double half_area(const mir::WideNode& node, std::uint32_t slot) {
    const auto extent = [&](int axis) {
        return static_cast<double>(node.high(axis, slot)) -
               static_cast<double>(node.low(axis, slot));
    };
    return extent(0) * extent(1) + extent(1) * extent(2) + extent(2) * extent(0);
}

double root_half_area(const mir::WideNode& root) {
    mir::WideNode all = root;
    for (int axis = 0; axis < 3; ++axis)
        for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot)
            if (root.count[slot] != mir::WideNode::empty)
                all.set_bounds(axis, 0, std::min(all.low(axis, 0), root.low(axis, slot)),
                               std::max(all.high(axis, 0), root.high(axis, slot)));
    return half_area(all, 0);
}

/// WideBvhStatistics::sah_cost() of any tree.
double sah_cost(std::span<const mir::WideNode> nodes) {
    const double root = root_half_area(nodes[0]);
    mir::WideBvhStatistics s;
    s.expected_nodes = 1.0;
    for (const mir::WideNode& node : nodes)
        for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
            const double share = half_area(node, slot) / root;
            if (node.is_inner(slot)) s.expected_nodes += share;
            if (node.is_leaf(slot)) s.expected_tests += node.count[slot] * share;
        }
    return s.sah_cost();
}

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

void report(benchmark::State& state, const std::string& name, std::span<const mir::WideNode> nodes,
            mir::WideBvhView<mir::Space::host> bvh, std::uint32_t depth) {
    state.counters["triangles"] =
        static_cast<double>(bench_scene(name).geometry.triangles().size());
    state.counters["nodes"] = static_cast<double>(nodes.size());
    state.counters["depth"] = depth;
    state.counters["sah_cost"] = sah_cost(nodes);
    state.counters["segment_ns"] = segment_ns(bench_scene(name).geometry, bvh);
    state.SetLabel(bench_scene(name).hash);
}

void from_the_root(benchmark::State& state, const std::string& name) {
    mir::cpu::TbbExecutor executor(static_cast<unsigned>(state.range(0)));
    const mir::WorldGeometry& geometry = bench_scene(name).geometry;
    for (auto _ : state) benchmark::DoNotOptimize(mir::WideBvh(geometry, {}, executor).nodes());
    const mir::WideBvh bvh(geometry, {}, executor);
    report(state, name, bvh.nodes(), bvh.view(), bvh.statistics().depth);
}

void from_the_leaves(benchmark::State& state, const std::string& name) {
    mir::cpu::TbbExecutor executor(static_cast<unsigned>(state.range(0)));
    const mir::cpu::Backend backend(executor);
    using Bvh = mir::BackendWideBvh<mir::cpu::Backend<mir::cpu::TbbExecutor>>;
    const mir::WorldGeometry& geometry = bench_scene(name).geometry;
    auto queue = backend.queue();
    for (auto _ : state)
        benchmark::DoNotOptimize(Bvh(backend, queue, geometry, geometry.view()).view());
    const Bvh bvh(backend, queue, geometry, geometry.view());
    report(state, name, {bvh.view().nodes, bvh.node_count()}, bvh.view(), bvh.depth());
}

void register_build(const std::string& title, const std::string& scene,
                    void (*build)(benchmark::State&, const std::string&)) {
    std::string name = title;
    name.append("/").append(scene);
    for (int threads : {1, 2})
        benchmark::RegisterBenchmark(name.c_str(),
                                     [scene, build](benchmark::State& s) { build(s, scene); })
            ->ArgName("threads")
            ->Arg(threads)
            ->UseRealTime()
            ->Iterations(5)
            ->Unit(benchmark::kMillisecond);
}

const int registered = [] {
    for (const std::string& scene : scenes_of_run()) {
        register_build("wide_build", scene, from_the_root);
        register_build("wide_build_on_backend", scene, from_the_leaves);
    }
    return 0;
}();

}  // namespace
