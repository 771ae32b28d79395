// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/gather_light.hpp"
#include "mir/micro/make_surfels.hpp"
#include "mir/micro/surfel_albedo.hpp"
#include "mir/micro/surfel_bounces.hpp"
#include "mir/micro/surfel_direct_light.hpp"
#include "mir/micro/surfel_tree_build.hpp"
#include "mir/micro/triangle_gather.hpp"
#include "mir/runtime/host_canvas.hpp"

namespace mir {

/// One render whose indirect light is gathered from a hierarchy of discs, with the luxels, direct
/// light, film and layers of a TiledRender. `Engine` offers ray_caster() and visibility(), and
/// gather(gbuffer, tree, radiance, options, band, done) where it gathers by itself: done(n) is
/// called after every portion of n luxels and may throw.
template <Bsdf B, class Engine, Executor E>
class MicroRender {
 public:
    /// What is passed in must outlive it; `monitor` may be null.
    MicroRender(const Scene& scene, const RenderSettings& settings, const WorldGeometry& geometry,
                const Engine& engine, E& executor, Monitor* monitor, StageClock& clock)
        : job_(scene, settings, geometry, engine, executor, monitor, clock) {}

    /// Renders; to be called once.
    /// @throws Error(cancelled), Error(limit_exceeded) when discs or their links pass the limits,
    ///         and what the engine throws.
    RenderResult run();

 private:
    /// No VPL lights this picture.
    struct NoScheduler {};

    using Radiance = std::vector<SurfelRadiance>;
    using EngineRays = TriangleRays<decltype(std::declval<const Engine&>().ray_caster())>;
    using Canvas = HostCanvas<B, Engine, E, NoScheduler>;
    using Band = typename Canvas::Band;

    /// The discs, and where they lie if rays go to the triangles.
    struct Discs {
        SurfelTree tree;
        std::optional<SurfelPlaces> places;
    };

    [[nodiscard]] Discs make_discs();
    [[nodiscard]] std::vector<Radiance> light(const Discs& discs);
    void render_band(Canvas& canvas, const Band& band, const Discs& discs,
                     const std::vector<Radiance>& sources);
    [[nodiscard]] Image<Rgb> gather(const Band& band, const Discs& discs, const Radiance& source);
    void append_indirect(const Band& band, const Discs& discs, const std::vector<Radiance>& sources,
                         std::vector<Image<Rgb>>& layers);

