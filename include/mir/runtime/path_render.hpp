// SPDX-License-Identifier: MIT
#pragma once

#include "mir/reference/trace_reference.hpp"
#include "mir/runtime/film_layers.hpp"
#include "mir/runtime/luxel_coverage.hpp"
#include "mir/runtime/picture_bytes.hpp"
#include "mir/runtime/render_job.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace mir {

/// One render by the reference path tracer with the luxels, film and layers of a TiledRender, so
/// that the two results compare layer by layer. `Engine` offers ray_caster() and visibility().
template <Bsdf B, class Engine, Executor E>
class PathRender {
 public:
    /// What is passed in must outlive it; `monitor` may be null.
    PathRender(const Scene& scene, const RenderSettings& settings, const WorldGeometry& geometry,
               const Engine& engine, E& executor, Monitor* monitor, StageClock& clock)
        : job_(scene, settings, geometry, engine, executor, monitor, clock) {}

    /// Renders; to be called once.
    /// @throws Error(invalid_argument) for options out of range, and what the engine throws.
    RenderResult run();

 private:
    [[nodiscard]] ReferenceImage trace();
    [[nodiscard]] std::vector<Image<Rgb>> layers_of(const ReferenceImage& reference,
                                                    Image<Rgb> coverage) const;
    /// Guides go to the result, white where luxels see a surface to the image that is returned.
    [[nodiscard]] Image<Rgb> add_guides_of_image();

    RenderJob<B, Engine, E> job_;
};

template <Bsdf B, class Engine, Executor E>
RenderResult PathRender<B, Engine, E>::run() {
    check_picture(
        job_.settings,
        first_bounce_layer +
            (job_.settings.bounce_layers ? std::size_t{job_.settings.bounce_limit()} : 0));
    const ReferenceImage reference = trace();
    RenderStatistics& s = job_.result.statistics;
    s.luxels = job_.rays.grid.luxels().area();
    s.camera_paths = saturating_mul(s.luxels, job_.settings.path.samples);
    s.emitted_power = static_cast<float>(job_.lights.power());
    const std::vector<Image<Rgb>> layers = layers_of(reference, add_guides_of_image());
    Film film(job_.rays.grid, job_.settings.filter, job_.settings.seed, layers.size());
    {
        const auto stage = job_.clock.measure(&StageSeconds::film);
        film.add_rows(job_.executor, 0, layers);
    }
    develop_layers(film, job_.context(), job_.result);
    return job_.take_result();
}

template <Bsdf B, class Engine, Executor E>
ReferenceImage PathRender<B, Engine, E>::trace() {
    const auto stage = job_.clock.measure(&StageSeconds::paths);
    PathTracerOptions options;
    options.light = job_.settings.path.light;
    options.directions = job_.settings.path.directions;
    options.max_bounce = job_.settings.max_bounce;
    using Tracer =
        PathTracer<B, decltype(job_.engine.ray_caster()), decltype(job_.engine.visibility())>;
    const Tracer tracer({job_.geometry, job_.lights, job_.surfaces, job_.engine.ray_caster(),
                         job_.engine.visibility()},
                        options);
    ReferenceOptions wanted;
    wanted.samples = job_.settings.path.samples;
    wanted.replicates = 1;
    wanted.last_bounce =
        job_.settings.bounce_layers ? job_.settings.bounce_limit() : std::uint8_t{1};
    return trace_reference(tracer, job_.rays, wanted, job_.executor);
}

template <Bsdf B, class Engine, Executor E>
std::vector<Image<Rgb>> PathRender<B, Engine, E>::layers_of(const ReferenceImage& reference,
                                                            Image<Rgb> coverage) const {
    std::vector<Image<Rgb>> layers{reference.bounce(1), reference.bounce(0), std::move(coverage),
                                   reference.beauty()};
    const auto indirect = layers[indirect_layer].pixels();
    for (std::size_t i = 0; i < indirect.size(); ++i)
        indirect[i] =
            indirect[i] - layers[direct_layer].pixels()[i] - layers[emission_layer].pixels()[i];
    if (job_.settings.bounce_layers)
        for (std::uint8_t b = 1; b <= reference.last_bounce(); ++b)
            layers.push_back(reference.bounce(b));
    return layers;
}

template <Bsdf B, class Engine, Executor E>
Image<Rgb> PathRender<B, Engine, E>::add_guides_of_image() {
    const ImageBands<B, Engine, E> bands(job_.context(), 0);
    Image<Rgb> coverage(job_.rays.grid.luxels());
    for (std::uint32_t i = 0; i < bands.count(); ++i) {
        const auto band = bands.make(i);
        job_.add_guides_of(band);
        const Image<Rgb> rows = luxel_coverage(band.gbuffer, job_.executor);
        std::copy(rows.pixels().begin(), rows.pixels().end(),
                  coverage.pixels().begin() + std::size_t{band.first_row} * coverage.width());
    }
    return coverage;
}

}  // namespace mir
