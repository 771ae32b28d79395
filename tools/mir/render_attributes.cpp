// SPDX-License-Identifier: MIT
#include "render_attributes.hpp"

#include "mir/film/filter.hpp"
#include "mir/version.hpp"
#include "render_facts.hpp"

#include <algorithm>

namespace mirtool {
namespace {

bool names(const RenderOptions& o, const char* layer) {
    return std::find(o.layers.begin(), o.layers.end(), layer) != o.layers.end();
}

/// By its own name or among all those that cost a render nothing.
bool wants(const RenderOptions& o, const char* layer) { return names(o, layer) || names(o, "all"); }

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
    if (s.direct_noise) add("mir:direct_noise", *s.direct_noise);
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

}  // namespace

std::vector<mir::ExrLayer> layers_of(const mir::RenderResult& r, const RenderOptions& o) {
    using mir::ExrPrecision;
    std::vector<mir::ExrLayer> layers{
        {"", &r.beauty}, {"", &r.coverage, ExrPrecision::single, mir::ExrScalar::alpha}};
    if (wants(o, "albedo")) layers.push_back({"albedo", &r.guides.albedo, ExrPrecision::half});
    if (wants(o, "normal")) layers.push_back({"normal", &r.guides.normal, ExrPrecision::half});
    if (wants(o, "position")) layers.push_back({"position", &r.guides.position});
    if (wants(o, "depth")) layers.push_back({"depth", &r.guides.depth});
    if (wants(o, "direct")) layers.push_back({"direct", &r.direct});
    if (wants(o, "indirect")) layers.push_back({"indirect", &r.indirect});
    if (wants(o, "emission")) layers.push_back({"emission", &r.emission});
    if (names(o, "removed")) layers.push_back({"removed", &r.removed});
    if (names(o, "pick_error"))
        layers.push_back(
            {"pick_error", &r.pick_error, ExrPrecision::single, mir::ExrScalar::luminance});
    if (!r.denoised.pixels().empty()) layers.push_back({"denoised", &r.denoised});
    for (std::size_t i = 0; i < r.bounces.size(); ++i)
        layers.push_back({"bounce" + std::to_string(i + 1), &r.bounces[i]});
    return layers;
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
    if (!r.denoiser.empty()) all.push_back({"mir:denoiser", r.denoiser});
    if (s.origin != mir::DVec3(0.0)) all.push_back({"mir:origin", s.origin});
    append_missing_attributes(s, all);
    append_pass_attributes(s, all);
    append_chain_attributes(s, all);
    if (o.record_seconds) all.push_back({"mir:seconds", static_cast<float>(s.seconds.total)});
    return all;
}

}  // namespace mirtool