    RenderJob<B, Engine, E> job_;
};

template <Bsdf B, class Engine, Executor E>
RenderResult MicroRender<B, Engine, E>::run() {
    RenderStatistics& s = job_.result.statistics;
    s.luxels = job_.rays.grid.luxels().area();
    s.emitted_power = static_cast<float>(job_.lights.power());
    const Discs discs = make_discs();
    const std::vector<Radiance> sources = light(discs);
    s.surfels = discs.tree.surfels().size();
    if (job_.monitor != nullptr)
        job_.monitor->planned_gathers = saturating_mul(s.luxels, sources.size());
    const ImageBands<B, Engine, E> bands(job_.context(), 0);
    const std::size_t bounces = job_.settings.bounce_layers ? sources.size() + 1 : 0;
    Canvas canvas(job_, NoScheduler{}, std::size_t{first_bounce_layer} + bounces);
    for (std::uint32_t i = 0; i < bands.count(); ++i)
        render_band(canvas, bands.make(i), discs, sources);
    canvas.finish();
    return job_.take_result();
}

template <Bsdf B, class Engine, Executor E>
auto MicroRender<B, Engine, E>::make_discs() -> Discs {
    const auto stage = job_.clock.measure(&StageSeconds::surfels);
    SurfelOptions options;
    const double area = surface_area(job_.geometry) / job_.settings.micro.surfels;
    if (area > 0.0) options.max_area = static_cast<float>(area);
    Discs discs{{make_surfels(job_.geometry, options, job_.settings.limits, job_.executor),
                 SurfelAlbedo<B>(job_.surfaces, job_.geometry), SurfelTreeOptions{}, job_.executor},
                std::nullopt};
    if (job_.settings.micro.luxels == MicroGather::exact)
        discs.places.emplace(discs.tree, job_.geometry);
    return discs;
}

/// What luxels gather from: bounce by bounce where each has a layer, else the sum; nothing when
/// light may be reflected once alone.
template <Bsdf B, class Engine, Executor E>
auto MicroRender<B, Engine, E>::light(const Discs& discs) -> std::vector<Radiance> {
    if (job_.settings.bounce_limit() < 2) return {};
    const auto stage = job_.clock.measure(&StageSeconds::sampling);
    const MicroSettings& m = job_.settings.micro;
    SurfelBounceOptions options;
    options.last = static_cast<std::uint8_t>(job_.settings.bounce_limit() - 1);
    options.gather = m.gather;
    options.gather.rays = m.surfel_rays;
    options.gather.directions = GatherDirections::cosine;
    // Fewer rays are wider; they still stop where those of luxels do.
    options.gather.threshold *=
        static_cast<float>(m.surfel_rays) / static_cast<float>(m.directions());
    options.seed = job_.settings.seed;
    options.limits = job_.settings.limits;
    const float offset = job_.geometry.ray_offset();
    using Caster = typename EngineRays::Caster;
    using Sight = decltype(job_.engine.visibility());
    const SurfelDirectLight<B, Caster, Sight> direct(
        {job_.geometry, job_.lights, job_.surfaces, job_.engine.ray_caster(),
         job_.engine.visibility()},
        job_.settings.direct_samples, job_.settings.seed);
    const auto by = [&](const auto& rays) {
        return surfel_bounces(discs.tree, direct, rays, offset, options, job_.executor);
    };
    std::vector<Radiance> bounces =
        discs.places ? by(EngineRays{job_.engine.ray_caster(), &*discs.places})
                     : by(TreeRays<Space::host>{discs.tree.view(), options.gather.shape});
    if (job_.settings.bounce_layers) return bounces;
    return {sum_of(bounces)};
}

template <Bsdf B, class Engine, Executor E>
void MicroRender<B, Engine, E>::render_band(Canvas& canvas, const Band& band, const Discs& discs,
                                            const std::vector<Radiance>& sources) {
    std::vector<Image<Rgb>> layers;
    {
        const auto stage = job_.clock.measure(&StageSeconds::direct);
        layers.push_back(canvas.direct(band, job_.settings.direct_samples_per_luxel()));
        layers.push_back(canvas.emission(band));
    }
    append_indirect(band, discs, sources, layers);
    RenderStatistics& s = job_.result.statistics;
    for (const double row : canvas.row_luminances(layers[indirect_layer]))
        s.indirect_luminance += row / static_cast<double>(s.luxels);
    canvas.put(band, layers);
}

/// By the engine where it gathers itself, else on the executor.
template <Bsdf B, class Engine, Executor E>
Image<Rgb> MicroRender<B, Engine, E>::gather(const Band& band, const Discs& discs,
                                             const Radiance& source) {
    const MicroSettings& m = job_.settings.micro;
    const LuxelBand rows{band.first_row, job_.rays.grid, job_.settings.seed};
    const auto done = [monitor = job_.monitor](std::uint64_t luxels) {
        if (monitor == nullptr) return;
        monitor->gathers.fetch_add(luxels, std::memory_order_relaxed);
        monitor->check();
    };
    GatherOptions options = m.gather;
    if (m.luxels == MicroGather::exact) options.threshold = 0.0f;
    if constexpr (requires {
                      job_.engine.gather(band.gbuffer, discs.tree, source, options, rows, done);
                  }) {
        const auto by = [&](const auto& with) {
            return job_.engine.gather(band.gbuffer, discs.tree, source, with, rows, done);
        };
        return m.luxels == MicroGather::buffers ? by(m.buffer()) : by(options);
    } else {
        if (m.luxels == MicroGather::exact) {
            const TriangleGather<typename EngineRays::Caster, B> by_triangles{
                {job_.engine.ray_caster(), &*discs.places}, source.data(), options};
            return gather_light(band.gbuffer, by_triangles, rows, job_.executor, done);
        }
        const auto by = [&](const auto& with) {
            return gather_light<B>(band.gbuffer, discs.tree, source, with, rows, job_.executor,
                                   done);
        };
        return m.luxels == MicroGather::buffers ? by(m.buffer()) : by(options);
    }
}

/// The sum of all bounces, and behind it each of them, the direct light first, where asked for.
template <Bsdf B, class Engine, Executor E>
void MicroRender<B, Engine, E>::append_indirect(const Band& band, const Discs& discs,
                                                const std::vector<Radiance>& sources,
                                                std::vector<Image<Rgb>>& layers) {
    const auto stage = job_.clock.measure(&StageSeconds::gather);
    layers.emplace_back(band.gbuffer.extent());
    if (job_.settings.bounce_layers) layers.push_back(layers[direct_layer]);
    for (const Radiance& source : sources) {
        const Image<Rgb> light = gather(band, discs, source);
        const auto sum = layers[indirect_layer].pixels();
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += light.pixels()[i];
        if (job_.settings.bounce_layers) layers.push_back(light);
    }
}

}  // namespace mir
