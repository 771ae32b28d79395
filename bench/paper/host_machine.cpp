// SPDX-License-Identifier: MIT
#include "backend_machine.hpp"
#include "mir/host/backend.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/sched/cpu_blocks.hpp"

namespace mirpaper {
namespace {

template <class S>
Run run_host_scheduler(PaperScene& scene, const S& scheduler, const GBuffer& luxels,
                       std::uint32_t count) {
    const mir::VplList& vpls = scene.vpls(count);
    Run run;
    mir::Image<mir::Rgb> image;
    {
        const mir::Stopwatch watch(run.wall);
        image = mir::reconstruct(scheduler, luxels, vpls.span(), scene.visibility(),
                                 scene.shading(count));
    }
    run.seconds = run.wall;
    run.mean_luminance = mean_luminance(image);
    return run;
}

}  // namespace

std::unique_ptr<Machine> make_host_machine(Executor& executor) {
    using B = mir::host::Backend<Executor>;
    using Alloc = std::allocator<std::uint32_t>;
    return std::make_unique<BackendMachine<B, Alloc>>(
        B(executor), Alloc(), "cpu", std::to_string(executor.concurrency()) + " threads", executor);
}

Run run_plain_loop(PaperScene& scene, std::uint32_t vpls, Executor& executor) {
    return run_host_scheduler(scene, mir::sched::Cpu{executor}, scene.luxels(), vpls);
}

Run run_blocks(PaperScene& scene, mir::Extent tile, std::uint32_t vpls, Executor& executor) {
    const auto luxels = retiled<std::allocator<std::uint32_t>>(scene.luxels(), tile, executor);
    return run_host_scheduler(scene, mir::sched::CpuBlocks{executor}, luxels, vpls);
}

double mean_luminance(const mir::Image<mir::Rgb>& image) {
    double total = 0.0;
    for (const mir::Rgb& pixel : image.pixels())
        total += static_cast<double>(mir::luminance(pixel));
    return total / static_cast<double>(image.extent().area());
}

}  // namespace mirpaper
