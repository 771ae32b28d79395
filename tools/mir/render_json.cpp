// SPDX-License-Identifier: MIT
#include "mir/version.hpp"
#include "render_facts.hpp"
#include "render_output.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace mirtool {
namespace {

using Json = nlohmann::ordered_json;

Json points_of(const Convergence& convergence) {
    const auto known = [](std::optional<double> error) { return error ? Json(*error) : Json(); };
    Json out = Json::array();
    for (const ConvergencePoint& p : convergence.points())
        out.push_back({{"passes", p.passes},
                       {"vpls", p.vpls},
                       {"seconds", p.seconds},
                       {"relative_error", known(p.spread_error)},
                       {"reference_error", known(p.reference_error)}});
    return out;
}

}  // namespace

void print_json(const OutputPaths& paths, const mir::RenderResult& r, const RenderOptions& o,
                const Convergence& convergence, const Denoising& denoising) {
    Json out{{"version", mir::version},
             {"scene", o.scene},
             {"scene_hash", r.statistics.scene_hash},
             {"picture", paths.exr}};
    if (!paths.png.empty()) out["preview"] = paths.png;
    if (!o.report.empty()) out["report"] = o.report;
    if (!o.vpls_out.empty()) out["vpl_file"] = o.vpls_out;
    if (!o.environment.file.empty())
        out["environment"] = {{"file", o.environment.file},
                              {"scale", o.environment.scale},
                              {"rotation", o.environment.rotation}};
    add_facts(out, r, o.settings);
    if (!convergence.points().empty()) out["convergence"] = points_of(convergence);
    if (!denoising.denoiser.empty()) out["denoised"] = json_of(denoising);
    out["peak_memory_bytes"] = peak_memory_bytes();
    out["warnings"] = r.warnings;
    std::printf("%s\n", out.dump(2, ' ', true, Json::error_handler_t::replace).c_str());
}

}  // namespace mirtool
