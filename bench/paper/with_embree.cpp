// SPDX-License-Identifier: MIT
#include "machine.hpp"
#include "mir/core/stopwatch.hpp"
#include "mir/cpu/embree_scene.hpp"
#include "mir/sched/cpu_blocks.hpp"

namespace mirpaper {

std::vector<Run> run_embree(PaperScene& scene, mir::Extent tile, std::uint32_t vpls,
                            unsigned repeat, Executor& executor) {
    const mir::cpu::EmbreeScene engine(scene.geometry());
    const auto luxels = retiled<std::allocator<std::uint32_t>>(scene.luxels(), tile, executor);
    const mir::VplList& lights = scene.vpls(vpls);
    std::vector<Run> runs(repeat);
    for (Run& run : runs) {
        mir::Image<mir::Rgb> image;
        {
            const mir::Stopwatch watch(run.wall);
            image = mir::reconstruct(mir::sched::CpuBlocks{executor}, luxels, lights.span(),
                                     engine.visibility(), scene.shading(vpls));
        }
        run.seconds = run.wall;
        run.mean_luminance = mean_luminance(image);
    }
    return runs;
}

}  // namespace mirpaper
