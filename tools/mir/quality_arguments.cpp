// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "mir/runtime/quality.hpp"
#include "option_types.hpp"

#include <algorithm>
#include <memory>

namespace mirtool {
namespace {

bool is_given(const CLI::App& app, const std::string& option) { return app.count(option) > 0; }

/// Whether options ask for VPLs of another kind than a quality has, or for so few that each luxel
/// gathers all.
bool chooses_vpls(const CLI::App& app, const RenderOptions& o) {
    const mir::RenderSettings& s = o.settings;
    if (s.integrator != mir::Integrator::vpl || s.vsl.enabled || s.glossy.enabled) return true;
    if (std::find(o.layers.begin(), o.layers.end(), "removed") != o.layers.end()) return true;
    if (s.direct == mir::DirectLight::vpl) return true;  // each luxel asks all VPLs at infinity
    if (is_given(app, "--sampler") || s.sum == mir::LightSum::all) return true;
    if (is_given(app, "--vpls") && s.vpls <= mir::most_vpls_summed) return true;
    const auto options = app.get_options();
    return std::any_of(options.begin(), options.end(), [](const CLI::Option* option) {
        return option->count() > 0 && option->get_group() == group_of_chains;
    });
}

/// Whether a bound may take light that paths can bring.
bool can_trace_back(const mir::RenderSettings& s) {
    return s.integrator == mir::Integrator::vpl && s.bound.kind != mir::BoundPolicy::Kind::none &&
           !s.vsl.enabled;
}

/// Fills in what the quality says of options that were not given.
void fill_in(mir::Quality quality, const CLI::App& app, RenderOptions& o) {
    const mir::RenderSettings usual = mir::settings_for(quality);
    mir::RenderSettings& s = o.settings;
    const bool cuts = s.sum == mir::LightSum::cuts;
    if (!is_given(app, "--luxels")) s.luxels_per_pixel = usual.luxels_per_pixel;
    if (!is_given(app, "--direct-samples")) s.direct_samples = usual.direct_samples;
    if (!is_given(app, "--caustics")) s.skip_faint_caustics = usual.skip_faint_caustics;
    if (s.skip_faint_caustics) s.caustics = usual.caustics;
    if (!is_given(app, "--picks")) s.picks = usual.picks;
    if (!cuts && chooses_vpls(app, o)) return;
    if (!is_given(app, "--vpls")) s.vpls = usual.vpls;
    if (!is_given(app, "--sampler")) s.sampler = usual.sampler;
    if (!is_given(app, "--compensate") && can_trace_back(s)) s.compensate = usual.compensate;
}

}  // namespace

void add_quality(CLI::App& app, RenderOptions& options) {
    begin_group(app, "Image");
    const auto quality = std::make_shared<mir::Quality>(mir::Quality::good);
    add_choice<mir::Quality>(
        app, "--quality", *quality,
        {{"draft", mir::Quality::draft},
         {"good", mir::Quality::good},
         {"final", mir::Quality::final}},
        "How good the picture is to be: a look (draft), what one shows (good, "
        "default), or eight times the time of that (final). It chooses "
        "--luxels, --vpls, --picks, --direct-samples, --caustics and --compensate");
    app.parse_complete_callback([&app, &options, quality] { fill_in(*quality, app, options); });
}

}  // namespace mirtool
