// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/direct_light.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/film/film.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/runtime/stopwatch.hpp"
#include "mir/sampling/visible_area.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/shading/vpl_shading.hpp"

namespace mir {

/// One render from a Scene to a RenderResult with a given Bsdf, ray engine and executor: places
/// VPLs, then goes through the image in bands of luxel rows, so that memory does not grow with the
/// number of luxels. `Engine` offers ray_caster() and visibility(); `make_scheduler(executor,
/// monitor)` returns the Scheduler.
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
          tile_(whole_blocks(settings.tile)),
          make_scheduler_(make_scheduler),
          lights_(scene, geometry),
          surfaces_(scene),
          rays_{scene.cameras[settings.camera],
                luxel_grid(settings.image, settings.luxels_per_pixel, settings.limits),
                settings.seed},
          result_{{}, {}, {}, {}, {}, Guides(settings.image), {}, {}, {}} {}

    RenderResult run();

 private:
    using GBuffer = BlockedGBuffer<typename B::Params>;
    /// Layers of the film; those of the bounces, if there are any, come last.
    enum Layer : std::size_t { direct_layer, emission_layer, indirect_layer, first_bounce_layer };

    /// Number of bounces that get a layer of their own.
    [[nodiscard]] std::uint8_t bounces() const {
        return settings_.bounce_layers ? result_.vpls.max_bounce() : std::uint8_t{0};
    }
    void place_vpls();
    void choose_bound();
    [[nodiscard]] std::uint32_t rows_per_band() const;
    void render_band(Film& film, std::uint32_t first_row, std::uint32_t rows);
    void add_indirect_light(const GBuffer& gbuffer, std::vector<Image<Rgb>>& layers);
    void measure_removed(const GBuffer& gbuffer, const Image<Rgb>& indirect);
    Image<Rgb> emission_of(const GBuffer& gbuffer) const;
    void finish(const Film& film);

