// SPDX-License-Identifier: MIT
#include "render_output.hpp"

#include "load_scene.hpp"
#include "mir/compare/tile_luminances.hpp"
#include "mir/io/exr.hpp"
#include "mir/io/vpl_glb.hpp"
#include "mir/io/vpl_ply.hpp"
#include "mir/version.hpp"
#include "output_places.hpp"

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace mirtool {
namespace {

using Json = nlohmann::ordered_json;

bool wants(const RenderOptions& o, const char* layer) {
    return std::find(o.layers.begin(), o.layers.end(), layer) != o.layers.end();
}

std::vector<mir::ExrLayer> layers_of(const mir::RenderResult& r, const RenderOptions& o) {
    using mir::ExrPrecision;
    std::vector<mir::ExrLayer> layers{{"", &r.beauty}};
    if (wants(o, "albedo")) layers.push_back({"albedo", &r.guides.albedo, ExrPrecision::half});
    if (wants(o, "normal")) layers.push_back({"normal", &r.guides.normal, ExrPrecision::half});
    if (wants(o, "position")) layers.push_back({"position", &r.guides.position});
    if (wants(o, "depth")) layers.push_back({"depth", &r.guides.depth});
    if (wants(o, "direct")) layers.push_back({"direct", &r.direct});
    if (wants(o, "indirect")) layers.push_back({"indirect", &r.indirect});
    if (wants(o, "emission")) layers.push_back({"emission", &r.emission});
    if (wants(o, "removed")) layers.push_back({"removed", &r.removed});
    for (std::size_t i = 0; i < r.bounces.size(); ++i)
        layers.push_back({"bounce" + std::to_string(i + 1), &r.bounces[i]});
    return layers;
}

/// What Markov chains say about themselves.
void append_chain_attributes(const mir::RenderStatistics& s, mir::ExrAttributes& all) {
    if (!s.health) return;
    const mir::ChainHealth& h = *s.health;
    const auto add = [&](const char* name, double value) {
        all.push_back({name, static_cast<float>(value)});
    };
    all.push_back({"mir:normalisation", s.normalisation});
    all.push_back({"mir:states", std::to_string(h.recorded_states)});
    add("mir:path_luminance", h.luminance.mean);
    add("mir:path_luminance_error", h.luminance.standard_error);
    add("mir:large_step_luminance", h.large_step_luminance.mean);
    add("mir:acceptance_large", h.large.rate());
    add("mir:acceptance_small", h.small.rate());
    add("mir:acceptance_bidirectional", h.bidirectional.rate());
    add("mir:acceptance_suffix", h.suffix.rate());
    add("mir:effective_samples", h.effective_samples);
    add("mir:split_r_hat", h.split_r_hat);
    add("mir:dropped_share", s.dropped_share);
}

/// What the VPLs' light lacks, as far as it was measured.
void append_missing_attributes(const mir::RenderStatistics& s, mir::ExrAttributes& all) {
    const auto add = [&](const char* name, double value) {
        all.push_back({name, static_cast<float>(value)});
    };
    add("mir:removed_share", s.removed_share());
    if (s.removed) add("mir:removed_share_error", s.removed->standard_error);
    if (s.cut) add("mir:cut_share", s.cut->share);
    if (s.cut) add("mir:cut_share_error", s.cut->standard_error);
    if (!s.gather_difference) return;
    add("mir:gather_difference", s.gather_difference->mean);
    add("mir:gather_difference_error", s.gather_difference->standard_error);
    add("mir:gather_difference_spread", s.gather_difference->spread);
}

void append_pass_attributes(const mir::RenderStatistics& s, mir::ExrAttributes& all) {
    all.push_back({"mir:passes", static_cast<int>(s.passes)});
    all.push_back({"mir:complete", s.complete ? 1 : 0});
    if (s.relative_error)
        all.push_back({"mir:relative_error", static_cast<float>(*s.relative_error)});
}

mir::ExrAttributes attributes_of(const mir::RenderResult& r, const RenderOptions& o) {
    const mir::RenderStatistics& s = r.statistics;
    mir::ExrAttributes all{
        {"mir:version", std::string(mir::version)},
        {"mir:scene_hash", s.scene_hash},
        {"mir:seed", std::to_string(o.settings.seed)},
        {"mir:sampler", std::string(sampler_name(o.settings))},
        {"mir:filter", std::string(to_string(o.settings.filter.kind))},
        {"mir:vpls", static_cast<int>(s.vpls)},
        {"mir:light_paths", std::to_string(s.light_paths)},
        {"mir:luxels_per_pixel", static_cast<int>(o.settings.luxels_per_pixel)},
        {"mir:contributions", std::to_string(s.contributions)},
        {"mir:bound", s.bound},
    };
    if (s.origin != mir::DVec3(0.0)) all.push_back({"mir:origin", s.origin});
    append_missing_attributes(s, all);
    append_pass_attributes(s, all);
    append_chain_attributes(s, all);
    if (o.record_seconds) all.push_back({"mir:seconds", static_cast<float>(s.seconds.total)});
    return all;
}

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
    if (!s.gather_difference) return;
    const mir::LightDifference& d = *s.gather_difference;
    out["gather_difference"] = {{"mean", d.mean},
                                {"standard_error", d.standard_error},
                                {"spread", d.spread},
                                {"corrected", s.gather_corrected}};
}

/// True when both names lead to the same place; an empty name leads nowhere.
bool are_one_file(const std::string& a, const std::string& b) {
    const auto place = [](const std::string& name) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(name));
    };
    return !a.empty() && !b.empty() && place(a) == place(b);
}

