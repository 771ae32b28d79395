// SPDX-License-Identifier: MIT
//
// What a frame holds, by structure: bytes of the scene and its hierarchies, of the luxels of one
// band and of what finds and keeps their visibility. Counted where structures take their memory, so
// they are those of any backend; milliseconds are those of making them all on the processor.
#include "mir/accel/exact/triangle_lanes.hpp"
#include "mir/accel/kd/kd_build.hpp"
#include "mir/host/wide_build.hpp"
#include "mir/resident/backend_visibility.hpp"
#include "mir/resident/backend_wide_bvh.hpp"
#include "mir/resident/quantised_bvh.hpp"
#include "mir/resident/uploaded_scene.hpp"
#include "mir/resident/uploaded_trees.hpp"
#include "support/bench_scene.hpp"
#include "support/metered_backend.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mirbench;

/// Takes the structures of a frame one after the other and notes what each adds.
class MemoryNotes {
 public:
    MemoryNotes(benchmark::State& state, mir::TbbExecutor& executor)
        : state_(state),
          executor_(executor),
          backend_(executor, meter_),
          queue_(backend_.queue()) {}

    void add(const BenchScene& scene, std::uint32_t vpls) {
        const mir::UploadedGeometry<MeteredBackend> geometry(backend_, queue_, scene.geometry);
        note("geometry");
        meter_.most = meter_.now;
        const mir::BackendWideBvh<MeteredBackend> bvh(backend_, queue_, scene.geometry,
                                                      geometry.view());
        state_.counters["bytes_bvh_build"] = static_cast<double>(meter_.most - noted_);
        note("bvh");
        const mir::QuantisedBvh<MeteredBackend> in_short(backend_, queue_, bvh.view(),
                                                         bvh.node_count());
        note("short_nodes");
        add_kd_tree(scene);
        noted_ = meter_.now;  // the kd-tree is gone again
        add_luxels(vpls);
        const mir::WideBvh on_host = mir::build_wide_bvh(scene.geometry, executor_);
        state_.counters["bytes_host_lanes"] = static_cast<double>(
            mir::make_triangle_lanes(on_host.triangles()).size() * sizeof(mir::TriangleLanes));
    }

 private:
    void add_kd_tree(const BenchScene& scene) {
        const mir::KdTree tree(scene.geometry, mir::KdTreeOptions::for_gpu(), executor_);
        const mir::UploadedKdTree<MeteredBackend> there(backend_, queue_, tree);
        note("kd_tree");
    }

    void add_luxels(std::uint32_t vpls) {
        const mir::BackendGBuffer<MeteredBackend, Bsdf::Params> luxels(backend_, paper_image,
                                                                       paper_image);
        note("luxels");
        const mir::BackendVisibility<MeteredBackend> bits(backend_, luxels.grid(), vpls);
        note("bits");
        const mir::BackendShafts<MeteredBackend> shafts(
            backend_, mir::BlockedLayout::of(luxels.tiles()[0]).size(), vpls);
        note("shafts");
    }

    /// What came since the last note.
    void note(const std::string& structure) {
        state_.counters["bytes_" + structure] = static_cast<double>(meter_.now - noted_);
        noted_ = meter_.now;
    }

    benchmark::State& state_;
    mir::TbbExecutor& executor_;
    MemoryMeter meter_;
    MeteredBackend backend_;
    MeteredBackend::Queue queue_;
    std::size_t noted_ = 0;
};

void memory(benchmark::State& state, const std::string& name) {
    mir::TbbExecutor executor(0);
    const BenchScene& scene = bench_scene(name);
    for (auto _ : state)
        MemoryNotes(state, executor).add(scene, static_cast<std::uint32_t>(state.range(0)));
    state.counters["triangles"] = static_cast<double>(scene.geometry.triangles().size());
    state.counters["luxels"] = static_cast<double>(paper_image.area());
    state.SetLabel(scene.hash);
}

const int registered = [] {
    for (const std::string& scene : scenes_of_run())
        benchmark::RegisterBenchmark(("memory/" + scene).c_str(),
                                     [scene](benchmark::State& s) { memory(s, scene); })
            ->ArgName("vpls")
            ->Arg(256)
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    return 0;
}();

}  // namespace
