// SPDX-License-Identifier: MIT
#include "runtime/render_paths.hpp"

#include "mir/reference/trace_reference.hpp"
#include "mir/runtime/picture_bytes.hpp"
#include "runtime/film_layers.hpp"
#include "runtime/host_band.hpp"
#include "runtime/image_bands.hpp"

#include <utility>

namespace mir {
namespace {

/// The light of the luxels of a band.
ReferenceImage trace(RenderFrame& frame, const FrameBand& band) {
    RenderJob& job = frame.job();
    const RenderSettings& s = job.settings;
    const auto stage = job.clock.measure(&StageSeconds::paths);
    PathTracerOptions options;
    options.light = s.path.light;
    options.directions = s.path.directions;
    options.max_bounce = s.max_bounce;
    ReferenceOptions wanted;
    wanted.samples = s.path.samples;
    wanted.replicates = 1;
    wanted.last_bounce = s.bounce_layers ? s.bounce_limit() : std::uint8_t{1};
    wanted.rows = {band.first_row, band.extent().height};
    const AnyEngine& rays = frame.rays();
    return job.with_surfaces([&]<Bsdf B>(const SurfaceTable<B>& surfaces) {
        const PathTracer<B, AnyRayCaster, AnyVisibility> tracer(
            {job.geometry, job.lights, surfaces, rays.ray_caster(), rays.visibility()}, options);
        return trace_reference(tracer, job.rays, wanted, job.executor);
    });
}

/// All but the coverage, in the order of FilmLayer.
std::vector<Image<Rgb>> layers_of(const ReferenceImage& reference, bool bounces) {
    std::vector<Image<Rgb>> layers{
        reference.bounce(1), reference.bounce(0), {}, reference.beauty()};
    const auto indirect = layers[indirect_layer].pixels();
    for (std::size_t i = 0; i < indirect.size(); ++i)
        indirect[i] =
            indirect[i] - layers[direct_layer].pixels()[i] - layers[emission_layer].pixels()[i];
    if (bounces)
        for (std::uint8_t b = 1; b <= reference.last_bounce(); ++b)
            layers.push_back(reference.bounce(b));
    return layers;
}

}  // namespace

RenderResult render_paths(RenderFrame& frame) {
    RenderJob& job = frame.job();
    const bool by_bounce = job.settings.bounce_layers;
    check_picture(job.settings,
                  first_bounce_layer + (by_bounce ? std::size_t{job.settings.bounce_limit()} : 0));
    RenderStatistics& s = job.result.statistics;
    s.luxels = job.rays.grid.luxels().area();
    s.camera_paths = saturating_mul(s.luxels, job.settings.path.samples);
    s.emitted_power = static_cast<float>(job.lights.power());
    const ImageBands bands = ImageBands::of_rows(frame, 0);
    job.begin_bands(bands.count());
    frame.for_each_band(bands.count(), [&](RenderFrame& by, std::uint32_t i, BandTurn& turn) {
        job.begin_band();
        const BandPtr band = bands.make(by, i);
        std::vector<LayerPtr> layers;
        for (Image<Rgb>& image : layers_of(trace(by, *band), by_bounce))
            layers.push_back(layers.size() == coverage_layer ? by.coverage(*band)
                                                             : host_layer(std::move(image)));
        turn.wait();
        by.put(*band, std::move(layers), turn);
    });
    const auto stage = job.clock.measure(&StageSeconds::film);
    take_layers(frame.develop(), false, job.result, job.executor);
    return job.take_result();
}

}  // namespace mir
