// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/film_layers.hpp"
#include "mir/runtime/render_job.hpp"
#include "mir/shading/direct_samples.hpp"

namespace mir {

/// Where the picture of a render grows, in the memory of an engine that keeps its luxels: what
/// HostCanvas is on the host. Layers never leave the engine, pixels come home when they are done.
/// For one thread at a time. The job must outlive it.
template <Bsdf B, BandEngine Engine, Executor E>
class EngineCanvas {
 public:
    using Job = RenderJob<B, Engine, E>;   ///< whose result it fills
    using Band = KeptBand<Engine>;         ///< luxels in the engine's memory
    using Layer = typename Engine::Layer;  ///< radiance of luxels, W m^-2 sr^-1

    /// For `layers` layers in the order of FilmLayer. No scheduler is made: engines have their own.
    template <class MakeScheduler>
    EngineCanvas(Job& job, const MakeScheduler& /*make_scheduler*/, std::size_t layers)
        : job_(job), layers_(static_cast<std::uint32_t>(layers)) {}

    /// No light.
    [[nodiscard]] Layer black(const Band& band) const { return job_.engine.black(band.luxels); }
    /// Next-event light from lamps and environment, and light without extent.
    [[nodiscard]] Layer direct(const Band& band, DirectSamples samples) const {
        return job_.engine.direct(band.luxels, job_.lights,
                                  {band.first_row, job_.rays.grid, job_.settings.seed}, samples);
    }
    /// What the luxels themselves emit, and the environment where they see nothing else.
    [[nodiscard]] Layer emission(const Band& band) const {
        return job_.engine.emission(band.luxels, job_.lights.environment(), job_.rays,
                                    band.first_row);
    }
    /// White where luxels see a surface.
    [[nodiscard]] Layer coverage(const Band& band) const {
        return job_.engine.coverage(band.luxels);
    }
    /// Light of VPLs: from the band's visibility where it is known, by tracing otherwise.
    template <Shading F>
    [[nodiscard]] Layer light(const Band& band, VplSpan<Space::host> vpls, const F& shading,
                              Monitor* monitor) const {
        return job_.engine.light(band.luxels, vpls, shading, monitor);
    }
    /// sum += layer.
    void add(Layer& sum, const Layer& layer) const { job_.engine.add(sum, layer); }
    /// Sum of the luminance of each row's luxels, from left to right, W m^-2 sr^-1.
    [[nodiscard]] std::vector<double> row_luminances(const Layer& layer) const {
        return job_.engine.row_luminances(layer);
    }

    /// Puts the layers of a band on the film, from top to bottom, and its guides into the result.
    /// The first band is the highest.
    void put(const Band& band, std::vector<Layer>& layers) {
        // The first band is the highest.
        if (!picture_) {
            const auto stage = job_.clock.measure(&StageSeconds::film);
            picture_.emplace(
                job_.engine.picture(band.extent(), job_.rays, job_.settings.filter, layers_));
        }
        {
            const auto stage = job_.clock.measure(&StageSeconds::film);
            job_.engine.film(*picture_, band.first_row, layers);
        }
        {
            const auto stage = job_.clock.measure(&StageSeconds::guides);
            job_.engine.guides(*picture_, band.luxels);
        }
        const auto stage = job_.clock.measure(&StageSeconds::download);
        job_.engine.bring_home(*picture_, job_.result.guides);
    }

    /// Makes the images of the result, once every band was put there; at most once.
    void finish() {
        const auto stage = job_.clock.measure(&StageSeconds::film);
        take_layers(job_.engine.develop(*picture_), job_.settings.removed_layer, job_.result,
                    job_.executor);
    }

 private:
    Job& job_;
    std::uint32_t layers_;
    std::optional<typename Engine::Picture> picture_;
};

}  // namespace mir
