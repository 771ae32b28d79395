// SPDX-License-Identifier: MIT
#include "band_journal.hpp"
#include "commands.hpp"
#include "denoising.hpp"
#include "exit_code.hpp"
#include "idle_options.hpp"
#include "load_scene.hpp"
#include "mir/film/filter.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/runtime/picture_team.hpp"
#include "prepare_scene.hpp"
#include "print_result.hpp"
#include "progress.hpp"
#include "render_output.hpp"
#include "render_passes.hpp"
#include "render_shard.hpp"
#include "report/render_report.hpp"
#include "team_renderer.hpp"
#include "text.hpp"

#include <tbb/global_control.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mirtool {
namespace {

/// Makes the scene ready, and tells what of it is left out.
void prepare(RenderOptions& o, SceneAndReport& loaded) {
    const ChosenView view = prepare_scene(o, loaded);
    if (o.quiet) return;
    for (const auto& [what, times] : loaded.report.ignored)
        std::fprintf(stderr, "mir: %s: ignored: %s\n", shown(o.scene).c_str(),
                     ignored_text(what, times).c_str());
    if (view.framed)
        std::fprintf(stderr, "mir: %s: no usable camera; %s (--eye chooses another view)\n",
                     shown(o.scene).c_str(),
                     view.inside ? "it is a room, seen from inside" : "it is seen from outside");
}

mir::RenderResult render(const mir::Registry::Choice& choice, const RenderOptions& o,
                         const mir::Scene& scene, const OutputPaths& paths, mir::Monitor& monitor,
                         Convergence& convergence) {
    std::optional<Progress> progress;
    if (!o.quiet) progress.emplace(monitor);
    mir::RenderResult result =
        render_passes(*choice.renderer, scene, o, paths, monitor, convergence);
    result.warnings.insert(result.warnings.begin(), choice.remarks.begin(), choice.remarks.end());
    note_idle_options(o.settings, result);
    return result;
}

/// Adds the picture without noise to the result, if there is a denoiser.
Denoising denoised(const std::optional<mir::Denoiser>& denoiser, mir::RenderResult& result,
                   const mir::Image<mir::Rgb>& reference, const RenderOptions& o,
                   mir::Monitor& monitor) {
    if (!denoiser) return {};
    const std::string remark = filter_remark(std::string(to_string(o.settings.filter.kind)));
    if (!remark.empty()) result.warnings.push_back(remark);
    Denoising done;
    try {
        done = denoise_result(result, *denoiser, monitor);
    } catch (const std::exception& e) {  // the picture with its noise is written all the same
        done.failure = e.what();
    }
    if (!done.denoiser.empty())
        done.measure(result.beauty, result.denoised, reference, o.report_reference);
    return done;
}

/// The exit code; says what a render lacks that was interrupted, or its denoiser failed.
int ending(const RenderOptions& o, const mir::RenderResult& result, const Denoising& denoising) {
    if (!result.statistics.complete) {
        std::fprintf(stderr,
                     "mir: interrupted; the picture is the mean of %u passes, marked incomplete\n",
                     result.statistics.passes);
        return exit_interrupted;
    }
    if (!denoising.failure.empty()) {
        std::fprintf(stderr, "mir: the picture is not denoised: %s\n",
                     shown(denoising.failure).c_str());
        return exit_failure;
    }
    if (!o.denoise || !result.denoiser.empty()) return exit_done;
    std::fprintf(stderr, "mir: interrupted; the picture is not denoised\n");
    return exit_interrupted;
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

/// Checked, and with what some of the options mean for others.
RenderOptions settled(const RenderOptions& options) {
    RenderOptions o = options;
    o.settings.validate();
    check(o.passes);
    if (o.denoise && !o.has_filter) o.settings.filter = mir::default_filter(mir::FilterKind::box);
    return o;
}

/// Bounds Embree's build too, which runs on the same library.
class ThreadLimit {
 public:
    explicit ThreadLimit(unsigned threads) {
        if (threads > 0) limit_.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }

 private:
    std::optional<tbb::global_control> limit_;
};

mir::Registry::Choice choice_of(const mir::RenderSettings& settings) {
    mir::Registry registry;
    mir::add_all_to(registry);
    return registry.make_for(settings);
}

/// Renders alone where `team` is null, else as its lead.
int render_with(const RenderOptions& options, mir::PictureTeam* team) {
    RenderOptions o = settled(options);
    const std::string shard = o.shard ? choose_shard(o) : std::string();
    const OutputPaths paths = o.shard ? OutputPaths{} : choose_outputs(o);
    const mir::Image<mir::Rgb> reference = read_report_reference(o);
    std::optional<mir::Denoiser> denoiser;
    if (o.denoise) denoiser.emplace(o.denoiser, o.settings.threads);
    const ThreadLimit threads(o.settings.threads);
    SceneAndReport loaded = load_scene(o.scene, o.settings.limits, o.environment);
    blaming(o.scene, [&] { prepare(o, loaded); });
    check_report_reference(o, reference);
    // Also while files are written, since a signal that ended the program there would leave halves.
    mir::Monitor monitor;
    const CancelOnInterrupt cancel(monitor);
    mir::Registry::Choice choice = choice_of(o.settings);
    std::optional<BandJournal> bands;
    if (team != nullptr && o.passes.resume) {
        bands.emplace(paths.exr + ".bands", o.passes.save_every.value_or(default_save_every));
        team->keep_in(*bands);
    }
    if (team != nullptr)
        choice.renderer = std::make_unique<TeamRenderer>(*team, std::move(choice.renderer));
    if (o.shard)
        return blaming(o.scene, [&] { return render_shard(shard, choice, o, loaded, monitor); });
    Convergence convergence(reference);
    mir::RenderResult result = blaming(
        o.scene, [&] { return render(choice, o, loaded.scene, paths, monitor, convergence); });
    const std::vector<std::string>& remarks = loaded.report.remarks;
    result.warnings.insert(result.warnings.begin(), remarks.begin(), remarks.end());
    const Denoising denoising = denoised(denoiser, result, reference, o, monitor);
    write_outputs(paths, result, o);
    if (bands && result.statistics.complete) bands->remove();
    write_render_report({o, loaded, result, reference, convergence});
    if (!o.quiet) print_summary(result, o.settings);
    if (!o.quiet) print(denoising);
    if (o.json) {
        print_json(paths, result, o, convergence, denoising);
    } else {
        for (const std::string& name : {paths.exr, paths.png, o.report, o.vpls_out})
            if (!name.empty()) print_result(name);
    }
    return ending(o, result, denoising);
}

/// Renders what the lead deals.
int work_for(mir::PictureTeam& team, const RenderOptions& options) {
    RenderOptions o = settled(options);
    o.quiet = true;
    const ThreadLimit threads(o.settings.threads);
    SceneAndReport loaded = load_scene(o.scene, o.settings.limits, o.environment);
    blaming(o.scene, [&] { prepare(o, loaded); });
    mir::Monitor monitor;
    const CancelOnInterrupt cancel(monitor);
    const mir::Registry::Choice choice = choice_of(o.settings);
    team.work(*choice.renderer, loaded.scene, o.settings, &monitor);
    return exit_done;
}

}  // namespace

int run(const RenderOptions& options) { return render_with(options, nullptr); }

int run_in_team(const RenderOptions& options, mir::PictureTeam& team) {
    mir::expects(!options.shard,
                 "a shard was asked of several processes (they share out the whole picture); leave "
                 "--shard out, or render shards with mir");
    return team.is_lead() ? render_with(options, &team) : work_for(team, options);
}

}  // namespace mirtool
