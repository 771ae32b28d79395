// SPDX-License-Identifier: MIT
#include "render_passes.hpp"

#include "alarm.hpp"
#include "mir/io/pass_journal.hpp"
#include "mir/runtime/progressive_render.hpp"

namespace mirtool {
namespace {

/// The journal of --resume.
std::optional<mir::PassJournal> open_journal(const RenderOptions& o, const mir::Scene& scene,
                                             const OutputPaths& paths) {
    if (!o.passes.resume) return std::nullopt;
    return mir::PassJournal(journal_of(o, paths), scene, o.settings);
}

/// The same bits as one pass, without memory for sums.
mir::RenderResult render_once(const mir::Renderer& renderer, const mir::Scene& scene,
                              const RenderOptions& o, mir::Monitor& monitor) {
    mir::RenderResult result = renderer.render(scene, o.settings, &monitor);
    monitor.check();
    return result;
}

}  // namespace

mir::RenderResult render_passes(const mir::Renderer& renderer, const mir::Scene& scene,
                                const RenderOptions& o, const OutputPaths& paths,
                                mir::Monitor& monitor, Convergence& convergence) {
    const mir::PassGoal goal = goal_of(o.passes);
    if (goal.passes == 1 && !o.passes.resume) return render_once(renderer, scene, o, monitor);
    const std::optional<mir::PassJournal> journal = open_journal(o, scene, paths);
    mir::ProgressiveRender render(renderer, scene, o.settings, goal, &monitor,
                                  journal ? journal->read() : mir::PassSums());
    const auto keep = [&] {
        if (journal) journal->write(render.sums());
    };
    convergence.look_at(render.sums(), render.is_complete());
    Alarm save(o.passes.save_every.value_or(default_save_every));
    try {
        while (!render.is_complete()) {
            render.next_pass();
            convergence.look_at(render.sums(), render.is_complete());
            if (render.is_complete() || !save.rings()) continue;
            keep();
            write_outputs(paths, render.result(), o);
        }
    } catch (const mir::Error& e) {
        if (e.code() != mir::ErrorCode::cancelled || render.sums().passes() == 0) throw;
        convergence.look_at(render.sums(), true);
    }
    if (goal.passes == 1) monitor.check();
    keep();
    return render.result();
}

}  // namespace mirtool
