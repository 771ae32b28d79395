// SPDX-License-Identifier: MIT
#include "figures.hpp"

#include "paper_numbers.hpp"

#include <algorithm>

namespace mirpaper {
namespace {

constexpr mir::Extent paper_tile{256, 256};

/// The renderers' own on a GPU, which 256 x 256 luxels do not fill.
constexpr mir::Extent gpu_tile{1024, 1024};

std::string name_of(Algorithm a) {
    return a == Algorithm::os ? "os" : a == Algorithm::rc ? "rc" : "rcvp";
}

Row new_row(const Lab& lab, const PaperScene& scene, const Figure& figure, mir::Extent tile,
            std::uint32_t vpls) {
    Row row;
    row.figure = figure.name;
    row.scene = scene.name();
    row.image = lab.options.size;
    row.tile = tile;
    row.vpls = vpls;
    return row;
}

void add_times(Row& row, const std::vector<Run>& runs, const std::string& clock) {
    row.clock = clock;
    row.wall = spread_of(runs, [](const Run& r) { return r.wall; });
    row.seconds =
        clock == "wall" ? row.wall : spread_of(runs, [](const Run& r) { return r.seconds; });
    row.mean_luminance = runs.back().mean_luminance;
    row.paper_seconds = paper_seconds(row.figure, row.scene, row.algorithm, text_of(row.tile));
}

/// Runs on the host are long and steady; those of a GPU are short and warmed up.
unsigned repeat_of(const Lab& lab, const Machine& machine, Algorithm algorithm) {
    const bool on_host = !machine.has_own_memory() || algorithm == Algorithm::os;
    return on_host ? lab.options.host_repeat : lab.options.repeat;
}

Row scheduled(Lab& lab, Machine& machine, PaperScene& scene, const Figure& figure, const Job& job) {
    Row row = new_row(lab, scene, figure, job.tile, job.vpls);
    row.backend = machine.backend();
    row.algorithm = name_of(job.algorithm);
    if (job.resident) row.variant = "resident";
    const unsigned repeat = repeat_of(lab, machine, job.algorithm);
    // OS ends with sums on the host, which no event sees.
    const bool host_last = job.algorithm == Algorithm::os;
    add_times(row, machine.run(job, repeat, machine.has_own_memory() && !host_last),
              host_last ? "wall" : "events");
    return row;
}

/// RC and RCVP with luxels from the host and, on a GPU, with luxels that are there already.
void add_rc_and_rcvp(Lab& lab, PaperScene& scene, const Figure& figure, std::uint32_t vpls,
                     mir::Extent tile) {
    for (const auto& machine : lab.machines)
        for (const bool resident : {false, true}) {
            if (resident && !machine->has_own_memory()) continue;
            for (const Algorithm a : {Algorithm::rc, Algorithm::rcvp})
                lab.add(scheduled(lab, *machine, scene, figure, {a, tile, vpls, resident}));
        }
}

void add_host_row(Lab& lab, PaperScene& scene, const Figure& figure, std::uint32_t vpls,
                  const std::string& algorithm, const std::vector<Run>& runs) {
    if (runs.empty()) return;
    Row row = new_row(lab, scene, figure, paper_tile, vpls);
    row.backend = "cpu";
    row.algorithm = algorithm;
    add_times(row, runs, "wall");
    lab.add(row);
}

void figure_8(Lab& lab, PaperScene& scene, const Figure& figure) {
    for (const std::uint32_t vpls : figure.vpls) {
        std::vector<Run> plain;
        std::vector<Run> blocks;
        for (unsigned i = 0; i < lab.options.host_repeat; ++i) {
            plain.push_back(run_plain_loop(scene, vpls, lab.executor));
            blocks.push_back(run_blocks(scene, paper_tile, vpls, lab.executor));
        }
        add_host_row(lab, scene, figure, vpls, "cpu", plain);
        add_host_row(lab, scene, figure, vpls, "cpu-blocks", blocks);
        add_host_row(lab, scene, figure, vpls, "embree-blocks",
                     run_embree(scene, paper_tile, vpls, lab.options.host_repeat, lab.executor));
        for (const auto& machine : lab.machines)
            lab.add(
                scheduled(lab, *machine, scene, figure, {Algorithm::os, paper_tile, vpls, false}));
        add_rc_and_rcvp(lab, scene, figure, vpls, paper_tile);
    }
}

void figure_9(Lab& lab, PaperScene& scene, const Figure& figure) {
    for (const std::uint32_t vpls : figure.vpls)
        add_rc_and_rcvp(lab, scene, figure, vpls, paper_tile);
}

void figure_11(Lab& lab, PaperScene& scene, const Figure& figure) {
    for (const mir::Extent tile :
         {mir::Extent{100, 100}, mir::Extent{100, 256}, mir::Extent{256, 256},
          mir::Extent{512, 256}, mir::Extent{512, 512}, mir::Extent{1024, 1024}, lab.options.size})
        for (const std::uint32_t vpls : figure.vpls)
            add_rc_and_rcvp(lab, scene, figure, vpls, tile);
}

Row kernels_alone(Lab& lab, Machine& machine, PaperScene& scene, const Figure& figure,
                  const KernelChoice& choice) {
    Row row = new_row(lab, scene, figure, lab.options.size, choice.vpls);
    row.backend = machine.backend();
    row.clock = "events";
    const unsigned repeat = repeat_of(lab, machine, Algorithm::rc);
    const std::vector<KernelRun> runs = machine.kernels(choice, repeat);
    row.seconds = spread_of(runs, [](const KernelRun& r) { return r.seconds; });
    row.visibility_seconds =
        spread_of(runs, [](const KernelRun& r) { return r.visibility; }).median;
    row.shading_seconds = spread_of(runs, [](const KernelRun& r) { return r.shading; }).median;
    row.mean_luminance = runs.back().mean_luminance;
    row.stages = runs[runs.size() / 2].stages;
    return row;
}

void rates(Lab& lab, PaperScene& scene, const Figure& figure) {
    for (const std::uint32_t vpls : figure.vpls) {
        add_rc_and_rcvp(lab, scene, figure, vpls, gpu_tile);
        for (const auto& machine : lab.machines)
            for (const KernelVariant variant : {KernelVariant::fused, KernelVariant::split}) {
                KernelChoice choice;
                choice.variant = variant;
                choice.vpls = vpls;
                Row row = kernels_alone(lab, *machine, scene, figure, choice);
                row.algorithm = variant == KernelVariant::fused ? "rc" : "rcvp";
                row.variant = "kernels alone";
                row.paper_contributions = paper_peak(scene.name());
                lab.add(row);
            }
    }
}

void figure_10(Lab& lab, PaperScene& scene, const Figure& figure) {
    for (const std::uint32_t vpls : figure.vpls)
        for (const auto& machine : lab.machines)
            for (const Algorithm a : {Algorithm::rc, Algorithm::rcvp}) {
                Row row = scheduled(lab, *machine, scene, figure, {a, paper_tile, vpls, false});
                row.paper_contributions = paper_peak(scene.name());
                lab.add(row);
            }
}

/// The run in the middle by length, of a few.
StageSeconds typical_stages(Machine& machine, const Job& job, unsigned runs) {
    std::vector<StageSeconds> all;
    for (unsigned i = 0; i < runs; ++i) all.push_back(machine.trace(job).stages);
    std::sort(all.begin(), all.end(),
              [](const StageSeconds& a, const StageSeconds& b) { return a.span < b.span; });
    return all[all.size() / 2];
}

void stages(Lab& lab, PaperScene& scene, const Figure& figure) {
    for (const std::uint32_t vpls : figure.vpls)
        for (const auto& machine : lab.machines)
            for (const Algorithm a : {Algorithm::os, Algorithm::rc, Algorithm::rcvp}) {
                // OS takes long, and the paper shows it on the first scene alone.
                if (a == Algorithm::os && scene.name() != figure.scenes.front()) continue;
                const Job job{a, paper_tile, vpls, false};
                Row row = scheduled(lab, *machine, scene, figure, job);
                row.stages = typical_stages(*machine, job, a == Algorithm::os ? 1 : 5);
                lab.add(row);
            }
}

/// One change at a time from the library's own kernels.
std::vector<KernelChoice> kernel_choices(std::uint32_t vpls) {
    KernelChoice own;
    own.vpls = vpls;
    std::vector<KernelChoice> choices(7, own);
    choices[1].variant = KernelVariant::split;
    choices[2].variant = KernelVariant::per_vpl;
    choices[3].start = RayStart::luxel;
    choices[4].luxels = LuxelOrder::rows;
    choices[5].luxels = LuxelOrder::clusters;
    choices[6].vpl_order = VplOrder::shuffled;
    return choices;
}

std::string name_of(const KernelChoice& c) {
    const auto index = [](auto e) { return static_cast<std::size_t>(e); };
    return std::string("luxels in ") + luxel_order_names[index(c.luxels)] + ", VPLs " +
           vpl_order_names[index(c.vpl_order)] + ", rays from the " +
           ray_start_names[index(c.start)];
}

void kernel_figure(Lab& lab, PaperScene& scene, const Figure& figure) {
    for (const std::uint32_t vpls : figure.vpls)
        for (const auto& machine : lab.machines)
            for (const KernelChoice& choice : kernel_choices(vpls)) {
                Row row = kernels_alone(lab, *machine, scene, figure, choice);
                row.algorithm = variant_names[static_cast<std::size_t>(choice.variant)];
                row.variant = name_of(choice);
                lab.add(row);
            }
}

/// Shafts against rays of the same engine, in both orders of luxels.
void shafts(Lab& lab, PaperScene& scene, const Figure& figure) {
    KernelChoice choice;
    for (const std::uint32_t vpls : figure.vpls)
        for (const auto& machine : lab.machines)
            for (const LuxelOrder order : {LuxelOrder::squares, LuxelOrder::clusters})
                for (const RayEngine engine : {RayEngine::kd_tree, RayEngine::wide_bvh})
                    for (const KernelVariant variant :
                         {KernelVariant::fused, KernelVariant::shafts}) {
                        choice.vpls = vpls;
                        choice.luxels = order;
                        choice.engine = engine;
                        choice.variant = variant;
                        Row row = kernels_alone(lab, *machine, scene, figure, choice);
                        row.algorithm = variant_names[static_cast<std::size_t>(variant)];
                        row.variant = std::string("luxels in ") +
                                      luxel_order_names[static_cast<std::size_t>(order)] + ", " +
                                      ray_engine_names[static_cast<std::size_t>(engine)];
                        lab.add(row);
                    }
}

void luxels(Lab& lab, PaperScene& scene, const Figure& figure) {
    for (const auto& machine : lab.machines) {
        const unsigned repeat = repeat_of(lab, *machine, Algorithm::rc);
        const std::vector<LuxelRun> runs = machine->luxels(paper_tile, repeat);
        Row row = new_row(lab, scene, figure, paper_tile, 0);
        row.backend = machine->backend();
        row.clock = "events";
        row.algorithm = "uploaded";
        row.seconds = spread_of(runs, [](const LuxelRun& r) { return r.uploaded; });
        lab.add(row);
        row.algorithm = "traced";
        row.seconds = spread_of(runs, [](const LuxelRun& r) { return r.traced; });
        lab.add(row);
    }
}

void counters(Lab& lab, PaperScene& scene, const Figure& figure) {
    constexpr std::uint32_t groups = 512;
    for (const std::uint32_t vpls : figure.vpls) {
        Row row = new_row(lab, scene, figure, lab.options.size, vpls);
        row.counters = count_rays(scene, scene.vpls(vpls), groups, lab.executor);
        lab.add(row);
    }
}

}  // namespace

Figure Figure::with(const Options& options) const {
    Figure changed = *this;
    if (!options.scenes.empty()) changed.scenes = options.scenes;
    if (!options.vpls.empty()) changed.vpls = options.vpls;
    return changed;
}

std::vector<Figure> all_figures() {
    const std::vector<std::string> four{"sphere", "car", "car-grille", "garage"};
    return {
        {"8", {"sphere"}, {256}, figure_8},
        {"9",
         {"sphere", "sphere-indirect", "car", "car-indirect", "car-grille", "car-grille-indirect"},
         {256},
         figure_9},
        {"10", {"sphere", "car", "garage"}, {16, 64, 256, 512, 1024}, figure_10},
        {"11", {"car"}, {256}, figure_11},
        {"rates", four, {256, 1024}, rates},
        {"stages", four, {256}, stages},
        {"luxels", four, {0}, luxels},
        {"kernels", four, {256}, kernel_figure},
        {"shafts", four, {256}, shafts},
        {"counters", four, {256}, counters},
    };
}

}  // namespace mirpaper
