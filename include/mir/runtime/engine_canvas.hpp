// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/film_layers.hpp"
#include "mir/runtime/render_job.hpp"

namespace mir {

/// Where the picture of a render grows, in the memory of an engine that keeps its luxels: what
/// HostCanvas is on the host. Layers never leave the engine, pixels come home when they are done.
/// For one thread at a time. The job must outlive it.
template <Bsdf B, BandEngine Engine, Executor E>
class EngineCanvas {
 public:
    using Job = RenderJob<B, Engine, E>;
    using Band = KeptBand<Engine>;
    using Layer = typename Engine::Layer;

    template <class MakeScheduler>
    EngineCanvas(Job& job, const MakeScheduler& /*make_scheduler*/, std::size_t layers)
        : job_(job), layers_(static_cast<std::uint32_t>(layers)) {}

    [[nodiscard]] Layer black(const Band& band) const { return job_.engine.black(band.luxels); }
    [[nodiscard]] Layer direct(const Band& band, std::uint32_t samples) const {
        return job_.engine.direct(band.luxels, job_.lights,
                                  {band.first_row, job_.rays.grid, job_.settings.seed}, samples);
    }
    [[nodiscard]] Layer emission(const Band& band) const {
        return job_.engine.emission(band.luxels, job_.lights.environment(), job_.rays,
                                    band.first_row);
    }
    template <Shading F>
    [[nodiscard]] Layer light(const Band& band, VplSpan<Space::host> vpls, const F& shading,
                              Monitor* monitor) const {
        return job_.engine.light(band.luxels, vpls, shading, monitor);
    }
    void add(Layer& sum, const Layer& layer) const { job_.engine.add(sum, layer); }
    [[nodiscard]] std::vector<double> row_luminances(const Layer& layer) const {
        return job_.engine.row_luminances(layer);
    }

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
