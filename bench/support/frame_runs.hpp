// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/all_renderers.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace mirbench {

/// The renderer of a machine; null, and the benchmark skipped, where there is none.
inline std::unique_ptr<mir::Renderer> renderer_of(mir::BackendKind backend,
                                                  benchmark::State& state) {
    mir::Registry registry;
    mir::add_all_to(registry);
    try {
        return registry.make(backend, "");
    } catch (const mir::Error& e) {
        state.SkipWithError(e.what());
        return nullptr;
    }
}

/// Frames by one renderer, as a program that draws many; the statistics of that whose total is the
/// median. Counters are milliseconds: `ms_*` of its stages, `ms` of all of it, `ms_least` and
/// `ms_most` of the fastest and the slowest frame.
inline mir::RenderStatistics time_frames(benchmark::State& state, const mir::Renderer& renderer,
                                         const mir::Scene& scene,
                                         const mir::RenderSettings& settings) {
    std::vector<mir::RenderStatistics> frames;
    for (auto _ : state) {
        frames.push_back(renderer.render(scene, settings, nullptr).statistics);
        state.SetIterationTime(frames.back().seconds.total);
    }
    std::sort(frames.begin(), frames.end(),
              [](const auto& a, const auto& b) { return a.seconds.total < b.seconds.total; });
    const mir::RenderStatistics& median = frames[frames.size() / 2];
    for (const mir::RenderStage& stage : mir::render_stages)
        state.counters["ms_" + std::string(stage.name)] = 1e3 * median.seconds.*stage.seconds;
    state.counters["ms"] = 1e3 * median.seconds.total;
    state.counters["ms_least"] = 1e3 * frames.front().seconds.total;
    state.counters["ms_most"] = 1e3 * frames.back().seconds.total;
    return median;
}

}  // namespace mirbench
