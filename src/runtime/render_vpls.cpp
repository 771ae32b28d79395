// SPDX-License-Identifier: MIT
#include "runtime/render_vpls.hpp"

#include "mir/runtime/picture_bytes.hpp"
#include "mir/runtime/row_errors.hpp"
#include "mir/sampling/visible_area.hpp"
#include "mir/sampling/vsl_radii.hpp"
#include "runtime/caustic_light.hpp"
#include "runtime/direct_noise.hpp"
#include "runtime/film_layers.hpp"
#include "runtime/missing_light.hpp"
#include "runtime/normalisation_pass.hpp"
#include "runtime/pick_variance.hpp"
#include "runtime/row_luminances.hpp"
#include "runtime/sample_vpls.hpp"
#include "runtime/vpl_light.hpp"

#include <limits>
#include <utility>

namespace mir {
namespace {

constexpr float no_bound = std::numeric_limits<float>::max();

/// What brings direct light to one luxel. Its samples, or as many VPLs at infinity as there are to
/// be others.
DirectSamples direct_samples_of_luxel(const RenderSettings& settings) {
    return settings.direct == DirectLight::separate
               ? DirectSamples(settings.direct_samples_per_luxel())
               : DirectSamples::vpls(settings.vpls);
}

void keep_statistics(RenderJob& job, const SampledVpls& sampled) {
    const VplRecords& records = sampled.records;
    RenderStatistics& s = job.result.statistics;
    s.light_paths = records.paths;
    s.emitted_power = records.emitted_power;
    s.non_lambertian_share = records.non_lambertian_share;
    s.path_luminance = records.path_luminance;
    s.states = records.states;
    s.health = records.health;
    s.light_path_luminance = records.light_paths;
    const bool by_sampler = sampled.normalisation == Normalisation::none && !records.health;
    s.normalisation =
        to_string(by_sampler ? NormalisationPolicy::none : job.settings.normalisation_policy());
    s.vpls = job.result.vpls.size();
    s.luxels = job.rays.grid.luxels().area();
    s.luxel_rows_per_pixel = job.rays.grid.per_pixel_y;
    s.residual_paths = saturating_mul(s.luxels, job.settings.compensate_per_luxel());
    const std::uint64_t gathered =
        job.settings.wants_cuts() ? std::min<std::uint64_t>(s.vpls, job.settings.picks) : s.vpls;
    s.contributions = saturating_mul(s.luxels, gathered);
}

bool must_normalise(const RenderSettings& settings, Normalisation normalisation) {
    return normalisation == Normalisation::image_response &&
           (settings.normalisation_policy() == NormalisationPolicy::full ||
            settings.normalisation_policy() == NormalisationPolicy::prepass);
}

/// Every VPL meets every luxel once per layer, and once per finding of bits. Luxels of `share` are
/// shown.
void plan_progress(RenderJob& job, bool normalised, bool stored, bool kept, double share) {
    if (job.monitor == nullptr) return;
    const std::uint64_t layers =
        job.settings.bounce_layers ? std::max<std::uint64_t>(job.result.vpls.max_bounce(), 1) : 1;
    const std::uint64_t shown = layers + (stored && !kept ? 1 : 0);
    const std::uint64_t all = job.result.statistics.contributions;
    job.monitor->planned_contributions =
        (normalised ? all : 0) +
        static_cast<std::uint64_t>(share * static_cast<double>(saturating_mul(all, shown)));
}

std::vector<BandPtr> normalise_vpls(RenderFrame& frame, const ImageBands& bands, float bound,
                                    const VplRecords& records) {
    RenderJob& job = frame.job();
    NormalisationPass pass(frame, bands, bound);
    const NormalisationReport report =
        pass.run(job.result.vpls, records.path_luminance, records.states);
    job.result.statistics.dropped_share = report.dropped_share;
    return pass.take_bands();
}

/// Spheres around VPLs, where the settings want them.
void keep_radii(RenderFrame& frame) {
    RenderJob& job = frame.job();
    const VslSettings& vsl = job.settings.vsl;
    if (!vsl.enabled) return;
    const auto stage = job.clock.measure(&StageSeconds::bound);
    std::vector<float> radii =
        vsl_radii(job.result.vpls.vpls(), frame.visible_area(), vsl.scale, job.executor);
    double& mean = job.result.statistics.vsl_radius;
    for (const float r : radii) mean += static_cast<double>(r) / static_cast<double>(radii.size());
    frame.keep_radii(std::move(radii));
}

/// Lobes of VPLs, where the settings want them.
void keep_lobes(RenderFrame& frame, const VplRecords& records, bool normalised) {
    RenderJob& job = frame.job();
    if (!job.settings.glossy.enabled) return;
    expects(!normalised,
            "VPLs that keep lobes were normalised by the image (lobes would keep the power of "
            "before); use a sampler whose intensities are final");
    job.result.statistics.non_lambertian_share = 0.0f;
    job.result.statistics.widened_share = frame.keep_lobes(records);
}

/// Only where rays of the host are at hand. Others would have to build for them.
void measure_what_is_missing(RenderFrame& frame, float bound) {
    RenderJob& job = frame.job();
    if (!job.settings.measure_missing || !frame.traits().on_host) return;
    const auto stage = job.clock.measure(&StageSeconds::light_budget);
    job.result.statistics.direct_noise = direct_noise(frame, direct_samples_of_luxel(job.settings));
    const bool bounded =
        job.settings.bound.kind != BoundPolicy::Kind::none && !job.settings.vsl.enabled;
    const MissingShares missing = missing_light(frame, bounded ? bound : no_bound);
    job.result.statistics.cut = missing.cut;
    job.result.statistics.removed = missing.removed;
}

/// What was made of a band, by a frame that others may work beside.
struct BandLight {
    std::vector<LayerPtr> layers;  ///< in the order of FilmLayer
    // Luminances of rows, of layers that tell the result their means.
    std::vector<double> direct;  ///< none where rows share samples of it
    std::vector<double> indirect;
    std::vector<double> removed;   ///< none where nothing is
    std::vector<double> residual;  ///< the same
    CausticRows caustic;           ///< the same
};

/// The light that the bound removed from a band, by the VPLs.
LayerPtr removed_light(RenderFrame& by, const FrameBand& band, const VplLight& light,
                       std::vector<double>& rows) {
    const RenderJob& job = by.job();
    const auto stage = job.clock.measure(&StageSeconds::light_budget);
    const bool removes =
        job.settings.bound.kind != BoundPolicy::Kind::none && !job.settings.vsl.enabled;
    // Cuts meet too few VPLs to tell; paths do (RenderSettings::measure_missing).
    if (!removes || job.settings.sum == LightSum::cuts) return by.black(band);
    LayerPtr removed = light.removed(by, band);
    rows = by.row_luminances(*removed);
    return removed;
}

/// Adds the light that the bound removed to a band's layers, traced back. Returns its luminances.
std::vector<double> add_residual(RenderFrame& by, const FrameBand& band, float bound,
                                 std::vector<LayerPtr>& layers) {
    const LayerPtr light =
        by.residual(band, bound, std::span<const LayerPtr>(layers).subspan(first_bounce_layer));
    by.add(*layers[indirect_layer], *light);
    return by.row_luminances(*light);
}

BandLight light_band(RenderFrame& by, const FrameBand& band, float bound, const VplLight& light,
                     const CausticLight& caustics) {
    const RenderJob& job = by.job();
    BandLight made;
    {
        const auto stage = job.clock.measure(&StageSeconds::direct);
        made.layers.push_back(by.direct(band, direct_samples_of_luxel(job.settings)));
        made.layers.push_back(by.emission(band));
        made.layers.push_back(by.coverage(band));
    }
    LayerPtr variance = job.settings.pick_error_layer ? by.black(band) : nullptr;
    {
        const auto stage = job.clock.measure(&StageSeconds::reconstruction);
        light.append_layers(by, band, variance.get(), job.monitor, made.layers);
    }
    {
        const auto stage = job.clock.measure(&StageSeconds::light_budget);
        if (job.settings.direct == DirectLight::separate)
            made.direct = by.row_luminances(*made.layers[direct_layer]);
        made.indirect = by.row_luminances(*made.layers[indirect_layer]);
    }
    LayerPtr removed = removed_light(by, band, light, made.removed);
    if (job.settings.compensate > 0) {
        const auto stage = job.clock.measure(&StageSeconds::residual);
        made.residual = add_residual(by, band, bound, made.layers);
    }
    {
        const auto stage = job.clock.measure(&StageSeconds::caustics);
        made.caustic = caustics.add(by, band, made.layers);
    }
    if (job.settings.removed_layer) made.layers.push_back(std::move(removed));
    if (variance != nullptr) made.layers.push_back(std::move(variance));
    return made;
}

void develop(RenderFrame& frame) {
    RenderJob& job = frame.job();
    const auto stage = job.clock.measure(&StageSeconds::film);
    std::vector<Image<Rgb>> layers = frame.develop();
    if (job.settings.pick_error_layer) {
        const double share = variance_share(job.settings.filter, job.rays.grid);
        job.result.pick_error = pick_errors(layers.back(), share, job.executor);
        layers.pop_back();
    }
    take_layers(std::move(layers), job.settings.removed_layer, job.result, job.executor);
}

/// Places VPLs and puts them into the result, as they come from the sampler.
SampledVpls sample_into_result(RenderFrame& frame, float bound) {
    RenderJob& job = frame.job();
    const auto stage = job.clock.measure(&StageSeconds::sampling);
    SampledVpls sampled = sample_vpls(frame, bound);
    job.result.vpls = aggregate(sampled.records);
    job.clock.reassign(sampled.records.bootstrap_seconds, &StageSeconds::sampling,
                       &StageSeconds::bootstrap);
    return sampled;
}

/// Goes on from VPLs that lie in the result.
RenderResult render_from(RenderFrame& frame, const SampledVpls& sampled, float bound) {
    RenderJob& job = frame.job();
    const RenderSettings& s = job.settings;
    const VplList& vpls = job.result.vpls;
    keep_statistics(job, sampled);
    const bool normalises = must_normalise(s, sampled.normalisation);
    const bool over_image = normalises && s.normalisation == NormalisationPolicy::full;
    const bool stores = over_image || s.vsl.enabled || s.glossy.enabled;
    const std::uint32_t seen = normalises || stores ? vpls.size() : 0;
    const ImageBands bands = ImageBands::of_rows(frame, seen);
    plan_progress(job, over_image, stores,
                  over_image && s.rows.count == 0 && bands.fit_together(vpls.size()),
                  bands.share());
    std::vector<BandPtr> kept;
    if (normalises) kept = normalise_vpls(frame, {frame, seen}, bound, sampled.records);
    keep_radii(frame);
    keep_lobes(frame, sampled.records, normalises);
    const VplLight light(s, bound, vpls, job.executor);
    check_picture(s, std::size_t{first_bounce_layer} + light.bounces() + extra_layers(s));
    measure_what_is_missing(frame, bound);
    const CausticLight caustics(frame, bands);
    job.begin_bands(bands.count());
    frame.for_each_band(bands.count(), [&](RenderFrame& by, std::uint32_t i, BandTurn& turn) {
        job.begin_band();
        const BandPtr band =
            kept.empty() || kept[i] == nullptr ? bands.make(by, i) : std::move(kept[i]);
        if (stores && !band->knows_visibility()) find_visible(by, *band, vpls.span());
        BandLight made = light_band(by, *band, bound, light, caustics);
        turn.wait();
        add_luminances(job, *band,
                       {made.indirect, made.removed, made.residual, made.caustic.all,
                        made.caustic.direct, made.direct});
        by.put(*band, std::move(made.layers), turn);
    });
    keep_row_errors(job.result.statistics, job.result.luminances);
    develop(frame);
    return job.take_result();
}

}  // namespace

float choose_bound(RenderFrame& frame) {
    RenderJob& job = frame.job();
    const BoundPolicy& policy = job.settings.bound;
    if (policy.kind == BoundPolicy::Kind::none) return no_bound;
    const auto stage = job.clock.measure(&StageSeconds::bound);
    float bound = policy.value;
    if (policy.kind == BoundPolicy::Kind::automatic) {
        // Picks vary less under a lower bound, and what it takes is not lost.
        constexpr std::uint32_t lower = 4;  // docs/decisions/066
        const bool is_traced_back =
            job.settings.compensate > 0 && job.settings.sum == LightSum::cuts;
        bound =
            default_bound(frame.visible_area(), job.settings.vpls / (is_traced_back ? lower : 1));
    }
    job.result.statistics.bound = bound;
    return bound;
}

RenderResult render_vpls(RenderFrame& frame) {
    const float bound = choose_bound(frame);
    return render_from(frame, sample_into_result(frame, bound), bound);
}

VplList placed_vpls(RenderFrame& frame, float bound) {
    RenderJob& job = frame.job();
    const SampledVpls sampled = sample_into_result(frame, bound);
    if (must_normalise(job.settings, sampled.normalisation)) {
        const ImageBands bands(frame, job.result.vpls.size());
        static_cast<void>(normalise_vpls(frame, bands, bound, sampled.records));
    }
    return std::move(job.result.vpls);
}

RenderResult render_vpls(RenderFrame& frame, const SampledVpls& sampled, float bound) {
    RenderJob& job = frame.job();
    {
        const auto stage = job.clock.measure(&StageSeconds::sampling);
        job.result.vpls = aggregate(sampled.records);
    }
    return render_from(frame, sampled, bound);
}

}  // namespace mir
