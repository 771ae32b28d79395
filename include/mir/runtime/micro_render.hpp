// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/film.hpp"
#include "mir/micro/gather_light.hpp"
#include "mir/micro/make_surfels.hpp"
#include "mir/micro/material_albedo.hpp"
#include "mir/micro/surfel_bounces.hpp"
#include "mir/micro/surfel_tree_build.hpp"
#include "mir/runtime/direct_layers.hpp"
#include "mir/runtime/film_layers.hpp"

namespace mir {

/// One render whose indirect light is gathered from a hierarchy of discs, with the luxels, direct
/// light, film and layers of a TiledRender. `Engine` offers ray_caster() and visibility().
template <Bsdf B, class Engine, Executor E>
class MicroRender {
 public:
    /// What is passed in must outlive it; `monitor` may be null.
    MicroRender(const Scene& scene, const RenderSettings& settings, const WorldGeometry& geometry,
                const Engine& engine, E& executor, Monitor* monitor)
        : job_(scene, settings, geometry, engine, executor, monitor) {}

    RenderResult run();

 private:
    using Radiance = std::vector<SurfelRadiance>;
    using Band = typename ImageBands<B, Engine, E>::Band;

    [[nodiscard]] SurfelTree make_tree();
    [[nodiscard]] std::vector<Radiance> light(const SurfelTree& tree);
    void render_band(Film& film, const Band& band, const SurfelTree& tree,
                     const std::vector<Radiance>& sources);
    void append_indirect(const Band& band, const SurfelTree& tree,
                         const std::vector<Radiance>& sources, std::vector<Image<Rgb>>& layers);

    RenderJob<B, Engine, E> job_;
};

template <Bsdf B, class Engine, Executor E>
RenderResult MicroRender<B, Engine, E>::run() {
    RenderStatistics& s = job_.result.statistics;
    s.luxels = job_.rays.grid.luxels().area();
    s.emitted_power = static_cast<float>(job_.lights.power());
    const SurfelTree tree = make_tree();
    const std::vector<Radiance> sources = light(tree);
    s.surfels = tree.surfels().size();
    const ImageBands<B, Engine, E> bands(job_.context(), 0);
    const std::size_t bounces = job_.settings.bounce_layers ? sources.size() + 1 : 0;
    Film film(job_.rays.grid, job_.settings.filter, job_.settings.seed,
              std::size_t{first_bounce_layer} + bounces);
    for (std::uint32_t i = 0; i < bands.count(); ++i)
        render_band(film, bands.make(i), tree, sources);
    develop_layers(film, job_.result);
    return std::move(job_.result);
}

template <Bsdf B, class Engine, Executor E>
SurfelTree MicroRender<B, Engine, E>::make_tree() {
    const Stopwatch watch(job_.result.statistics.seconds.surfels);
    SurfelOptions options;
    const double area = surface_area(job_.geometry) / job_.settings.micro.surfels;
    if (area > 0.0) options.max_area = static_cast<float>(area);
    return {make_surfels(job_.geometry, options, job_.settings.limits, job_.executor),
            material_albedo(job_.surfaces), SurfelTreeOptions{}, job_.executor};
}

/// What luxels gather from: bounce by bounce where each has a layer, else the sum; nothing when
/// light may be reflected once alone.
template <Bsdf B, class Engine, Executor E>
auto MicroRender<B, Engine, E>::light(const SurfelTree& tree) -> std::vector<Radiance> {
    if (job_.settings.max_bounce < 2) return {};
    const Stopwatch watch(job_.result.statistics.seconds.sampling);
    const MicroSettings& m = job_.settings.micro;
    SurfelBounceOptions options;
    options.last = static_cast<std::uint8_t>(job_.settings.max_bounce - 1);
    options.gather = m.gather;
    options.gather.rays = m.surfel_rays;
    // Fewer rays are wider; they still stop where those of luxels do.
    options.gather.threshold *=
        static_cast<float>(m.surfel_rays) / static_cast<float>(m.gather.rays);
    options.seed = job_.settings.seed;
    const float offset = job_.geometry.ray_offset();
    const SurfelDirectLight direct(job_.lights, job_.engine.visibility(),
                                   job_.settings.direct_samples, offset, job_.settings.seed);
    std::vector<Radiance> bounces = surfel_bounces(tree, direct, offset, options, job_.executor);
    if (job_.settings.bounce_layers) return bounces;
    return {sum_of(bounces)};
}

template <Bsdf B, class Engine, Executor E>
void MicroRender<B, Engine, E>::render_band(Film& film, const Band& band, const SurfelTree& tree,
                                            const std::vector<Radiance>& sources) {
    std::vector<Image<Rgb>> layers;
    append_direct_layers(job_, band, job_.settings.direct_samples_per_luxel(), layers);
    append_indirect(band, tree, sources, layers);
    RenderStatistics& s = job_.result.statistics;
    for (const Rgb& c : layers[indirect_layer].pixels())
        s.indirect_luminance += luminance(c) / static_cast<double>(s.luxels);
    const Stopwatch watch(s.seconds.film);
    film.add_rows(job_.executor, band.first_row, layers);
    job_.add_guides_of(band);
}

/// The sum of all bounces, and behind it each of them, the direct light first, where asked for.
template <Bsdf B, class Engine, Executor E>
void MicroRender<B, Engine, E>::append_indirect(const Band& band, const SurfelTree& tree,
                                                const std::vector<Radiance>& sources,
                                                std::vector<Image<Rgb>>& layers) {
    const Stopwatch watch(job_.result.statistics.seconds.gather);
    layers.emplace_back(band.gbuffer.extent());
    if (job_.settings.bounce_layers) layers.push_back(layers[direct_layer]);
    for (const Radiance& source : sources) {
        const Image<Rgb> light =
            gather_light<B>(band.gbuffer, tree, source, job_.settings.micro.gather,
                            {band.first_row, job_.rays.grid, job_.settings.seed}, job_.executor);
        const auto sum = layers[indirect_layer].pixels();
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += light.pixels()[i];
        if (job_.settings.bounce_layers) layers.push_back(light);
    }
}

}  // namespace mir