    const RenderSettings& settings_;
    const WorldGeometry& geometry_;
    const Engine& engine_;
    E& executor_;
    Monitor* monitor_;
    Extent tile_;
    MakeScheduler make_scheduler_;
    LightTable lights_;
    SurfaceTable<B> surfaces_;
    CameraRays rays_;
    VplShading<B> shading_;
    RenderResult result_;
};

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
RenderResult TiledRender<B, Engine, E, MakeScheduler>::run() {
    place_vpls();
    choose_bound();
    Film film(rays_.grid, settings_.filter, settings_.seed,
              std::size_t{first_bounce_layer} + bounces());
    const std::uint32_t height = rays_.grid.luxels().height;
    const std::uint32_t step = rows_per_band();
    for (std::uint32_t row = 0; row < height; row += step)
        render_band(film, row, std::min(step, height - row));
    finish(film);
    return std::move(result_);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::place_vpls() {
    const Stopwatch watch(result_.statistics.seconds.sampling);
    using Sampler = InstantRadiositySampler<B, decltype(engine_.ray_caster())>;
    InstantRadiosityOptions options;
    options.vpls = settings_.vpls;
    options.termination = settings_.termination;
    options.sequence = settings_.sequence;
    options.emitter_vpls = settings_.direct == DirectLight::vpl;
    options.max_bounce = settings_.max_bounce;
    options.seed = settings_.seed;
    const Sampler sampler({geometry_, lights_, surfaces_, engine_.ray_caster()}, options,
                          settings_.limits);
    const VplRecords records = sampler.sample(executor_);
    result_.vpls = aggregate(records);
    RenderStatistics& s = result_.statistics;
    s.light_paths = records.paths;
    s.emitted_power = records.emitted_power;
    s.non_lambertian_share = records.non_lambertian_share;
    s.vpls = result_.vpls.size();
    s.luxels = rays_.grid.luxels().area();
    s.contributions = saturating_mul(s.luxels, s.vpls);
    if (monitor_ != nullptr) monitor_->planned_contributions = s.contributions;
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::choose_bound() {
    if (settings_.bound.kind == BoundPolicy::Kind::none) return;
    const float aspect =
        static_cast<float>(settings_.image.width) / static_cast<float>(settings_.image.height);
    shading_.bound = settings_.bound.kind == BoundPolicy::Kind::fixed
                         ? settings_.bound.value
                         : default_bound(visible_area(rays_.camera, aspect, engine_.ray_caster()),
                                         std::max(result_.vpls.size(), 1u));
    result_.statistics.bound = shading_.bound;
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
std::uint32_t TiledRender<B, Engine, E, MakeScheduler>::rows_per_band() const {
    // Some 2 million luxels at a time; whole pixels, and whole tiles unless those are huge.
    constexpr std::uint64_t luxels_per_band = 1u << 21;
    const std::uint64_t width = rays_.grid.luxels().width;
    const std::uint64_t pixel = rays_.grid.per_pixel_y;
    const std::uint64_t grain = pixel * std::min<std::uint64_t>(tile_.height, 256);
    const std::uint64_t rows = std::max<std::uint64_t>(luxels_per_band / width / grain, 1) * grain;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(rows, rays_.grid.luxels().height));
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::render_band(Film& film, std::uint32_t first_row,
                                                           std::uint32_t rows) {
    StageSeconds& seconds = result_.statistics.seconds;
    const std::uint32_t width = rays_.grid.luxels().width;
    GBuffer gbuffer({width, rows}, tile_);
    {
        const Stopwatch watch(seconds.gbuffer);
        fill_gbuffer<B>(gbuffer, first_row, rays_, engine_.ray_caster(), surfaces_,
                        geometry_.ray_offset(), executor_);
    }
    std::vector<Image<Rgb>> layers;
    {
        const Stopwatch watch(seconds.direct);
        const bool sampled = settings_.direct == DirectLight::separate;
        layers.push_back(direct_light<B>(
            gbuffer, lights_, engine_.visibility(), {first_row, rays_.grid, settings_.seed},
            sampled ? settings_.direct_samples_per_luxel() : 0, geometry_.ray_offset(), executor_));
        layers.push_back(emission_of(gbuffer));
    }
    add_indirect_light(gbuffer, layers);
    measure_removed(gbuffer, layers[indirect_layer]);
    const Stopwatch watch(seconds.film);
    film.add_rows(executor_, first_row, layers);
    add_guides(
        result_.guides, gbuffer, first_row, rays_.grid, rays_.camera,
        [](const auto& s) { return B::albedo(s.bsdf, s.normal, s.wo); }, executor_);
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::add_indirect_light(const GBuffer& gbuffer,
                                                                  std::vector<Image<Rgb>>& layers) {
    const Stopwatch watch(result_.statistics.seconds.reconstruction);
    const auto scheduler = make_scheduler_(executor_, monitor_);
    if (bounces() == 0) {
        layers.push_back(
            reconstruct(scheduler, gbuffer, result_.vpls.span(), engine_.visibility(), shading_));
        return;
    }
    layers.emplace_back(gbuffer.extent());
    for (std::uint8_t b = 1; b <= bounces(); ++b) {
        layers.push_back(reconstruct(scheduler, gbuffer, result_.vpls.bounce(b),
                                     engine_.visibility(), shading_));
        const auto sum = layers[indirect_layer].pixels();
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += layers.back().pixels()[i];
    }
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::measure_removed(const GBuffer& gbuffer,
                                                               const Image<Rgb>& indirect) {
    const Stopwatch watch(result_.statistics.seconds.ledger);
    RenderStatistics& s = result_.statistics;
    const double share = 1.0 / static_cast<double>(s.luxels);
    for (const Rgb& c : indirect.pixels()) s.indirect_luminance += luminance(c) * share;
    if (settings_.bound.kind == BoundPolicy::Kind::none) return;
    const auto scheduler = make_scheduler_(executor_, nullptr);
    const Image<Rgb> removed = reconstruct(scheduler, gbuffer, result_.vpls.span(),
                                           engine_.visibility(), RemovedByBound<B>{shading_.bound});
    for (const Rgb& c : removed.pixels()) s.removed_luminance += luminance(c) * share;
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
Image<Rgb> TiledRender<B, Engine, E, MakeScheduler>::emission_of(const GBuffer& gbuffer) const {
    Image<Rgb> image(gbuffer.extent());
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t) {
        const Tile tile = gbuffer.tiles()[t];
        const auto layout = BlockedLayout::of(tile);
        const auto view = gbuffer.view(t);
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x)
                image(tile.x + x, tile.y + y) = view.surface(layout(x, y)).emission;
    }
    return image;
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
void TiledRender<B, Engine, E, MakeScheduler>::finish(const Film& film) {
    const Stopwatch watch(result_.statistics.seconds.film);
    result_.direct = film.develop(direct_layer);
    result_.emission = film.develop(emission_layer);
    result_.indirect = film.develop(indirect_layer);
    for (std::size_t l = first_bounce_layer; l < film.layers(); ++l)
        result_.bounces.push_back(film.develop(l));
    result_.beauty = result_.emission;
    for (std::size_t i = 0; i < result_.beauty.pixels().size(); ++i)
        result_.beauty.pixels()[i] += result_.direct.pixels()[i] + result_.indirect.pixels()[i];
}

}  // namespace mir
