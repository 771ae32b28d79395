// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/engine_canvas.hpp"
#include "mir/runtime/host_canvas.hpp"
#include "mir/runtime/host_only.hpp"
#include "mir/runtime/normalisation_pass.hpp"
#include "mir/runtime/picture_bytes.hpp"
#include "mir/runtime/render_job.hpp"
#include "mir/runtime/sampler_choice.hpp"
#include "mir/runtime/vpl_light.hpp"
#include "mir/sampling/visible_area.hpp"
#include "mir/sampling/vsl_radii.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/shading/direct_samples.hpp"

#include <limits>

namespace mir {

/// What brings direct light to one luxel: its samples, or as many VPLs at infinity as there are to
/// be others.
[[nodiscard]] inline DirectSamples direct_samples_of_luxel(const RenderSettings& settings) {
    return settings.direct == DirectLight::separate
               ? DirectSamples(settings.direct_samples_per_luxel())
               : DirectSamples::vpls(settings.vpls);
}

namespace detail {
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
struct CanvasOf {
    using Type = HostCanvas<B, Engine, E, MakeScheduler>;
};
template <Bsdf B, BandEngine Engine, Executor E, class MakeScheduler>
struct CanvasOf<B, Engine, E, MakeScheduler> {
    using Type = EngineCanvas<B, Engine, E>;
};
}  // namespace detail

/// Where the picture of a render by an engine grows.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
using CanvasOf = typename detail::CanvasOf<B, Engine, E, MakeScheduler>::Type;

/// One render from a Scene to a RenderResult with a given Bsdf, ray engine and executor: places
/// VPLs, normalises them where their sampler needs it, then goes through the image in bands of
/// luxel rows, so that memory does not grow with the number of luxels. `Engine` offers ray_caster()
/// and visibility(); `make_scheduler(executor, monitor)` returns the Scheduler, which no BandEngine
/// needs.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
class TiledRender {
 public:
    /// Chooses the bound, for which AreaRays are traced where the settings leave it open. What is
    /// passed in must outlive it; `monitor` may be null.
    /// @throws Error(unsupported) when the settings are host_only() and the engine is a BandEngine.
    TiledRender(const Scene& scene, const RenderSettings& settings, const WorldGeometry& geometry,
                const Engine& engine, E& executor, Monitor* monitor, StageClock& clock,
                MakeScheduler make_scheduler)
        : job_(scene, settings, geometry, engine, executor, monitor, clock),
          make_scheduler_(make_scheduler) {
        if (const std::string reason = host_only(settings); BandEngine<Engine> && !reason.empty())
            throw Error(ErrorCode::unsupported, reason);
        choose_bound();
    }

    /// Renders with the sampler that the settings name.
    RenderResult run();

    /// Renders with a sampler of the caller's, which must use shading() where it needs to know how
    /// luxels are lit.
    template <Sampler S>
    RenderResult run(const S& sampler);

    /// How a VPL lights a luxel of this image.
    [[nodiscard]] const VplShading<B>& shading() const { return shading_; }

 private:
    using Bands = ImageBands<B, Engine, E>;
    using Band = typename Bands::Band;
    using Canvas = CanvasOf<B, Engine, E, MakeScheduler>;
    using Layer = typename Canvas::Layer;

    void choose_bound();
    [[nodiscard]] SampledVpls sample_as_set() {
        if constexpr (SamplingEngine<Engine>)
            return sample_vpls(job_.context(), job_.lights, shading_.bound);
        else
            return sample_vpls(job_.context().through(AnyEngine(job_.engine)), job_.lights,
                               shading_.bound);
    }
    template <class Sample>
    RenderResult render_from(const Sample& sample);
    [[nodiscard]] double seen_area() const;
    [[nodiscard]] std::vector<float> sphere_radii();
    [[nodiscard]] std::vector<VplLobe<B>> lobes(const VplRecords& records, bool normalised);
    void keep_statistics(const VplRecords& records, Normalisation normalisation);
    [[nodiscard]] bool must_normalise(Normalisation normalisation) const;
    void render(const VplRecords& records, Normalisation normalisation);
    void plan_progress(bool stored, bool kept);
    std::vector<Band> normalise_vpls(const Bands& bands, const VplRecords& records);
    void render_band(Canvas& canvas, const Band& band, const VplLight<B>& light);
    [[nodiscard]] Layer removed_light(const Canvas& canvas, const Band& band,
                                      const VplLight<B>& light);
    void add_residual(const Canvas& canvas, const Band& band, std::vector<Layer>& layers);
    void measure(const Canvas& canvas);
    void add_mean(const Canvas& canvas, const Layer& layer, double RenderStatistics::*mean);

