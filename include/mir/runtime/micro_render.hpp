// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/gather_light.hpp"
#include "mir/micro/make_surfels.hpp"
#include "mir/micro/split_patches.hpp"
#include "mir/micro/surfel_albedo.hpp"
#include "mir/micro/surfel_bounces.hpp"
#include "mir/micro/surfel_direct_light.hpp"
#include "mir/micro/surfel_tree_build.hpp"
#include "mir/micro/triangle_gather.hpp"
#include "mir/runtime/host_canvas.hpp"
#include "mir/runtime/indirect_probes.hpp"
#include "mir/runtime/light_correction.hpp"
#include "mir/runtime/picture_bytes.hpp"

namespace mir {

/// One render whose indirect light is gathered from a hierarchy of discs, with the luxels, direct
/// light, film and layers of a TiledRender. `Engine` offers ray_caster() and visibility(), and
/// gather(gbuffer, tree, radiance, options, band, done) where it gathers by itself: done(n) is
/// called after every portion of n luxels and may throw. How far the gathered light lies from that
/// of paths is measured first, and the correction made (GatherCheck).
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
    static void add(Image<Rgb>& sum, const Image<Rgb>& light) {
        for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum.pixels()[i] += light.pixels()[i];
    }
    static std::vector<double> luminances_of(const Image<Rgb>& image) {
        std::vector<double> all;
        for (const Rgb& light : image.pixels())
            all.push_back(static_cast<double>(luminance(light)));
        return all;
    }

    /// No VPL lights this picture.
    struct NoScheduler {};

    using Radiance = std::vector<SurfelRadiance>;
    using EngineRays = TriangleRays<decltype(std::declval<const Engine&>().ray_caster())>;
    using Canvas = HostCanvas<B, Engine, E, NoScheduler>;
    using Band = typename Canvas::Band;

    /// The discs, and where they lie if rays go to the triangles, now or for a check.
    struct Discs {
        SurfelTree tree;
        std::optional<SurfelPlaces> places;
        float patch_area = 0.0f;  ///< of the largest patch, m^2
    };

    /// What luxels gather from.
    struct Sources {
        Discs discs;
        std::vector<Radiance> light;  ///< of the discs; luxels show the sum of all
    };

    [[nodiscard]] Discs make_discs();
    [[nodiscard]] std::vector<Radiance> light(const Discs& discs);
    void check(const Sources& sources);
    void render_band(Canvas& canvas, const Band& band, const Sources& sources);
    [[nodiscard]] Image<Rgb> gather(const BlockedGBuffer<typename B::Params>& gbuffer,
                                    const LuxelBand& rows, const Discs& discs,
                                    const Radiance& source);
    template <class Done = decltype(no_progress)>
    [[nodiscard]] Image<Rgb> gather_by_triangles(const BlockedGBuffer<typename B::Params>& gbuffer,
                                                 const LuxelBand& rows, const Discs& discs,
                                                 const Radiance& source,
                                                 const Done& done = no_progress);
    void correct(Image<Rgb>& light, const LuxelBand& rows);
    void append_indirect(const Band& band, const Sources& sources, std::vector<Image<Rgb>>& layers);

    RenderJob<B, Engine, E> job_;
    std::optional<LightCorrection> correction_;
};

template <Bsdf B, class Engine, Executor E>
RenderResult MicroRender<B, Engine, E>::run() {
    RenderStatistics& s = job_.result.statistics;
    s.luxels = job_.rays.grid.luxels().area();
    s.emitted_power = static_cast<float>(job_.lights.power());
    Sources sources{make_discs(), {}};
    sources.light = light(sources.discs);
    s.surfels = sources.discs.tree.surfels().size();
    if (job_.monitor != nullptr)
        job_.monitor->planned_gathers = saturating_mul(s.luxels, sources.light.size());
    if (job_.settings.micro.check != GatherCheck::none && !sources.light.empty()) check(sources);
    const ImageBands<B, Engine, E> bands(job_.context(), 0);
    const std::size_t bounces = job_.settings.bounce_layers ? sources.light.size() + 1 : 0;
    const std::size_t layers = std::size_t{first_bounce_layer} + bounces;
    check_picture(job_.settings, layers);
    Canvas canvas(job_, NoScheduler{}, layers);
    if (job_.settings.measure_missing) {
        const auto stage = job_.clock.measure(&StageSeconds::ledger);
        s.direct_noise = canvas.direct_noise(job_.settings.direct_samples_per_luxel());
    }
    for (std::uint32_t i = 0; i < bands.count(); ++i) {
        job_.begin_band(i, bands.count());
        render_band(canvas, bands.make(i), sources);
    }
    canvas.finish();
    return job_.take_result();
}

