// SPDX-License-Identifier: MIT
#pragma once

#include "mir/direct_light.hpp"
#include "mir/glossy_light.hpp"
#include "mir/reshade.hpp"
#include "mir/runtime/any_engine.hpp"
#include "mir/runtime/direct_noise.hpp"
#include "mir/runtime/film_layers.hpp"
#include "mir/runtime/luxel_coverage.hpp"
#include "mir/runtime/missing_light.hpp"
#include "mir/runtime/render_job.hpp"
#include "mir/runtime/residual_light.hpp"
#include "mir/vsl_light.hpp"

namespace mir {

/// Where the picture of a render grows, in the host's memory: makes the layers of one band of
/// luxels after the other, and pixels of them. All of it is for one thread at a time, which spreads
/// the work through the job's executor. The job must outlive it.
template <Bsdf B, class Engine, Executor E, class MakeScheduler>
class HostCanvas {
 public:
    using Job = RenderJob<B, Engine, E>;                   ///< whose result it fills
    using Band = typename ImageBands<B, Engine, E>::Band;  ///< luxels in the host's memory
    /// Radiance towards the viewer of the luxels of a band, W m^-2 sr^-1.
    using Layer = Image<Rgb>;
    using TakesVplDetails = void;  ///< offers spheres() and glossy()

    /// For `layers` layers in the order of FilmLayer. `make_scheduler(executor, monitor)` returns
    /// the Scheduler that light() traces with.
    HostCanvas(Job& job, MakeScheduler make_scheduler, std::size_t layers)
        : job_(job),
          make_scheduler_(make_scheduler),
          film_(job.rays.grid, job.settings.filter, job.settings.seed, layers) {}

    /// No light.
    [[nodiscard]] Layer black(const Band& band) const { return Layer(band.gbuffer.extent()); }

    /// Next-event light from lamps and environment, and light without extent.
    [[nodiscard]] Layer direct(const Band& band, DirectSamples samples) const {
        return direct_light<B>(band.gbuffer, job_.lights, job_.engine.visibility(),
                               {band.first_row, job_.rays.grid, job_.settings.seed}, samples,
                               job_.executor);
    }

    /// What the luxels themselves emit, and the environment where they see nothing else.
    [[nodiscard]] Layer emission(const Band& band) const;

    /// White where luxels see a surface.
    [[nodiscard]] Layer coverage(const Band& band) const {
        return luxel_coverage(band.gbuffer, job_.executor);
    }

    /// Light of VPLs: from the band's visibility where it is known, by tracing otherwise.
    template <Shading F>
    [[nodiscard]] Layer light(const Band& band, VplSpan<Space::host> vpls, const F& shading,
                              Monitor* monitor) const {
        const auto scheduler = make_scheduler_(job_.executor, monitor);
        if (band.visibility)
            return reshade(scheduler, band.gbuffer, vpls, *band.visibility, shading);
        if constexpr (LoopEngine<Engine, B, E>)
            return job_.engine.reconstruct(scheduler, band.gbuffer, vpls, shading);
        else
            return reconstruct(scheduler, band.gbuffer, vpls, job_.engine.visibility(), shading);
    }

    /// The same of spheres around the VPLs, of these radii, from the band's visibility.
    [[nodiscard]] Layer spheres(const Band& band, VplSpan<Space::host> vpls,
                                std::span<const float> radii, const VslShading<B>& shading,
                                Monitor* monitor) const {
        Layer layer =
            vsl_light(band.gbuffer, *band.visibility, vpls, radii, shading, job_.executor);
        if (monitor != nullptr) monitor->contributions += band.extent().area() * vpls.size();
        return layer;
    }

    /// The same of VPLs with lobes.
    [[nodiscard]] Layer glossy(const Band& band, VplSpan<Space::host> vpls,
                               std::span<const VplLobe<B>> lobes, const GlossyShading<B>& shading,
                               Monitor* monitor) const {
        Layer layer =
            glossy_light(band.gbuffer, *band.visibility, vpls, lobes, shading, job_.executor);
        if (monitor != nullptr) monitor->contributions += band.extent().area() * vpls.size();
        return layer;
    }

    /// Adds what `bound` removed, traced back, to the layers of a band, and returns it.
    Layer add_residual(const Band& band, float bound, std::vector<Layer>& layers) const {
        const AnyEngine engine(job_.engine);
        const auto context = job_.context().through(engine);
        return ResidualLight<B, AnyEngine, E>(context, job_.lights, bound).add_to(layers, band);
    }

    /// What VPLs leave out under `bound`, m^-2; the largest number for none.
    [[nodiscard]] MissingShares missing(float bound) const {
        const AnyEngine engine(job_.engine);
        const auto context = job_.context().through(engine);
        return MissingLight<B, AnyEngine, E>(context, job_.lights, bound).measure();
    }

    /// What DirectNoise measures of these samples.
    [[nodiscard]] double direct_noise(DirectSamples samples) const {
        const AnyEngine engine(job_.engine);
        const auto context = job_.context().through(engine);
        return DirectNoise<B, AnyEngine, E>(context, job_.lights).measure(samples);
    }

    /// sum += layer.
    void add(Layer& sum, const Layer& layer) const {
        job_.executor.for_each(sum.height(), [&](std::size_t row) {
            const auto y = static_cast<std::uint32_t>(row);
            for (std::uint32_t x = 0; x < sum.width(); ++x) sum(x, y) += layer(x, y);
        });
    }

    /// Sum of the luminance of each row's luxels, from left to right.
    [[nodiscard]] std::vector<double> row_luminances(const Layer& layer) const;

    /// Puts the layers of a band on the film, and its guides into the result.
    void put(const Band& band, const std::vector<Layer>& layers) {
        {
            const auto stage = job_.clock.measure(&StageSeconds::film);
            film_.add_rows(job_.executor, band.first_row, layers);
        }
        job_.add_guides_of(band);
    }

    /// Makes the images of the result.
    void finish() { develop_layers(film_, job_.context(), job_.result); }

 private:
    Job& job_;
    MakeScheduler make_scheduler_;
    Film film_;
};

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
auto HostCanvas<B, Engine, E, MakeScheduler>::emission(const Band& band) const -> Layer {
    Layer image(band.gbuffer.extent());
    const EnvironmentView<Space::host> environment = job_.lights.environment().view();
    for_each_luxel(
        band.gbuffer, job_.executor,
        [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
            const bool escaped = !environment.empty() && is_empty(luxels.hit(i));
            image(x, y) = escaped ? environment.radiance(job_.rays(x, band.first_row + y).direction)
                                  : luxels.surface(i).emission;
        });
    return image;
}

template <Bsdf B, class Engine, Executor E, class MakeScheduler>
std::vector<double> HostCanvas<B, Engine, E, MakeScheduler>::row_luminances(
    const Layer& layer) const {
    std::vector<double> rows(layer.height());
    job_.executor.for_each(rows.size(), [&](std::size_t row) {
        for (std::uint32_t x = 0; x < layer.width(); ++x)
            rows[row] += static_cast<double>(luminance(layer(x, static_cast<std::uint32_t>(row))));
    });
    return rows;
}

}  // namespace mir
