// SPDX-License-Identifier: MIT
#include "added_scene.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "load_scene.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/frame_scene.hpp"
#include "print_result.hpp"
#include "progress.hpp"
#include "render_output.hpp"
#include "render_passes.hpp"
#include "report/render_report.hpp"
#include "text.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

namespace mirtool {
namespace {

constexpr std::uint32_t default_height = 480;

/// Position in the file's list of cameras of the one that was asked for.
std::size_t find_camera(const RenderOptions& o, const mir::SceneReport& report) {
    std::string names;
    const std::string wanted = mir::printable(o.camera);
    for (std::size_t i = 0; i < report.cameras.size(); ++i) {
        if (report.cameras[i].name == wanted) return i;
        names += (i == 0 ? "'" : ", '") + report.cameras[i].name + "'";
    }
    std::size_t index = 0;
    const char* end = o.camera.data() + o.camera.size();
    const auto read = std::from_chars(o.camera.data(), end, index);
    if (read.ec == std::errc() && read.ptr == end && index < report.cameras.size()) return index;
    throw mir::Error(mir::ErrorCode::invalid_argument, shown(o.scene) + ": there is no camera '" +
                                                           wanted + "'; the scene has " +
                                                           (names.empty() ? "none" : names));
}

/// Sets the scene's camera and returns what the file says about it.
std::optional<mir::CameraReport> choose_camera(RenderOptions& o, SceneAndReport& loaded) {
    const auto& cameras = loaded.report.cameras;
    if (!o.camera.empty()) {
        const mir::CameraReport& chosen = cameras[find_camera(o, loaded.report)];
        if (!chosen.index)
            throw mir::Error(mir::ErrorCode::invalid_input,
                             o.scene + ": camera '" + chosen.name + "' is " + chosen.kind +
                                 ", which is not supported; choose a perspective one");
        o.settings.camera = *chosen.index;
        return chosen;
    }
    const auto usable =
        std::find_if(cameras.begin(), cameras.end(),
                     [](const mir::CameraReport& c) { return c.index.has_value(); });
    if (usable == cameras.end()) return std::nullopt;
    o.settings.camera = *usable->index;
    return *usable;
}

/// Width and height: as asked, else those of the file, else its aspect ratio.
mir::Extent choose_size(const RenderOptions& o, const std::optional<mir::CameraReport>& camera,
                        const mir::Scene& scene) {
    if (o.width && o.height) return {*o.width, *o.height};
    float aspect = 4.0f / 3.0f;
    if (camera) {
        const float given = scene.cameras[*camera->index].aspect_ratio;
        if (given > 0.0f) aspect = given;
        if (camera->width > 0 && camera->height > 0) {
            if (!o.width && !o.height) return {camera->width, camera->height};
            aspect = static_cast<float>(camera->width) / static_cast<float>(camera->height);
        }
    }
    const auto side = [](float length) {
        return static_cast<std::uint32_t>(std::clamp(std::round(length), 1.0f, 65536.0f));
    };
    if (o.width) return {*o.width, side(static_cast<float>(*o.width) / aspect)};
    const std::uint32_t height = o.height.value_or(default_height);
    return {side(static_cast<float>(height) * aspect), height};
}

void prepare(RenderOptions& o, SceneAndReport& loaded) {
    add_to_scene(o.added, loaded);
    const auto camera = choose_camera(o, loaded);
    o.settings.image = choose_size(o, camera, loaded.scene);
    bool inside = false;
    if (!camera) {
        const mir::FramedScene framed =
            mir::frame_scene(loaded.scene, o.settings.aspect(), o.settings.limits);
        inside = framed.inside;
        loaded.scene.cameras.push_back(framed.camera);
        o.settings.camera = static_cast<std::uint32_t>(loaded.scene.cameras.size() - 1);
    }
    const auto wants = [&o](const char* layer) {
        return std::find(o.layers.begin(), o.layers.end(), layer) != o.layers.end();
    };
    o.settings.bounce_layers = wants("bounces");
    o.settings.removed_layer = wants("removed");
    // Before the remarks, so that a scene that cannot be rendered is answered in one line.
    mir::check_scene(loaded.scene, o.settings);
    if (o.quiet) return;
    for (const auto& [what, times] : loaded.report.ignored)
        std::fprintf(stderr, "mir: %s: ignored: %s\n", shown(o.scene).c_str(),
                     ignored_text(what, times).c_str());
    if (!camera)
        std::fprintf(stderr, "mir: %s: no usable camera; %s (--eye chooses another view)\n",
                     shown(o.scene).c_str(),
                     inside ? "it is a room, seen from inside" : "it is seen from outside");
}

/// Names options of chains that were given and changed nothing, because no chain mutated.
void note_idle_options(const mir::RenderSettings& s, mir::RenderResult& result) {
    if (!result.statistics.health || result.statistics.health->mutations > 0) return;
    const mir::MetropolisTuning& m = s.metropolis;
    const mir::MetropolisTuning usual;
    std::string idle;
    const auto add = [&idle](bool is_given, const char* option) {
        if (is_given) idle += (idle.empty() ? "" : ", ") + std::string(option);
    };
    add(m.stride != usual.stride, "--stride");
    add(m.chain.tries != usual.chain.tries, "--tries");
    add(m.chain.large_step_probability != usual.chain.large_step_probability, "--large-steps");
    add(m.chain.mutation != usual.chain.mutation, "--mutation");
    if (!idle.empty())
        result.warnings.push_back("no chain mutated (there are as many chains as VPLs), so " +
                                  idle + " had no effect; fewer --chains than --vpls mutate");
}

mir::RenderResult render(const RenderOptions& o, const mir::Scene& scene, const OutputPaths& paths,
                         mir::Monitor& monitor, Convergence& convergence) {
    mir::Registry registry;
    mir::add_all_to(registry);
    const mir::Registry::Choice choice = registry.make_for(o.settings);
    std::optional<Progress> progress;
    if (!o.quiet) progress.emplace(monitor);
    mir::RenderResult result =
        render_passes(*choice.renderer, scene, o, paths, monitor, convergence);
    result.warnings.insert(result.warnings.begin(), choice.remarks.begin(), choice.remarks.end());
    note_idle_options(o.settings, result);
    return result;
}

/// Does `work`; a failure that is the fault of the scene names it.
template <class Work>
auto blaming(const std::string& scene, const Work& work) {
    try {
        return work();
    } catch (const mir::Error& e) {
        const std::string what = e.what();
        if (e.code() != mir::ErrorCode::invalid_input || what.starts_with(shown(scene))) throw;
        throw mir::Error(e.code(), shown(scene) + ": " + what, e.where());
    }
}

}  // namespace

int run(const RenderOptions& options) {
    RenderOptions o = options;
    o.settings.validate();
    check(o.passes);
    const OutputPaths paths = choose_outputs(o);
    const mir::Image<mir::Rgb> reference = read_report_reference(o);
    // Bounds Embree's build too, which runs on the same library.
    std::optional<tbb::global_control> threads;
    if (o.settings.threads > 0)
        threads.emplace(tbb::global_control::max_allowed_parallelism, o.settings.threads);
    SceneAndReport loaded = load_scene(o.scene, o.settings.limits, o.environment);
    blaming(o.scene, [&] { prepare(o, loaded); });
    check_report_reference(o, reference);
    // Also while files are written, since a signal that ended the program there would leave halves.
    mir::Monitor monitor;
    const CancelOnInterrupt cancel(monitor);
    Convergence convergence(reference);
    mir::RenderResult result =
        blaming(o.scene, [&] { return render(o, loaded.scene, paths, monitor, convergence); });
    const std::vector<std::string>& remarks = loaded.report.remarks;
    result.warnings.insert(result.warnings.begin(), remarks.begin(), remarks.end());
    write_outputs(paths, result, o);
    write_render_report({o, loaded, result, reference, convergence});
    if (!o.quiet) print_summary(result);
    if (o.json) {
        print_json(paths, result, o, convergence);
    } else {
        for (const std::string& name : {paths.exr, paths.png, o.report, o.vpls_out})
            if (!name.empty()) print_result(name);
    }
    if (result.statistics.complete) return exit_done;
    std::fprintf(stderr,
                 "mir: interrupted; the picture is the mean of %u passes, marked incomplete\n",
                 result.statistics.passes);
    return exit_interrupted;
}

}  // namespace mirtool