template <Bsdf B, class Engine, Executor E>
auto MicroRender<B, Engine, E>::make_discs() -> Discs {
    const auto stage = job_.clock.measure(&StageSeconds::surfels);
    SurfelOptions options;
    const double area = surface_area(job_.geometry) / job_.settings.micro.surfels;
    const bool exact = job_.settings.micro.luxels == MicroGather::exact;
    if (area > 0.0) options.max_area = static_cast<float>(exact ? area / 4.0 : area);
    Discs discs{{make_surfels(job_.geometry, options, job_.settings.limits, job_.executor),
                 SurfelAlbedo<B>(job_.surfaces, job_.geometry), SurfelTreeOptions{}, job_.executor},
                std::nullopt,
                area > 0.0 ? static_cast<float>(area) : options.max_area};
    if (exact || job_.settings.micro.check != GatherCheck::none)
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
    const typename SurfelDirectLight<B, Caster, Sight>::World world{
        job_.geometry, job_.lights, job_.surfaces, job_.engine.ray_caster(),
        job_.engine.visibility()};
    const SurfelDirectLight<B, Caster, Sight> sketch(world, 8, ~job_.settings.seed);
    const SurfelDirectLight<B, Caster, Sight> direct(world, job_.settings.direct_samples,
                                                     job_.settings.seed);
    const SurfelPatches patches =
        split_patches(SurfelPatches(discs.tree, SurfelPatchOptions{discs.patch_area}), sketch,
                      offset, job_.executor);
    job_.result.statistics.patches = patches.size();
    const auto by = [&](const auto& rays) {
        return surfel_bounces(patches, direct, rays, offset, options, job_.executor);
    };
    std::vector<Radiance> bounces =
        m.luxels == MicroGather::exact
            ? by(EngineRays{job_.engine.ray_caster(), &*discs.places})
            : by(TreeRays<Space::host>{discs.tree.view(), options.gather.shape});
    if (job_.settings.bounce_layers) return bounces;
    return {sum_of(bounces)};
}

/// Compares gathered light with that of paths at some luxels. Where rays do not end at triangles,
/// what that changes is found along the rays of the gather, the rest along those of the paths.
template <Bsdf B, class Engine, Executor E>
void MicroRender<B, Engine, E>::check(const Sources& sources) {
    const auto stage = job_.clock.measure(&StageSeconds::ledger);
    const IndirectProbes<B, Engine, E> probes(job_.context(), job_.lights);
    const SurfelPlaces& places = *sources.discs.places;
    const Radiance sum = sum_of(sources.light);
    auto [first, second] = probes.excess([&](const SurfacePoint& point) {
        return sum[places.leaf(point.triangle, point.barycentrics)].of(point.front);
    });
    if (job_.monitor != nullptr) job_.monitor->planned_gathers += probes.luxels().extent().area();
    const Image<Rgb> gathered = gather(probes.luxels(), probes.numbers(), sources.discs, sum);
    if (job_.settings.micro.luxels != MicroGather::exact) {
        const Image<Rgb> exact =
            gather_by_triangles(probes.luxels(), probes.numbers(), sources.discs, sum);
        for (std::size_t i = 0; i < exact.pixels().size(); ++i) {
            const Rgb stopped = gathered.pixels()[i] - exact.pixels()[i];
            first.pixels()[i] += stopped;
            second.pixels()[i] += stopped;
        }
    }
    Image<Rgb> truth(gathered.extent());
    for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
        first.pixels()[i] = gathered.pixels()[i] - first.pixels()[i];
        second.pixels()[i] = gathered.pixels()[i] - second.pixels()[i];
        truth.pixels()[i] = (first.pixels()[i] + second.pixels()[i]) * 0.5f;
    }
    const LightDifference difference =
        light_difference(luminances_of(gathered), luminances_of(first), luminances_of(second));
    job_.result.statistics.gather_difference = difference;
    // What few bright paths tell makes pictures worse.
    constexpr double most_error = 0.02;
    if (job_.settings.micro.check != GatherCheck::correct || difference.standard_error > most_error)
        return;
    correction_.emplace(gathered, truth, job_.executor);
    job_.result.statistics.gather_corrected = true;
}

