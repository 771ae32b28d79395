// SPDX-License-Identifier: MIT
#include "runtime/caustic_light.hpp"

#include "mir/reference/path_tracer.hpp"
#include "mir/runtime/film_layer.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace mir {
namespace {

CausticPaths paths_of(const RenderSettings& s) {
    const std::uint64_t paths = saturating_mul(s.caustics, s.image.area());
    return {paths, s.bounce_limit(), s.sequence, s.seed};
}

template <Bsdf B>
std::vector<CausticSplat> traced(RenderFrame& frame, const SurfaceTable<B>& surfaces) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    return CausticTracer(job.lights, LightWalk<B, AnyRayCaster>{surfaces.view(), rays.ray_caster()},
                         rays.visibility(),
                         {job.rays.camera.optics(), job.aspect(), job.rays.grid.luxels()})
        .trace(paths_of(job.settings), job.executor);
}

PathTracerOptions residual_of(const RenderSettings& s) {
    PathTracerOptions options;
    options.paths = PathPart::residual;
    options.max_bounce = s.bounce_limit();
    options.directions = s.caustics;
    return options;
}

/// Of the luxels that are seen in mirrors or through bodies of glass: no light path meets those.
template <Bsdf B>
std::vector<CausticSplat> traced_back(RenderFrame& frame, const SurfaceTable<B>& surfaces) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    const LuxelTracer luxels{rays.ray_caster(), surfaces.view()};
    const PathTracer<B, AnyRayCaster, AnyVisibility> paths(
        {job.geometry, job.lights, surfaces, rays.ray_caster(), rays.visibility()},
        residual_of(job.settings));
    const Extent size = job.rays.grid.luxels();
    std::vector<std::vector<CausticSplat>> rows(size.height);
    job.executor.for_each(size.height, [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        std::array<RgbSum, 256> bounces;
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const SeenLuxel seen = luxels.luxel(job.rays, x, y);
            if (seen.is_background || seen.is_straight) continue;
            bounces.fill({});
            Random random(job.settings.seed, Stream::caustic, ~(std::uint64_t{y} * size.width + x));
            paths.trace({luxels.hit(seen), luxels.surface(seen)}, random, bounces);
            for (std::uint32_t b = 1; b < bounces.size(); ++b)
                if (const Rgb light = bounces[b].rgb(); !is_black(light))
                    rows[row].push_back({x, y, static_cast<std::uint8_t>(b), light});
        }
    });
    std::vector<CausticSplat> all;
    for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
}

void keep_statistics(RenderJob& job, const std::vector<CausticSplat>& splats) {
    RenderStatistics& s = job.result.statistics;
    s.caustic_paths = paths_of(job.settings).paths;
    double sum = 0.0;
    for (const CausticSplat& splat : splats) sum += static_cast<double>(luminance(splat.radiance));
    s.caustic_luminance = sum / static_cast<double>(job.rays.grid.luxels().area());
}

}  // namespace

CausticLight::CausticLight(RenderFrame& frame) {
    RenderJob& job = frame.job();
    if (job.settings.caustics == 0) return;
    const auto stage = job.clock.measure(&StageSeconds::caustics);
    splats_ = job.with_surfaces([&](const auto& surfaces) {
        std::vector<CausticSplat> all;
        if (!surfaces.bends_rays() || job.lights.empty()) return all;
        all = traced(frame, surfaces);
        const std::vector<CausticSplat> back = traced_back(frame, surfaces);
        all.insert(all.end(), back.begin(), back.end());
        return all;
    });
    if (splats_.empty()) return;
    keep_statistics(job, splats_);
    std::stable_sort(splats_.begin(), splats_.end(),
                     [](const CausticSplat& a, const CausticSplat& b) { return a.y < b.y; });
}

void CausticLight::add(RenderFrame& by, const FrameBand& band,
                       std::vector<LayerPtr>& layers) const {
    const std::uint32_t end = band.first_row + band.extent().height;
    const auto row_before = [](const CausticSplat& s, std::uint32_t y) { return s.y < y; };
    const auto first = std::lower_bound(splats_.begin(), splats_.end(), band.first_row, row_before);
    const auto last = std::lower_bound(first, splats_.end(), end, row_before);
    if (first == last) return;
    const auto add_where = [&](FrameLayer& layer, const auto& wanted) {
        Image<Rgb> light(band.extent());
        for (auto s = first; s != last; ++s)
            if (wanted(s->bounce)) light(s->x, s->y - band.first_row) += s->radiance;
        by.add(layer, *by.layer_of(band, std::move(light)));
    };
    add_where(*layers[direct_layer], [](std::uint8_t bounce) { return bounce == 1; });
    add_where(*layers[indirect_layer], [](std::uint8_t bounce) { return bounce > 1; });
    const std::size_t bounces = layers.size() - first_bounce_layer;
    for (std::size_t b = 1; b < bounces; ++b)
        add_where(*layers[first_bounce_layer + b], [&](std::uint8_t bounce) {
            return bounce == b + 1 || (b + 1 == bounces && bounce > bounces);
        });
}

}  // namespace mir
