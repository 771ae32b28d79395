// SPDX-License-Identifier: MIT
#include "study.hpp"

#include "figures.hpp"

#include <algorithm>
#include <cstdio>

namespace mirpaper {
namespace {

bool is_wanted(const Options& options, const std::string& backend) {
    const auto& names = options.backends;
    return names.empty() || std::find(names.begin(), names.end(), backend) != names.end();
}

/// The GPU: an error when it was asked for and is not there, a remark when it was not.
void add_cuda(const Options& options, Executor& executor,
              std::vector<std::unique_ptr<Machine>>& machines) {
    try {
        auto machine = make_cuda_machine(executor);
        if (!machine)
            throw mir::Error(mir::ErrorCode::no_device,
                             "this build has no CUDA backend (mir was configured without one); "
                             "configure with the preset cuda or use --backend cpu");
        machines.push_back(std::move(machine));
    } catch (const mir::Error& e) {
        if (e.code() != mir::ErrorCode::no_device || !options.backends.empty()) throw;
        std::fprintf(stderr, "bench_paper: without CUDA: %s\n", e.what());
    }
}

std::vector<std::unique_ptr<Machine>> make_machines(const Options& options, Executor& executor) {
    std::vector<std::unique_ptr<Machine>> machines;
    if (is_wanted(options, "cpu")) machines.push_back(make_host_machine(executor));
    if (is_wanted(options, "cuda")) add_cuda(options, executor, machines);
    return machines;
}

std::vector<Figure> wanted_figures(const Options& options) {
    std::vector<Figure> figures;
    for (const Figure& figure : all_figures())
        if (options.wants(figure.name)) figures.push_back(figure.with(options));
    return figures;
}

/// Scenes in the order in which figures first ask for them: each is built once.
std::vector<std::string> scenes_of(const std::vector<Figure>& figures) {
    std::vector<std::string> names;
    for (const Figure& figure : figures)
        for (const std::string& scene : figure.scenes)
            if (std::find(names.begin(), names.end(), scene) == names.end()) names.push_back(scene);
    return names;
}

void print_progress(const Row& row) {
    std::fprintf(stderr, "  figure %-8s %-5s %-13s %5u VPLs  tile %-9s %8.2f ms  %8.3f G/s  %s\n",
                 row.figure.c_str(), row.backend.c_str(), row.algorithm.c_str(), row.vpls,
                 text_of(row.tile).c_str(), 1e3 * row.seconds.median, 1e-9 * row.rate(),
                 row.variant.c_str());
}

void measure_scene(const std::string& name, const std::vector<Figure>& figures, Lab& lab,
                   Results& results) {
    std::fprintf(stderr, "%s\n", name.c_str());
    PaperScene scene(name, lab.options.size, lab.options.tree, lab.options.wide, lab.executor);
    const mir::KdTreeStatistics& tree = scene.tree().statistics();
    results.scenes.push_back({name, scene.hash(), tree.triangles, tree.seconds(), tree.sah_cost,
                              tree.bytes, lab.options.tree, lab.options.wide.splits});
    std::fprintf(stderr, "  %llu triangles, kd-tree in %.2f s\n",
                 static_cast<unsigned long long>(tree.triangles), tree.seconds());
    for (const auto& machine : lab.machines) machine->enter(scene);
    for (const Figure& figure : figures)
        if (std::find(figure.scenes.begin(), figure.scenes.end(), name) != figure.scenes.end())
            figure.measure(lab, scene, figure);
}

}  // namespace

Results run_study(const Options& options, const std::function<void(const Results&)>& keep) {
    Executor executor(options.threads);
    auto machines = make_machines(options, executor);
    Results results;
    results.image = options.size;
    results.repeat = options.repeat;
    results.host_repeat = options.host_repeat;
    results.devices.push_back("host: " + std::to_string(executor.concurrency()) + " threads");
    for (const auto& machine : machines)
        if (machine->has_own_memory())
            results.devices.push_back(machine->backend() + ": " + machine->device());
    Lab lab{options, executor, machines, [&](const Row& row) {
                print_progress(row);
                results.rows.push_back(row);
            }};
    const std::vector<Figure> figures = wanted_figures(options);
    for (const std::string& name : scenes_of(figures)) {
        measure_scene(name, figures, lab, results);
        keep(results);
    }
    return results;
}

}  // namespace mirpaper
