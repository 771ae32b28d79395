// SPDX-License-Identifier: MIT
#include "render_facts.hpp"

#include "mir/compare/tile_luminances.hpp"
#include "mir/runtime/light_budget.hpp"

#include <nlohmann/json.hpp>

namespace mirtool {
namespace {

using Json = nlohmann::ordered_json;

Json seconds_of(const mir::StageSeconds& t) {
    Json out;
    for (const mir::RenderStage& stage : mir::render_stages)
        out[std::string(stage.name)] = t.*stage.seconds;
    out["total"] = t.total;
    return out;
}

Json count_of(const mir::MutationCount& m) {
    return {{"proposed", m.proposed}, {"accepted", m.accepted}, {"rate", m.rate()}};
}

Json luminance_of(const mir::PathLuminance& p) {
    return {{"mean", p.mean},   {"standard_error", p.standard_error},
            {"low", p.low()},   {"high", p.high()},
            {"paths", p.paths}, {"contributing", p.contributing}};
}

Json health_of(const mir::ChainHealth& h) {
    return {{"chains", h.chains},
            {"mutations", h.mutations},
            {"recorded_states", h.recorded_states},
            {"distinct_vpls", h.distinct_vpls},
            {"large", count_of(h.large)},
            {"small", count_of(h.small)},
            {"bidirectional", count_of(h.bidirectional)},
            {"suffix", count_of(h.suffix)},
            {"longest_stay", h.longest_stay},
            {"effective_samples", h.effective_samples},
            {"split_r_hat", h.split_r_hat},
            {"path_luminance", luminance_of(h.luminance)},
            {"large_step_luminance", luminance_of(h.large_step_luminance)},
            {"capped", h.capped}};
}

Json mean_of(const mir::Image<mir::Rgb>& image) {
    double r = 0.0;
    double g = 0.0;
    double b = 0.0;
    for (const mir::Rgb& p : image.pixels()) {
        r += p.r;
        g += p.g;
        b += p.b;
    }
    const auto n = static_cast<double>(image.pixels().size());
    return {r / n, g / n, b / n};
}

void add_missing(Json& out, const mir::RenderStatistics& s) {
    out["removed_share"] = s.removed_share();
    out["removed_share_error"] = s.removed ? Json(s.removed->standard_error) : Json();
    out["cut_share"] = s.cut ? Json(s.cut->share) : Json();
    out["cut_share_error"] = s.cut ? Json(s.cut->standard_error) : Json();
    out["direct_noise"] = s.direct_noise ? Json(*s.direct_noise) : Json();
    if (!s.gather_difference) return;
    const mir::LightDifference& d = *s.gather_difference;
    out["gather_difference"] = {{"mean", d.mean},
                                {"standard_error", d.standard_error},
                                {"spread", d.spread},
                                {"corrected", s.gather_corrected}};
}

/// The classes of the picture's light.
Json budget_of(const mir::RenderResult& r, const mir::RenderSettings& settings) {
    Json out = Json::array();
    for (const mir::LightClass& c : mir::light_budget(r, settings)) {
        Json missing = Json::array();
        for (const mir::MissingLight& m : c.missing)
            missing.push_back({{"by", m.why},
                               {"share", m.share.share},
                               {"standard_error", m.share.standard_error}});
        out.push_back({{"light", c.light},
                       {"brought_by", c.brought_by},
                       {"share", c.share},
                       {"standard_error", c.standard_error ? Json(*c.standard_error) : Json()},
                       {"missing", missing}});
    }
    return out;
}

/// Where the bound removed light: 256 tiles at most.
Json tiles_of(const mir::Image<mir::Rgb>& removed) {
    const mir::TileLuminances t = mir::tile_luminances(removed, 16);
    return {{"side", t.side},
            {"columns", t.tiles.width},
            {"rows", t.tiles.height},
            {"luminance", t.mean}};
}

}  // namespace

const char* sampler_name(const mir::RenderSettings& s) {
    if (s.integrator == mir::Integrator::path) return "path";
    if (s.integrator == mir::Integrator::micro) return "micro";
    if (s.sampler == mir::SamplerKind::metropolis) return "mir";
    if (s.sampler == mir::SamplerKind::bidirectional) return "bir";
    if (s.vpl_roulette) return "roulette";
    return s.termination == mir::Termination::roulette ? "ir" : "keller";
}

double contributions_per_second(const mir::RenderStatistics& s) {
    const mir::StageSeconds& t = s.seconds;
    const double seconds = t.visibility + t.response + t.reconstruction;
    return seconds > 0.0 ? static_cast<double>(s.contributions) / seconds : 0.0;
}

void add_facts(Json& out, const mir::RenderResult& r, const mir::RenderSettings& settings) {
    const mir::RenderStatistics& s = r.statistics;
    if (s.origin != mir::DVec3(0.0)) out["origin"] = {s.origin.x, s.origin.y, s.origin.z};
    out["width"] = r.beauty.width();
    out["height"] = r.beauty.height();
    out["seed"] = settings.seed;
    out["sampler"] = sampler_name(settings);
    out["backend"] = s.backend;
    if (!s.device.empty()) out["device"] = s.device;
    out["acceleration"] = s.acceleration;
    out["scheduler"] = s.scheduler;
    out["triangles"] = s.triangles;
    out["dropped_triangles"] = s.dropped_triangles;
    out["coinciding_triangles"] = s.coinciding_triangles;
    out["passes"] = s.passes;
    out["complete"] = s.complete;
    out["relative_error"] = s.relative_error ? Json(*s.relative_error) : Json();
    out["luxels"] = s.luxels;
    out["light_paths"] = s.light_paths;
    out["camera_paths"] = s.camera_paths;
    out["vpls"] = s.vpls;
    out["picks"] = settings.wants_cuts() ? settings.picks : 0;
    out["surfels"] = s.surfels;
    out["patches"] = s.patches;
    out["contributions"] = s.contributions;
    out["contributions_per_second"] = contributions_per_second(s);
    out["emitted_power"] = s.emitted_power;
    out["non_lambertian_share"] = s.non_lambertian_share;
    out["widened_share"] = s.widened_share;
    out["normalisation"] = s.normalisation;
    out["path_luminance"] = s.path_luminance;
    out["states"] = s.states;
    out["dropped_share"] = s.dropped_share;
    out["indirect_luminance"] = s.indirect_luminance;
    if (s.health) out["chains"] = health_of(*s.health);
    if (s.light_path_luminance) out["light_path_luminance"] = luminance_of(*s.light_path_luminance);
    out["bound"] = s.bound;
    add_missing(out, s);
    out["removed_luminance"] = s.removed_luminance;
    if (!r.removed.pixels().empty()) out["removed_tiles"] = tiles_of(r.removed);
    out["vsl_radius"] = s.vsl_radius;
    out["residual_paths"] = s.residual_paths;
    out["residual_luminance"] = s.residual_luminance;
    out["caustic_paths"] = s.caustic_paths;
    out["caustic_luminance"] = s.caustic_luminance;
    out["light_budget"] = budget_of(r, settings);
    out["mean_radiance"] = {{"beauty", mean_of(r.beauty)},
                            {"emission", mean_of(r.emission)},
                            {"direct", mean_of(r.direct)},
                            {"indirect", mean_of(r.indirect)}};
    out["seconds"] = seconds_of(s.seconds);
}

}  // namespace mirtool
