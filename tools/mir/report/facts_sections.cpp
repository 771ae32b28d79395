// SPDX-License-Identifier: MIT
#include "mir/compare/comparable.hpp"
#include "mir/film/filter.hpp"
#include "mir/io/html_page.hpp"
#include "render_facts.hpp"
#include "render_output.hpp"
#include "report/sections.hpp"
#include "text.hpp"

#include <optional>
#include <vector>

namespace mirtool {
namespace {

using FactRows = std::vector<std::vector<std::string>>;

/// " ± 0.3 %", where it is known.
std::string error_of(const std::optional<mir::ShareEstimate>& share) {
    return share ? " ± " + percent(share->standard_error) : "";
}

std::string bound_text(const mir::RenderSettings& s, const mir::RenderStatistics& statistics) {
    if (s.bound.kind == mir::BoundPolicy::Kind::none) return "none";
    const char* how = s.bound.kind == mir::BoundPolicy::Kind::automatic ? " (automatic)" : "";
    const std::string traced =
        s.compensate > 0
            ? ", traced back by " + std::to_string(s.compensate_per_luxel()) + " paths per luxel"
            : "";
    return number(statistics.bound) + " per m²" + how + ", removed " +
           percent(statistics.removed_share()) + error_of(statistics.removed) +
           " of the VPLs' light" + traced;
}

void add_vpl_settings(FactRows& rows, const mir::RenderSettings& s,
                      const mir::RenderStatistics& statistics) {
    rows.push_back({"VPLs", std::to_string(statistics.vpls) + " placed, " + std::to_string(s.vpls) +
                                " wanted"});
    rows.push_back({"direct light", s.direct == mir::DirectLight::vpl
                                        ? "by VPLs on lamps and at infinity"
                                        : "by lamp samples"});
    if (s.vsl.enabled)
        rows.push_back({"spheres", "mean radius " + number(statistics.vsl_radius) + " m"});
    else
        rows.push_back({"bound", bound_text(s, statistics)});
    if (s.glossy.enabled)
        rows.push_back({"lobes of VPLs", "kept down to roughness " +
                                             number(double(s.glossy.least_roughness)) + ", " +
                                             percent(double(statistics.widened_share)) +
                                             " of the VPLs' light through widened ones"});
    rows.push_back({"normalisation", statistics.normalisation});
    if (s.sampler == mir::SamplerKind::metropolis)
        rows.push_back({"stride", std::to_string(s.metropolis.stride) + " mutations"});
}

void add_micro_settings(FactRows& rows, const mir::RenderStatistics& s) {
    rows.push_back({"discs", std::to_string(s.surfels) + ", lit as " + std::to_string(s.patches) +
                                 " patches"});
    if (!s.gather_difference) return;
    rows.push_back({"light of discs against paths, in the mean",
                    percent(s.gather_difference->mean) + " ± " +
                        percent(s.gather_difference->standard_error) +
                        (s.gather_corrected ? ", corrected" : "")});
    rows.push_back({"and its spread over luxels", percent(s.gather_difference->spread)});
}

void add_passes(FactRows& rows, const mir::RenderStatistics& s) {
    if (!s.relative_error) return;
    rows.push_back({"passes", std::to_string(s.passes) + (s.complete ? "" : ", interrupted")});
    rows.push_back({"relative error, from their spread", percent(*s.relative_error)});
}

std::string bounce_text(const mir::RenderSettings& s, const mir::RenderStatistics& statistics) {
    if (s.integrator == mir::Integrator::path && !s.max_bounce) return "none";
    std::string limit = std::to_string(s.bounce_limit());
    if (!statistics.cut) return limit;
    return limit + ", cuts " + percent(statistics.cut->share) + error_of(statistics.cut) +
           " of the VPLs' light";
}

std::string machine_text(const mir::RenderStatistics& s) {
    return s.backend + (s.device.empty() ? "" : " (" + s.device + ")");
}

/// "2 point lights, 0 spot lights, ..."
std::string listed_lights(const mir::SceneReport& r) {
    std::string text;
    for (std::size_t i = 0; i < r.listed_lights.size(); ++i)
        text += (i == 0 ? "" : ", ") + std::to_string(r.listed_lights[i]) + " " +
                mir::ListedLights::names[i] + "s";
    return text;
}

}  // namespace

std::string settings_section(const ReportInput& in) {
    const mir::RenderSettings& s = in.options.settings;
    const mir::RenderStatistics& statistics = in.result.statistics;
    const std::string& camera = in.loaded.scene.cameras[s.camera].name;
    FactRows rows{{"size", mir::detail::size_text(s.image) + " pixels"},
                  {"luxels per pixel", std::to_string(s.luxels_per_pixel)},
                  {"camera", camera.empty() ? std::to_string(s.camera) : camera},
                  {"filter", std::string(to_string(s.filter.kind))},
                  {"sampler", sampler_name(s)}};
    if (s.integrator == mir::Integrator::vpl) add_vpl_settings(rows, s, statistics);
    if (s.integrator == mir::Integrator::path)
        rows.push_back({"camera paths per luxel", std::to_string(s.path.samples)});
    if (s.integrator == mir::Integrator::micro) add_micro_settings(rows, statistics);
    add_passes(rows, statistics);
    rows.insert(rows.end(),
                {{"lamp samples per pixel", std::to_string(s.direct_samples)},
                 {"largest bounce", bounce_text(s, statistics)},
                 {"seed", std::to_string(s.seed)},
                 {"machine", machine_text(statistics)},
                 {"acceleration structure", statistics.acceleration},
                 {"scheduler", statistics.scheduler},
                 {"threads", s.threads == 0 ? "every core" : std::to_string(s.threads)},
                 {"contributions per second", number(contributions_per_second(statistics))},
                 {"peak memory", number(1e-6 * static_cast<double>(peak_memory_bytes())) + " MB"}});
    return "<h2>Settings</h2>\n" + mir::detail::html_table({"How it was rendered", {}, rows});
}

std::string scene_section(const ReportInput& in) {
    const mir::SceneReport& r = in.loaded.report;
    const mir::RenderStatistics& s = in.result.statistics;
    FactRows rows{
        {"file", in.options.scene},
        {"fingerprint", s.scene_hash},
        {"triangles", std::to_string(s.triangles) + ", " + std::to_string(r.emitting_triangles) +
                          " of them emit"},
        {"triangles without area", std::to_string(s.dropped_triangles) + " left out"},
        {"triangles in one place with a lamp", std::to_string(s.coinciding_triangles)},
        {"meshes", std::to_string(r.meshes) + ", placed " + std::to_string(r.instances) + " times"},
        {"materials", std::to_string(r.materials) + ", " + std::to_string(r.emitting_materials) +
                          " of them emit"},
        {"lights", listed_lights(r) + (in.options.environment.file.empty()
                                           ? ""
                                           : ", around them " + in.options.environment.file)},
        {"emitted power", number(s.emitted_power) + " W (luminance)"}};
    const mir::DVec3 origin = in.loaded.scene.origin;
    if (origin != mir::DVec3(0.0)) rows.push_back({"origin of positions", place(origin) + " m"});
    for (const auto& [what, times] : r.ignored)
        rows.push_back({"ignored", ignored_text(what, times)});
    for (const std::string& note : r.notes) rows.push_back({"note", note});
    return "<h2>Scene</h2>\n" + mir::detail::html_table({"What the scene holds", {}, rows});
}

}  // namespace mirtool
