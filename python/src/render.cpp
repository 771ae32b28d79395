// SPDX-License-Identifier: MIT
#include "render.hpp"

#include "errors.hpp"
#include "idle_options.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/runtime/progressive_render.hpp"
#include "mir/runtime/vpl_frame.hpp"
#include "pass_goal_of.hpp"
#include "team_renderer.hpp"
#include "vpls.hpp"
#include "watch.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <limits>
#include <optional>

namespace nb = nanobind;

namespace mirpy {

Job::Job(PyScene& scene, const std::vector<std::string>& words)
    : hold_(scene), options(mirtool::read_picture_words(words)) {
    options.settings.validate();
}

void Job::prepare() {
    const bool adds = !options.environment.file.empty() ||
                      mirtool::adds_to_scene(options, hold_.loaded()->report);
    loaded_ = adds ? std::make_shared<PyScene::Loaded>(*hold_.loaded()) : hold_.loaded();
    if (!options.environment.file.empty())
        mirtool::put_environment(*loaded_, options.environment, options.settings.limits);
    mirtool::prepare_scene(options, *loaded_);
}

namespace {

using Words = std::vector<std::string>;

/// The renderer that the settings choose.
mir::Registry::Choice renderer_for(const mir::RenderSettings& settings) {
    mir::Registry registry;
    mir::add_all_to(registry);
    return registry.make_for(settings);
}

/// Adds what else there is to say of a picture.
PyResult complete(const Job& job, const mir::Registry::Choice& choice, mir::RenderResult result) {
    auto& warnings = result.warnings;
    warnings.insert(warnings.begin(), choice.remarks.begin(), choice.remarks.end());
    mirtool::note_idle_options(job.options.settings, result);
    const auto& remarks = job.report().remarks;
    warnings.insert(warnings.begin(), remarks.begin(), remarks.end());
    return {std::move(result), job.options};
}

mir::RenderResult render_passes(const mir::Renderer& renderer, const Job& job,
                                const mir::PassGoal& goal, mir::Monitor& monitor) {
    if (goal.passes == 1) return renderer.render(job.scene(), job.options.settings, &monitor);
    mir::ProgressiveRender passes(renderer, job.scene(), job.options.settings, goal, &monitor);
    while (!passes.is_complete()) passes.next_pass();
    return passes.result();
}

std::unique_ptr<PyResult> render_now(Job& job, mir::Monitor& monitor, mir::PictureTeam* team) {
    job.prepare();
    mir::Registry::Choice choice = renderer_for(job.options.settings);
    if (team != nullptr && !team->is_lead()) {
        team->work(*choice.renderer, job.scene(), job.options.settings, &monitor);
        return nullptr;
    }
    if (team != nullptr)
        choice.renderer =
            std::make_unique<mirtool::TeamRenderer>(*team, std::move(choice.renderer));
    const mir::PassGoal goal = mirtool::goal_of(job.options.passes);
    mir::RenderResult result = render_passes(*choice.renderer, job, goal, monitor);
    monitor.check();
    return std::make_unique<PyResult>(complete(job, choice, std::move(result)));
}

std::unique_ptr<PyResult> render(PyScene& scene, const Words& words, nb::handle progress) {
    return render_watched(scene, words, progress, nullptr);
}

PyVpls sample_vpls(PyScene& scene, const Words& words, nb::handle progress) {
    Job job(scene, words);
    if (job.options.settings.integrator != mir::Integrator::vpl)
        throw ArgumentError("integrator", "this one places no VPLs; leave it out");
    mir::Monitor monitor;
    PyVpls vpls;
    watched(monitor, progress, [&] {
        job.prepare();
        mir::VplFrame frame(job.scene(), job.options.settings, &monitor);
        const float bound = frame.bound();
        vpls = vpls_of(frame.place_vpls(), bound);
        monitor.check();
    });
    return vpls;
}

/// Passes one by one.
class PyProgressive {
 public:
    PyProgressive(PyScene& scene, const Words& words) : job_(scene, words) {
        mirtool::PassOptions& o = job_.options.passes;
        if (!o.passes && !o.seconds && !o.relative_error) o.passes = mir::max_passes;
    }

    /// Renders one more pass, or returns false where the goal is reached.
    [[nodiscard]] bool next(nb::handle progress) {
        monitor_.cancelled = false;
        watched(monitor_, progress, [this] {
            if (!passes_) begin();
            ended_ = passes_->is_complete();
            if (!ended_) passes_->next_pass();
        });
        return !ended_;
    }
    [[nodiscard]] std::unique_ptr<PyResult> result() const {
        const nb::gil_scoped_release release;
        return std::make_unique<PyResult>(complete(job_, choice_, passes_->result()));
    }

 private:
    void begin() {
        job_.prepare();
        choice_ = renderer_for(job_.options.settings);
        passes_.emplace(*choice_.renderer, job_.scene(), job_.options.settings,
                        mirtool::goal_of(job_.options.passes), &monitor_);
    }

    Job job_;
    mir::Monitor monitor_;
    mir::Registry::Choice choice_;
    std::optional<mir::ProgressiveRender> passes_;
    bool ended_ = false;
};

nb::list devices() {
    nb::list all;
    for (const mir::DeviceReport& d : mir::list_devices().devices)
        all.append(nb::make_tuple(d.name, d.description));
    return all;
}

}  // namespace

std::unique_ptr<PyResult> render_watched(PyScene& scene, const Words& words, nb::handle progress,
                                         mir::PictureTeam* team) {
    Job job(scene, words);
    mir::Monitor monitor;
    std::unique_ptr<PyResult> result;
    watched(monitor, progress, [&] { result = render_now(job, monitor, team); });
    return result;
}

void bind_render(nb::module_& m) {
    m.def("_render", render, nb::arg("scene"), nb::arg("words"), nb::arg("progress").none());
    m.def("_sample_vpls", sample_vpls, nb::arg("scene"), nb::arg("words"),
          nb::arg("progress").none());
    nb::class_<PyProgressive>(m, "_Progressive")
        .def(nb::init<PyScene&, const Words&>())
        .def("next", &PyProgressive::next, nb::arg("progress").none())
        .def("result", &PyProgressive::result);
    m.def("devices", devices, "What can render on this machine: names and descriptions.");
}

}  // namespace mirpy