/// What Metropolis sampling came to: draws of the bootstrap alone, or chains that mutate.
void print_chains(const mir::ChainHealth& h) {
    const auto states = static_cast<unsigned long long>(h.recorded_states);
    if (h.mutations == 0) {
        std::fprintf(stderr,
                     "mir: Metropolis: %llu independent starts drawn from %llu paths, no mutation "
                     "needed\n",
                     states, static_cast<unsigned long long>(h.luminance.paths));
        return;
    }
    std::fprintf(
        stderr,
        "mir: Metropolis: %llu chains, %llu mutations (%.0f %% of the large and %.0f %% of "
        "the other steps accepted), %llu states recorded\n",
        static_cast<unsigned long long>(h.chains), static_cast<unsigned long long>(h.mutations),
        100.0 * h.large.rate(), 100.0 * (h.small.proposed > 0 ? h.small : h.bidirectional).rate(),
        states);
}

void print_health(const mir::ChainHealth& h) {
    print_chains(h);
    std::fprintf(stderr, "mir: P_c %.4g +- %.2g from %llu paths; %llu states worth %.0f",
                 h.luminance.mean, h.luminance.standard_error,
                 static_cast<unsigned long long>(h.luminance.paths),
                 static_cast<unsigned long long>(h.recorded_states), h.effective_samples);
    // Chains that record once say nothing about how they mix.
    if (std::isfinite(h.split_r_hat)) std::fprintf(stderr, ", R-hat %.2f", h.split_r_hat);
    std::fprintf(stderr, "\n");
}

/// "1.2 +- 0.3 % by the bound", three digits of what is small.
std::string missing_text(const mir::ShareEstimate& e, const char* by) {
    char text[96];
    std::snprintf(text, sizeof text, "%.3g +- %.1g %% %s", 100.0 * e.share,
                  100.0 * e.standard_error, by);
    return text;
}

void print_missing(const mir::RenderStatistics& s) {
    if (const auto& d = s.gather_difference)
        std::fprintf(stderr,
                     "mir: light of discs against paths: %+.3g +- %.1g %%, spread %.3g %%\n",
                     100.0 * d->mean, 100.0 * d->standard_error, 100.0 * d->spread);
    if (!s.removed || !s.cut) return;
    std::fprintf(stderr, "mir: missing of the VPLs' light: %s, %s\n",
                 missing_text(*s.removed, "by the bound").c_str(),
                 missing_text(*s.cut, "by the largest number of reflections").c_str());
}

/// Where the bound removed light: 256 tiles at most.
Json tiles_of(const mir::Image<mir::Rgb>& removed) {
    const mir::TileLuminances t = mir::tile_luminances(removed, 16);
    return {{"side", t.side},
            {"columns", t.tiles.width},
            {"rows", t.tiles.height},
            {"luminance", t.mean}};
}

