// SPDX-License-Identifier: MIT
#pragma once

#include "mir/reference/trace_reference.hpp"
#include "mir/runtime/film_layers.hpp"
#include "mir/runtime/image_bands.hpp"
#include "mir/scene/light_table.hpp"

namespace mir {

/// One render by the reference path tracer with the luxels, film and layers of a TiledRender, so
/// that the two results compare layer by layer. `Engine` offers ray_caster() and visibility().
template <Bsdf B, class Engine, Executor E>
class PathRender {
 public:
    PathRender(const Scene& scene, const RenderSettings& settings, const WorldGeometry& geometry,
               const Engine& engine, E& executor, Monitor* monitor)
        : settings_(settings),
          geometry_(geometry),
          engine_(engine),
          executor_(executor),
          monitor_(monitor),
          lights_(scene, geometry),
          surfaces_(scene),
          rays_{scene.cameras[settings.camera],
                luxel_grid(settings.image, settings.luxels_per_pixel, settings.limits),
                settings.seed} {
        result_.guides = Guides(settings.image);
    }

    RenderResult run();

 private:
    using Context = RenderContext<B, Engine, E>;

    [[nodiscard]] Context context() {
        return {settings_, geometry_, surfaces_, rays_,
                engine_,   executor_, monitor_,  result_.statistics.seconds};
    }
    [[nodiscard]] ReferenceImage trace();
    [[nodiscard]] std::vector<Image<Rgb>> layers_of(const ReferenceImage& reference) const;
    void add_guides_of_image();

    const RenderSettings& settings_;
    const WorldGeometry& geometry_;
    const Engine& engine_;
    E& executor_;
    Monitor* monitor_;
    LightTable lights_;
    SurfaceTable<B> surfaces_;
    CameraRays rays_;
    RenderResult result_{{}, {}, {}, {}, {}, Guides({1, 1}), {}, {}, {}};
};

template <Bsdf B, class Engine, Executor E>
RenderResult PathRender<B, Engine, E>::run() {
    const ReferenceImage reference = trace();
    RenderStatistics& s = result_.statistics;
    s.luxels = rays_.grid.luxels().area();
    s.camera_paths = saturating_mul(s.luxels, settings_.path.samples);
    s.emitted_power = static_cast<float>(lights_.power());
    add_guides_of_image();
    const std::vector<Image<Rgb>> layers = layers_of(reference);
    Film film(rays_.grid, settings_.filter, settings_.seed, layers.size());
    {
        const Stopwatch watch(s.seconds.film);
        film.add_rows(executor_, 0, layers);
    }
    develop_layers(film, result_);
    return std::move(result_);
}

template <Bsdf B, class Engine, Executor E>
ReferenceImage PathRender<B, Engine, E>::trace() {
    const Stopwatch watch(result_.statistics.seconds.paths);
    PathTracerOptions options;
    options.light = settings_.path.light;
    options.directions = settings_.path.directions;
    options.max_bounce = settings_.max_bounce;
    using Tracer = PathTracer<B, decltype(engine_.ray_caster()), decltype(engine_.visibility())>;
    const Tracer tracer({geometry_, lights_, surfaces_, engine_.ray_caster(), engine_.visibility()},
                        options);
    ReferenceOptions wanted;
    wanted.samples = settings_.path.samples;
    wanted.replicates = 1;
    wanted.last_bounce = settings_.bounce_layers ? settings_.max_bounce : std::uint8_t{1};
    return trace_reference(tracer, rays_, wanted, executor_);
}

template <Bsdf B, class Engine, Executor E>
std::vector<Image<Rgb>> PathRender<B, Engine, E>::layers_of(const ReferenceImage& reference) const {
    std::vector<Image<Rgb>> layers{reference.bounce(1), reference.bounce(0), reference.beauty()};
    const auto indirect = layers[indirect_layer].pixels();
    for (std::size_t i = 0; i < indirect.size(); ++i)
        indirect[i] =
            indirect[i] - layers[direct_layer].pixels()[i] - layers[emission_layer].pixels()[i];
    if (settings_.bounce_layers)
        for (std::uint8_t b = 1; b <= reference.last_bounce(); ++b)
            layers.push_back(reference.bounce(b));
    return layers;
}

template <Bsdf B, class Engine, Executor E>
void PathRender<B, Engine, E>::add_guides_of_image() {
    const ImageBands<B, Engine, E> bands(context(), 0);
    for (std::uint32_t i = 0; i < bands.count(); ++i) {
        const ImageBand<B> band = bands.make(i);
        add_guides(
            result_.guides, band.gbuffer, band.first_row, rays_.grid, rays_.camera,
            [](const auto& s) { return B::albedo(s.bsdf, s.normal, s.wo); }, executor_);
    }
}

}  // namespace mir