    RenderJob<B, Engine, E> job_;
    MakeScheduler make_scheduler_;
    VplShading<B> shading_;
};

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::choose_bound() {
    if (job_.settings.bound.kind == BoundPolicy::Kind::none) return;
    const auto stage = job_.clock.measure(&StageSeconds::bound);
    shading_.bound = job_.settings.bound.kind == BoundPolicy::Kind::fixed
                         ? job_.settings.bound.value
                         : default_bound(seen_area(), job_.settings.vpls);
    job_.result.statistics.bound = shading_.bound;
}

/// Area of the surfaces that the camera sees, m^2.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
double TiledRender<B, Engine, E, MakeScheduler>::seen_area() const {
    const Camera& camera = job_.rays.camera;
    const float aspect = job_.aspect();
    if constexpr (BandEngine<Engine>)
        return job_.engine.visible_area(camera, aspect);
    else
        return visible_area(camera, aspect,
                            LuxelTracer{job_.engine.ray_caster(), job_.surfaces.view()});
}

/// Of virtual spherical lights, metres; none without.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
std::vector<float> TiledRender<B, Engine, E, MakeScheduler>::sphere_radii() {
    const VslSettings& vsl = job_.settings.vsl;
    if (!vsl.enabled) return {};
    const auto stage = job_.clock.measure(&StageSeconds::bound);
    std::vector<float> radii =
        vsl_radii(job_.result.vpls.vpls(), seen_area(), vsl.scale, job_.executor);
    double& mean = job_.result.statistics.vsl_radius;
    for (const float r : radii) mean += static_cast<double>(r) / static_cast<double>(radii.size());
    return radii;
}

/// Of VPLs that keep the lobes of their surfaces; none where they do not.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
std::vector<VplLobe<B>> TiledRender<B, Engine, E, MakeScheduler>::lobes(const VplRecords& records,
                                                                        bool normalised) {
    if (!job_.settings.glossy.enabled) return {};
    expects(!normalised,
            "VPLs that keep lobes were normalised by the image (lobes would keep the power of "
            "before); use a sampler whose intensities are final");
    VplLobes<B> kept(records, job_.surfaces, job_.settings.glossy.least_alpha());
    job_.result.statistics.non_lambertian_share = 0.0f;
    job_.result.statistics.widened_share = kept.widened_share;
    return std::move(kept.lobes);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
RenderResult TiledRender<B, Engine, E, MakeScheduler>::run() {
    return render_from([this] { return sample_as_set(); });
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
template <Sampler S>
RenderResult TiledRender<B, Engine, E, MakeScheduler>::run(const S& sampler) {
    return render_from([this, &sampler] {
        return SampledVpls{sampler.sample(job_.executor), S::normalisation};
    });
}

/// Goes on from the VPLs that `sample()` returns.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
template <class Sample>
RenderResult TiledRender<B, Engine, E, MakeScheduler>::render_from(const Sample& sample) {
    SampledVpls sampled;
    const VplRecords& records = sampled.records;
    {
        const auto stage = job_.clock.measure(&StageSeconds::sampling);
        sampled = sample();
        job_.result.vpls = aggregate(records);
        job_.clock.reassign(records.bootstrap_seconds, &StageSeconds::sampling,
                            &StageSeconds::bootstrap);
    }
    keep_statistics(records, sampled.normalisation);
    render(records, sampled.normalisation);
    return job_.take_result();
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::keep_statistics(const VplRecords& records,
                                                               Normalisation normalisation) {
    RenderStatistics& s = job_.result.statistics;
    s.light_paths = records.paths;
    s.emitted_power = records.emitted_power;
    s.non_lambertian_share = records.non_lambertian_share;
    s.path_luminance = records.path_luminance;
    s.states = records.states;
    s.health = records.health;
    const bool by_sampler = normalisation == Normalisation::none && !records.health;
    s.normalisation =
        to_string(by_sampler ? NormalisationPolicy::none : job_.settings.normalisation);
    s.vpls = job_.result.vpls.size();
    s.luxels = job_.rays.grid.luxels().area();
    s.contributions = saturating_mul(s.luxels, s.vpls);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
bool TiledRender<B, Engine, E, MakeScheduler>::must_normalise(Normalisation normalisation) const {
    return normalisation == Normalisation::image_response &&
           (job_.settings.normalisation == NormalisationPolicy::full ||
            job_.settings.normalisation == NormalisationPolicy::prepass);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::render(const VplRecords& records,
                                                      Normalisation normalisation) {
    const bool normalises = must_normalise(normalisation);
    const bool over_image = normalises && job_.settings.normalisation == NormalisationPolicy::full;
    const bool stores = over_image || job_.settings.vsl.enabled || job_.settings.glossy.enabled;
    const Bands bands(job_.context(), normalises || stores ? job_.result.vpls.size() : 0);
    plan_progress(stores, !over_image || bands.fit_together(job_.result.vpls.size()));
    std::vector<Band> kept;
    if (normalises) kept = normalise_vpls(bands, records);
    const VplLight<B> light(job_.settings, shading_, job_.result.vpls,
                            {sphere_radii(), lobes(records, normalises)});
    const std::size_t layers =
        std::size_t{first_bounce_layer} + light.bounces() + (job_.settings.removed_layer ? 1 : 0);
    check_picture(job_.settings, layers);
    Canvas canvas(job_, make_scheduler_, layers);
    if (job_.settings.measure_missing) measure(canvas);
    for (std::uint32_t i = 0; i < bands.count(); ++i) {
        job_.begin_band(i, bands.count());
        Band band = kept.empty() ? bands.make(i) : std::move(kept[i]);
        if (stores && !band.knows_visibility()) bands.find_visible(band, job_.result.vpls.span());
        render_band(canvas, band, light);
    }
    canvas.finish();
}

/// Every VPL meets every luxel once per layer, and once more each time that bits are found.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::plan_progress(bool stored, bool kept) {
    if (job_.monitor == nullptr) return;
    const std::uint64_t layers =
        job_.settings.bounce_layers ? std::max<std::uint64_t>(job_.result.vpls.max_bounce(), 1) : 1;
    const std::uint64_t passes = !stored ? 0 : kept ? 1 : 2;
    job_.monitor->planned_contributions =
        saturating_mul(job_.result.statistics.contributions, layers + passes);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
auto TiledRender<B, Engine, E, MakeScheduler>::normalise_vpls(const Bands& bands,
                                                              const VplRecords& records)
    -> std::vector<Band> {
    NormalisationPass<B, Engine, E, VplShading<B>> pass(job_.context(), bands, shading_);
    const NormalisationReport report =
        pass.run(job_.result.vpls, records.path_luminance, records.states);
    job_.result.statistics.dropped_share = report.dropped_share;
    return pass.take_bands();
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::render_band(Canvas& canvas, const Band& band,
                                                           const VplLight<B>& light) {
    std::vector<Layer> layers;
    {
        const auto stage = job_.clock.measure(&StageSeconds::direct);
        layers.push_back(canvas.direct(band, direct_samples_of_luxel(job_.settings)));
        layers.push_back(canvas.emission(band));
        layers.push_back(canvas.coverage(band));
    }
    {
        const auto stage = job_.clock.measure(&StageSeconds::reconstruction);
        light.append_layers(canvas, band, job_.monitor, layers);
    }
    {
        const auto stage = job_.clock.measure(&StageSeconds::ledger);
        add_mean(canvas, layers[indirect_layer], &RenderStatistics::indirect_luminance);
    }
    Layer removed = removed_light(canvas, band, light);
    if constexpr (!BandEngine<Engine>)
        if (job_.settings.compensate > 0) add_residual(canvas, band, layers);
    if (job_.settings.removed_layer) layers.push_back(std::move(removed));
    canvas.put(band, layers);
}

/// The light that the bound removed from a band, by the VPLs.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
auto TiledRender<B, Engine, E, MakeScheduler>::removed_light(const Canvas& canvas, const Band& band,
                                                             const VplLight<B>& light) -> Layer {
    const auto stage = job_.clock.measure(&StageSeconds::ledger);
    if (job_.settings.bound.kind == BoundPolicy::Kind::none || job_.settings.vsl.enabled)
        return canvas.black(band);
    Layer removed = light.removed(canvas, band);
    add_mean(canvas, removed, &RenderStatistics::removed_luminance);
    return removed;
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::add_residual(const Canvas& canvas, const Band& band,
                                                            std::vector<Layer>& layers) {
    const auto stage = job_.clock.measure(&StageSeconds::residual);
    add_mean(canvas, canvas.add_residual(band, shading_.bound, layers),
             &RenderStatistics::residual_luminance);
    job_.result.statistics.residual_paths +=
        band.extent().area() * job_.settings.compensate_per_luxel();
}

/// Engines that keep luxels to themselves have no rays for the host without building for them.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::measure(const Canvas& canvas) {
    if constexpr (!BandEngine<Engine>) {
        const auto stage = job_.clock.measure(&StageSeconds::ledger);
        job_.result.statistics.direct_noise =
            canvas.direct_noise(direct_samples_of_luxel(job_.settings));
        const bool bounded =
            job_.settings.bound.kind != BoundPolicy::Kind::none && !job_.settings.vsl.enabled;
        const MissingShares missing =
            canvas.missing(bounded ? shading_.bound : std::numeric_limits<float>::max());
        job_.result.statistics.cut = missing.cut;
        job_.result.statistics.removed = missing.removed;
    }
}

/// Adds what a band brings to a mean luminance over the image: row by row, so that bands change
/// nothing.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::add_mean(const Canvas& canvas, const Layer& layer,
                                                        double RenderStatistics::*mean) {
    RenderStatistics& s = job_.result.statistics;
    const double share = 1.0 / static_cast<double>(s.luxels);
    for (const double row : canvas.row_luminances(layer)) s.*mean += row * share;
}

}  // namespace mir
