// SPDX-License-Identifier: MIT
//
// Seconds that MetropolisSampler takes for 256 VPLs, bootstrap included, against the seconds of
// reconstructing the image with them on the tuned CPU path, one after the other in every iteration:
// the ratio of two times taken side by side survives a noisy machine. Reconstruction is all shadow
// rays into stored bits, the response of the image to each VPL, and shading from the bits.
#include "mir/core/stopwatch.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/normalise/normalise.hpp"
#include "mir/reshade.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "support/bench_runs.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace mirbench;

mir::VplRecords time_sampling(const BenchScene& s, mir::TbbExecutor& executor, double& seconds) {
    constexpr std::uint32_t vpls = 256;
    const float aspect =
        static_cast<float>(paper_image.width) / static_cast<float>(paper_image.height);
    const mir::PathWorld<Bsdf, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility> world{
        s.geometry,
        s.lights,
        s.surfaces,
        s.engine.ray_caster(),
        s.engine.visibility(),
        s.scene.cameras.front(),
        aspect,
        s.shading(vpls).bound};
    mir::MetropolisOptions options;
    options.states = vpls;
    const mir::Stopwatch watch(seconds);
    return mir::MetropolisSampler(world, options).sample(executor);
}

void time_reconstruction(const BenchScene& s, const GBuffer& gbuffer,
                         const mir::VplRecords& records, mir::TbbExecutor& executor,
                         double& seconds) {
    const mir::Stopwatch watch(seconds);
    mir::VplList vpls = mir::aggregate(records);
    mir::VisibilityMatrix bits(gbuffer.tiles(), vpls.size());
    mir::fill_visibility(bits, gbuffer, vpls.span(), s.engine.visibility(), executor);
    const auto shading = s.shading(256);
    mir::normalise(vpls, mir::response(gbuffer, vpls.span(), bits, shading, executor),
                   records.path_luminance, records.states);
    benchmark::DoNotOptimize(
        mir::reshade(mir::sched::CpuBlocks{executor}, gbuffer, vpls.span(), bits, shading));
}

void sampling(benchmark::State& state, const std::string& name) {
    const BenchScene& s = bench_scene(name);
    const GBuffer gbuffer = s.gbuffer(paper_image, {64, 64});
    mir::TbbExecutor executor(static_cast<unsigned>(state.range(0)));
    double sampled = 0.0;
    double reconstructed = 0.0;
    mir::VplRecords records;
    for (auto _ : state) {
        double seconds = 0.0;
        records = time_sampling(s, executor, seconds);
        state.SetIterationTime(seconds);
        sampled += seconds;
        time_reconstruction(s, gbuffer, records, executor, reconstructed);
    }
    const auto n = static_cast<double>(state.iterations());
    const mir::ChainHealth& health = *records.health;
    state.counters["sampling_over_reconstruction"] = sampled / reconstructed;
    state.counters["reconstruction_ms"] = 1e3 * reconstructed / n;
    state.counters["bootstrap_paths"] = static_cast<double>(health.luminance.paths);
    state.counters["mutations"] = static_cast<double>(health.mutations);
    state.counters["mutations/s"] = static_cast<double>(health.mutations) * n / sampled;
    state.SetLabel(s.hash);
}

const int registered = [] {
    register_by_threads("sampling", sampling);
    return 0;
}();

}  // namespace