template <Bsdf B, class Engine, Executor E>
void MicroRender<B, Engine, E>::render_band(Canvas& canvas, const Band& band,
                                            const Sources& sources) {
    std::vector<Image<Rgb>> layers;
    {
        const auto stage = job_.clock.measure(&StageSeconds::direct);
        layers.push_back(canvas.direct(band, job_.settings.direct_samples_per_luxel()));
        layers.push_back(canvas.emission(band));
        layers.push_back(canvas.coverage(band));
    }
    append_indirect(band, sources, layers);
    RenderStatistics& s = job_.result.statistics;
    for (const double row : canvas.row_luminances(layers[indirect_layer]))
        s.indirect_luminance += row / static_cast<double>(s.luxels);
    canvas.put(band, layers);
}

/// By the engine where it gathers itself, else on the executor.
template <Bsdf B, class Engine, Executor E>
Image<Rgb> MicroRender<B, Engine, E>::gather(const BlockedGBuffer<typename B::Params>& gbuffer,
                                             const LuxelBand& rows, const Discs& discs,
                                             const Radiance& source) {
    const MicroSettings& m = job_.settings.micro;
    const auto done = [monitor = job_.monitor](std::uint64_t luxels) {
        if (monitor == nullptr) return;
        monitor->gathers.fetch_add(luxels, std::memory_order_relaxed);
        monitor->check();
    };
    GatherOptions options = m.gather;
    if (m.luxels == MicroGather::exact) options.threshold = 0.0f;
    if constexpr (requires {
                      job_.engine.gather(gbuffer, discs.tree, source, options, rows, done);
                  }) {
        const auto by = [&](const auto& with) {
            return job_.engine.gather(gbuffer, discs.tree, source, with, rows, done);
        };
        return m.luxels == MicroGather::buffers ? by(m.buffer()) : by(options);
    } else {
        if (m.luxels == MicroGather::exact)
            return gather_by_triangles(gbuffer, rows, discs, source, done);
        const auto by = [&](const auto& with) {
            return gather_light<B>(gbuffer, discs.tree, source, with, rows, job_.executor, done);
        };
        return m.luxels == MicroGather::buffers ? by(m.buffer()) : by(options);
    }
}

template <Bsdf B, class Engine, Executor E>
template <class Done>
Image<Rgb> MicroRender<B, Engine, E>::gather_by_triangles(
    const BlockedGBuffer<typename B::Params>& gbuffer, const LuxelBand& rows, const Discs& discs,
    const Radiance& source, const Done& done) {
    // Micro-buffers have no rays of their own.
    const bool by_rays = job_.settings.micro.luxels != MicroGather::buffers;
    GatherOptions options = by_rays ? job_.settings.micro.gather : GatherOptions{};
    options.threshold = 0.0f;
    const TriangleGather<typename EngineRays::Caster, B> by_triangles{
        {job_.engine.ray_caster(), &*discs.places}, source.data(), options};
    return gather_light(gbuffer, by_triangles, rows, job_.executor, done);
}

template <Bsdf B, class Engine, Executor E>
void MicroRender<B, Engine, E>::correct(Image<Rgb>& light, const LuxelBand& rows) {
    if (!correction_) return;
    const auto width = static_cast<float>(rows.grid.luxels().width);
    const auto height = static_cast<float>(rows.grid.luxels().height);
    job_.executor.for_each(light.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        const float v = (static_cast<float>(rows.first_row + y) + 0.5f) / height;
        for (std::uint32_t x = 0; x < light.width(); ++x)
            light(x, y) = light(x, y) * (*correction_)((static_cast<float>(x) + 0.5f) / width, v);
    });
}

/// The sum of all bounces, and behind it each of them, the direct light first, where asked for.
template <Bsdf B, class Engine, Executor E>
void MicroRender<B, Engine, E>::append_indirect(const Band& band, const Sources& sources,
                                                std::vector<Image<Rgb>>& layers) {
    const auto stage = job_.clock.measure(&StageSeconds::gather);
    layers.emplace_back(band.gbuffer.extent());
    if (job_.settings.bounce_layers) layers.push_back(layers[direct_layer]);
    const LuxelBand rows{band.first_row, job_.rays.grid, job_.settings.seed};
    for (const Radiance& source : sources.light) {
        Image<Rgb> light = gather(band.gbuffer, rows, sources.discs, source);
        correct(light, rows);
        add(layers[indirect_layer], light);
        if (job_.settings.bounce_layers) layers.push_back(std::move(light));
    }
}

}  // namespace mir
