// SPDX-License-Identifier: MIT
//
// What shading alone costs: the light of VPLs that are known to be seen, added by blocks in vector
// registers and, as the baseline beside it, luxel by luxel. Both images are compared in every bit.
#include "mir/core/stopwatch.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "support/bench_runs.hpp"

#include <benchmark/benchmark.h>

#include <bit>
#include <cstring>

namespace {

using namespace mirbench;

constexpr mir::Extent image{800, 600};
constexpr std::uint32_t vpl_count = 256;

/// Luxels, VPLs, and who sees whom.
struct Known {
    Known(const BenchScene& s, mir::TbbExecutor& executor)
        : gbuffer(s.gbuffer(image, {64, 64})),
          vpls(s.vpls(vpl_count)),
          shading(s.shading(vpls.size())),
          matrix(gbuffer.tiles(), vpls.size()) {
        mir::fill_visibility(matrix, gbuffer, vpls.span(), s.engine.visibility(), executor);
    }

    template <class Scheduler>
    [[nodiscard]] mir::Image<mir::Rgb> shade(const Scheduler& scheduler) const {
        return mir::reconstruct(scheduler, gbuffer, vpls.span(), matrix.view(), shading);
    }

    /// Pairs that see each other: the contributions that are evaluated.
    [[nodiscard]] std::uint64_t lit() const {
        std::uint64_t count = 0;
        for (mir::TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
            const std::uint32_t groups =
                gbuffer.view(t).size() / mir::VisibilityMatrix::View::group_size;
            for (std::uint32_t group = 0; group < groups; ++group)
                for (mir::VplIndex j = 0; j < vpls.size(); ++j)
                    count +=
                        static_cast<std::uint64_t>(std::popcount(matrix.view().mask(t, group, j)));
        }
        return count;
    }

    GBuffer gbuffer;
    mir::VplList vpls;
    mir::VplShading<Bsdf> shading;
    mir::VisibilityMatrix matrix;
};

bool same_bits(const mir::Image<mir::Rgb>& a, const mir::Image<mir::Rgb>& b) {
    return std::memcmp(a.pixels().data(), b.pixels().data(),
                       a.pixels().size() * sizeof(mir::Rgb)) == 0;
}

void shading(benchmark::State& state, const std::string& name, mir::InstructionSet set) {
    if (set > mir::best_instruction_set()) {
        state.SkipWithError("this processor does not have these instructions");
        return;
    }
    mir::TbbExecutor executor(static_cast<unsigned>(state.range(0)));
    const Known known(bench_scene(name), executor);
    double blocks = 0.0;
    double plain = 0.0;
    for (auto _ : state) {
        mir::Image<mir::Rgb> by_blocks;
        mir::Image<mir::Rgb> by_luxels;
        const double before = blocks;
        {
            const mir::Stopwatch watch(blocks);
            by_blocks = known.shade(mir::sched::CpuBlocks{executor, nullptr, set});
        }
        {
            const mir::Stopwatch watch(plain);
            by_luxels = known.shade(mir::sched::Cpu{executor});
        }
        if (!same_bits(by_blocks, by_luxels)) state.SkipWithError("blocks changed a bit");
        state.SetIterationTime(blocks - before);
    }
    const auto n = static_cast<double>(state.iterations());
    const auto lit = static_cast<double>(known.lit());
    state.counters["time_over_plain"] = blocks / plain;
    state.counters["evaluated/s"] = lit * n / blocks;
    state.counters["lit_share"] = lit / (static_cast<double>(image.area()) * known.vpls.size());
    state.SetLabel(bench_scene(name).hash);
}

const int registered = [] {
    constexpr std::pair<const char*, mir::InstructionSet> sets[] = {
        {"baseline", mir::InstructionSet::baseline},
        {"avx2", mir::InstructionSet::avx2},
        {"avx512", mir::InstructionSet::avx512}};
    for (const std::string& scene : scenes_of_run())
        for (const auto& [title, set] : sets)
            benchmark::RegisterBenchmark(
                (std::string("shading/") + title + "/" + scene).c_str(),
                [scene, set = set](benchmark::State& s) { shading(s, scene, set); })
                ->ArgName("threads")
                ->Arg(1)
                ->Arg(0)
                ->UseManualTime()
                ->Iterations(5)
                ->Unit(benchmark::kMillisecond);
    return 0;
}();

}  // namespace
