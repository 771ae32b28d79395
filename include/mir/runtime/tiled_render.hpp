// SPDX-License-Identifier: MIT
#pragma once

#include "mir/direct_light.hpp"
#include "mir/film/film.hpp"
#include "mir/runtime/film_layers.hpp"
#include "mir/runtime/normalisation_pass.hpp"
#include "mir/runtime/sampler_choice.hpp"
#include "mir/runtime/vpl_light.hpp"
#include "mir/sampling/visible_area.hpp"
#include "mir/scene/scene_hash.hpp"

namespace mir {

/// One render from a Scene to a RenderResult with a given Bsdf, ray engine and executor: places
/// VPLs, normalises them where their sampler needs it, then goes through the image in bands of
/// luxel rows, so that memory does not grow with the number of luxels. `Engine` offers ray_caster()
/// and visibility(); `make_scheduler(executor, monitor)` returns the Scheduler.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
class TiledRender {
 public:
    TiledRender(const Scene& scene, const RenderSettings& settings, const WorldGeometry& geometry,
                const Engine& engine, E& executor, Monitor* monitor, MakeScheduler make_scheduler)
        : settings_(settings),
          geometry_(geometry),
          engine_(engine),
          executor_(executor),
          monitor_(monitor),
          make_scheduler_(make_scheduler),
          lights_(scene, geometry),
          surfaces_(scene),
          rays_{scene.cameras[settings.camera],
                luxel_grid(settings.image, settings.luxels_per_pixel, settings.limits),
                settings.seed},
          result_{{}, {}, {}, {}, {}, Guides(settings.image), {}, {}, {}} {
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
    using Context = RenderContext<B, Engine, E>;
    using Bands = ImageBands<B, Engine, E>;
    using Light = VplLight<B, Engine, E, MakeScheduler>;

    [[nodiscard]] Context context() {
        return {settings_, geometry_, surfaces_, rays_,
                engine_,   executor_, monitor_,  result_.statistics.seconds};
    }
    void choose_bound();
    void keep_statistics(const VplRecords& records, Normalisation normalisation);
    [[nodiscard]] bool must_normalise(Normalisation normalisation) const;
    void render(const VplRecords& records, Normalisation normalisation);
    void plan_progress(bool stored, bool kept);
    std::vector<ImageBand<B>> normalise_vpls(const Bands& bands, const VplRecords& records);
    void render_band(Film& film, const ImageBand<B>& band, const Light& light);
    void measure_removed(const ImageBand<B>& band, const Light& light, const Image<Rgb>& indirect);
    [[nodiscard]] Image<Rgb> emission_of(const ImageBand<B>& band) const;

    const RenderSettings& settings_;
    const WorldGeometry& geometry_;
    const Engine& engine_;
    E& executor_;
    Monitor* monitor_;
    MakeScheduler make_scheduler_;
    LightTable lights_;
    SurfaceTable<B> surfaces_;
    CameraRays rays_;
    VplShading<B> shading_;
    RenderResult result_;
};

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::choose_bound() {
    if (settings_.bound.kind == BoundPolicy::Kind::none) return;
    shading_.bound =
        settings_.bound.kind == BoundPolicy::Kind::fixed
            ? settings_.bound.value
            : default_bound(visible_area(rays_.camera, context().aspect(), engine_.ray_caster()),
                            settings_.vpls);
    result_.statistics.bound = shading_.bound;
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
RenderResult TiledRender<B, Engine, E, MakeScheduler>::run() {
    return with_sampler(context(), lights_, shading_.bound,
                        [this](const auto& sampler) { return this->run(sampler); });
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
template <Sampler S>
RenderResult TiledRender<B, Engine, E, MakeScheduler>::run(const S& sampler) {
    VplRecords records;
    {
        const Stopwatch watch(result_.statistics.seconds.sampling);
        records = sampler.sample(executor_);
        result_.vpls = aggregate(records);
    }
    keep_statistics(records, S::normalisation);
    render(records, S::normalisation);
    return std::move(result_);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::keep_statistics(const VplRecords& records,
                                                               Normalisation normalisation) {
    RenderStatistics& s = result_.statistics;
    s.light_paths = records.paths;
    s.emitted_power = records.emitted_power;
    s.non_lambertian_share = records.non_lambertian_share;
    s.path_luminance = records.path_luminance;
    s.states = records.states;
    s.health = records.health;
    const bool by_sampler = normalisation == Normalisation::none && !records.health;
    s.normalisation = to_string(by_sampler ? NormalisationPolicy::none : settings_.normalisation);
    s.vpls = result_.vpls.size();
    s.luxels = rays_.grid.luxels().area();
    s.contributions = saturating_mul(s.luxels, s.vpls);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
bool TiledRender<B, Engine, E, MakeScheduler>::must_normalise(Normalisation normalisation) const {
    return normalisation == Normalisation::image_response &&
           (settings_.normalisation == NormalisationPolicy::full ||
            settings_.normalisation == NormalisationPolicy::prepass);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::render(const VplRecords& records,
                                                      Normalisation normalisation) {
    const bool normalises = must_normalise(normalisation);
    const bool stores = normalises && settings_.normalisation == NormalisationPolicy::full;
    const Bands bands(context(), normalises ? result_.vpls.size() : 0);
    plan_progress(stores, bands.fit_together(result_.vpls.size()));
    std::vector<ImageBand<B>> kept;
    if (normalises) kept = normalise_vpls(bands, records);
    const Light light(context(), make_scheduler_, shading_, result_.vpls);
    Film film(rays_.grid, settings_.filter, settings_.seed,
              std::size_t{first_bounce_layer} + light.bounces());
    for (std::uint32_t i = 0; i < bands.count(); ++i) {
        ImageBand<B> band = kept.empty() ? bands.make(i) : std::move(kept[i]);
        if (stores && !band.visibility) bands.find_visible(band, result_.vpls.span());
        render_band(film, band, light);
    }
    develop_layers(film, result_);
}

/// Every VPL meets every luxel once per layer, and once more each time that bits are found.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::plan_progress(bool stored, bool kept) {
    if (monitor_ == nullptr) return;
    const std::uint64_t layers =
        settings_.bounce_layers ? std::max<std::uint64_t>(result_.vpls.max_bounce(), 1) : 1;
    const std::uint64_t passes = !stored ? 0 : kept ? 1 : 2;
    monitor_->planned_contributions =
        saturating_mul(result_.statistics.contributions, layers + passes);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
std::vector<ImageBand<B>> TiledRender<B, Engine, E, MakeScheduler>::normalise_vpls(
    const Bands& bands, const VplRecords& records) {
    NormalisationPass<B, Engine, E, VplShading<B>> pass(context(), bands, shading_);
    const NormalisationReport report =
        pass.run(result_.vpls, records.path_luminance, records.states);
    result_.statistics.dropped_share = report.dropped_share;
    return pass.take_bands();
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::render_band(Film& film, const ImageBand<B>& band,
                                                           const Light& light) {
    std::vector<Image<Rgb>> layers;
    {
        const Stopwatch watch(result_.statistics.seconds.direct);
        const bool sampled = settings_.direct == DirectLight::separate;
        layers.push_back(direct_light<B>(band.gbuffer, lights_, engine_.visibility(),
                                         {band.first_row, rays_.grid, settings_.seed},
                                         sampled ? settings_.direct_samples_per_luxel() : 0,
                                         geometry_.ray_offset(), executor_));
        layers.push_back(emission_of(band));
    }
    light.append_layers(band, layers);
    measure_removed(band, light, layers[indirect_layer]);
    const Stopwatch watch(result_.statistics.seconds.film);
    film.add_rows(executor_, band.first_row, layers);
    add_guides(
        result_.guides, band.gbuffer, band.first_row, rays_.grid, rays_.camera,
        [](const auto& s) { return B::albedo(s.bsdf, s.normal, s.wo); }, executor_);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::measure_removed(const ImageBand<B>& band,
                                                               const Light& light,
                                                               const Image<Rgb>& indirect) {
    RenderStatistics& s = result_.statistics;
    const Stopwatch watch(s.seconds.ledger);
    const double share = 1.0 / static_cast<double>(s.luxels);
    for (const Rgb& c : indirect.pixels()) s.indirect_luminance += luminance(c) * share;
    if (settings_.bound.kind == BoundPolicy::Kind::none) return;
    const Image<Rgb> removed = light.removed(band);
    for (const Rgb& c : removed.pixels()) s.removed_luminance += luminance(c) * share;
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
Image<Rgb> TiledRender<B, Engine, E, MakeScheduler>::emission_of(const ImageBand<B>& band) const {
    Image<Rgb> image(band.gbuffer.extent());
    for (TileIndex t = 0; t < band.gbuffer.tiles().size(); ++t) {
        const Tile tile = band.gbuffer.tiles()[t];
        const auto layout = BlockedLayout::of(tile);
        const auto view = band.gbuffer.view(t);
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x)
                image(tile.x + x, tile.y + y) = view.surface(layout(x, y)).emission;
    }
    return image;
}

}  // namespace mir
