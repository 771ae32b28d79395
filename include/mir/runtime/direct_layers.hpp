// SPDX-License-Identifier: MIT
#pragma once

#include "mir/direct_light.hpp"
#include "mir/runtime/render_job.hpp"
#include "mir/runtime/stopwatch.hpp"

namespace mir {

/// Emission that the luxels of a G-buffer send to the viewer, W m^-2 sr^-1.
template <TiledGBuffer G, Executor E>
Image<Rgb> seen_emission(const G& gbuffer, E& executor) {
    Image<Rgb> image(gbuffer.extent());
    for_each_luxel(gbuffer, executor,
                   [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
                       image(x, y) = luxels.surface(i).emission;
                   });
    return image;
}

/// Appends the direct light of a band, with `samples` points on lamps per luxel, and its emission:
/// the layers that every integrator shares, as FilmLayer counts them.
template <Bsdf B, class Engine, Executor E>
void append_direct_layers(RenderJob<B, Engine, E>& job, const ImageBand<B, KeptBy<Engine>>& band,
                          std::uint32_t samples, std::vector<Image<Rgb>>& layers) {
    const Stopwatch watch(job.result.statistics.seconds.direct);
    layers.push_back(direct_light<B>(band.gbuffer, job.lights, job.engine.visibility(),
                                     {band.first_row, job.rays.grid, job.settings.seed}, samples,
                                     job.geometry.ray_offset(), job.executor));
    layers.push_back(seen_emission(band.gbuffer, job.executor));
}

}  // namespace mir