/// "sampling 0.28, gbuffer 0.37": the stages that can be seen in hundredths of a second.
std::string stages_of(const mir::StageSeconds& seconds) {
    std::string text;
    for (const mir::RenderStage& stage : mir::render_stages) {
        if (seconds.*stage.seconds < 0.005) continue;
        char took[32];
        std::snprintf(took, sizeof took, " %.2f", seconds.*stage.seconds);
        text += (text.empty() ? "" : ", ") + std::string(stage.name) + took;
    }
    return text.empty() ? "no stage took 0.01 s" : text;
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

std::uint64_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

OutputPaths choose_outputs(const RenderOptions& o) {
    OutputPaths paths{o.output.empty() ? stem_of(o.scene) + ".exr" : o.output, o.preview};
    mir::expects(paths.exr != "-", "a picture cannot be written to standard output; name a file");
    if (paths.png.empty() && !o.no_preview)
        paths.png = std::filesystem::path(paths.exr).replace_extension(".png").string();
    if (o.no_preview) paths.png.clear();
    mir::expects(!are_one_file(paths.png, paths.exr),
                 "picture and preview have the same name; let the picture end in .exr");
    mir::expects(!are_one_file(o.scene, paths.exr) && !are_one_file(o.scene, paths.png),
                 "the picture would replace the scene that it shows; give another name with -o");
    mir::expects(o.vpls_out.empty() || o.settings.integrator == mir::Integrator::vpl,
                 "this integrator places no VPLs (there would be none to write); leave --vpls-out "
                 "out or use --integrator vpl");
    check_output_places({o.scene, o.environment.file, o.report_reference},
                        {paths.exr, paths.png, o.report, o.vpls_out}, "render");
    return paths;
}

mir::PreviewLook preview_look(const RenderOptions& o, const mir::Image<mir::Rgb>& picture) {
    const auto automatic = [&] {
        return o.tone == mir::ToneCurve::none ? mir::auto_exposure(picture)
                                              : mir::tone_exposure(picture);
    };
    return {o.exposure ? *o.exposure : automatic(), o.tone, true};
}

void write_outputs(const OutputPaths& paths, const mir::RenderResult& r, const RenderOptions& o) {
    mir::write_exr(paths.exr, r.beauty.extent(), layers_of(r, o), attributes_of(r, o));
    if (!paths.png.empty()) mir::write_png(paths.png, r.beauty, preview_look(o, r.beauty));
    if (o.vpls_out.ends_with(".glb")) mir::write_vpls_glb(o.vpls_out, r.vpls, r.statistics.origin);
    if (o.vpls_out.ends_with(".ply")) mir::write_vpls_ply(o.vpls_out, r.vpls, r.statistics.origin);
}

void print_summary(const mir::RenderResult& r) {
    const mir::RenderStatistics& s = r.statistics;
    if (s.relative_error)
        std::fprintf(stderr, "mir: %u passes, relative error %.2g %%\n", s.passes,
                     100.0 * *s.relative_error);
    std::fprintf(stderr, "mir: %llu triangles, %llu luxels",
                 static_cast<unsigned long long>(s.triangles),
                 static_cast<unsigned long long>(s.luxels));
    if (s.vpls > 0)
        std::fprintf(stderr, ", %u VPLs from %llu light paths, %s", s.vpls,
                     static_cast<unsigned long long>(s.light_paths), s.scheduler.c_str());
    std::fprintf(stderr, "\nmir: %.2f s (%s)", s.seconds.total, stages_of(s.seconds).c_str());
    if (s.vpls > 0)
        std::fprintf(stderr, ", %.1f M contributions/s", 1e-6 * contributions_per_second(s));
    std::fputc('\n', stderr);
    if (s.health) print_health(*s.health);
    print_missing(s);
    for (const std::string& warning : r.warnings)
        std::fprintf(stderr, "mir: warning: %s\n", warning.c_str());
}

void print_json(const OutputPaths& paths, const mir::RenderResult& r, const RenderOptions& o,
                const Convergence& convergence) {
    const mir::RenderStatistics& s = r.statistics;
    Json out{{"version", mir::version},
             {"scene", o.scene},
             {"scene_hash", s.scene_hash},
             {"picture", paths.exr}};
    if (!paths.png.empty()) out["preview"] = paths.png;
    if (!o.report.empty()) out["report"] = o.report;
    if (!o.vpls_out.empty()) out["vpl_file"] = o.vpls_out;
    if (!o.environment.file.empty())
        out["environment"] = {{"file", o.environment.file},
                              {"scale", o.environment.scale},
                              {"rotation", o.environment.rotation}};
    if (s.origin != mir::DVec3(0.0)) out["origin"] = {s.origin.x, s.origin.y, s.origin.z};
    out["width"] = r.beauty.width();
    out["height"] = r.beauty.height();
    out["seed"] = o.settings.seed;
    out["sampler"] = sampler_name(o.settings);
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
    if (!convergence.points().empty()) out["convergence"] = points_of(convergence);
    out["luxels"] = s.luxels;
    out["light_paths"] = s.light_paths;
    out["camera_paths"] = s.camera_paths;
    out["vpls"] = s.vpls;
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
    out["bound"] = s.bound;
    add_missing(out, s);
    out["removed_luminance"] = s.removed_luminance;
    if (!r.removed.pixels().empty()) out["removed_tiles"] = tiles_of(r.removed);
    out["vsl_radius"] = s.vsl_radius;
    out["residual_paths"] = s.residual_paths;
    out["residual_luminance"] = s.residual_luminance;
    out["mean_radiance"] = {{"beauty", mean_of(r.beauty)},
                            {"emission", mean_of(r.emission)},
                            {"direct", mean_of(r.direct)},
                            {"indirect", mean_of(r.indirect)}};
    out["seconds"] = seconds_of(s.seconds);
    out["peak_memory_bytes"] = peak_memory_bytes();
    out["warnings"] = r.warnings;
    std::printf("%s\n", out.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace mirtool
