// SPDX-License-Identifier: MIT
#include "runtime/caustics_on_host.hpp"

#include "mir/sampling/caustic_tracer.hpp"
#include "runtime/caustic_light.hpp"
#include "runtime/seen_caustics.hpp"

namespace mir {
namespace {

/// The layers of bounces 1, 2, ... at one luxel.
struct CausticLayersThere {
    std::span<Image<Rgb>* const> layers;
    std::uint32_t x;
    std::uint32_t y;

    void add(std::uint32_t bounce, Rgb light) const {
        const std::uint32_t b = caustic_layer(bounce, static_cast<std::uint32_t>(layers.size()));
        if (b < layers.size()) (*layers[b])(x, y) += light;
    }
};

}  // namespace

std::vector<CausticSplat> trace_caustics_on_host(RenderFrame& frame, const CausticPaths& paths,
                                                 std::uint64_t begin, std::uint64_t end) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    return job.with_surfaces([&]<Bsdf B>(const SurfaceTable<B>& surfaces) {
        const CausticTracer tracer(job.lights,
                                   LightWalk<B, AnyRayCaster>{surfaces.view(), rays.ray_caster()},
                                   rays.visibility(), caustic_view(job));
        return trace_caustics(tracer, paths, begin, end, job.executor);
    });
}

CausticImages seen_caustics_on_host(RenderFrame& frame, const FrameBand& band,
                                    std::span<Image<Rgb>* const> bounces) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    const Extent extent = band.extent();
    CausticImages seen{Image<Rgb>(extent), Image<Rgb>(extent)};
    job.with_surfaces([&]<Bsdf B>(const SurfaceTable<B>& surfaces) {
        const SeenCaustics<B, AnyRayCaster, AnyVisibility> caustics(
            {job.geometry, job.lights, surfaces, rays.ray_caster(), rays.visibility()},
            job.settings, job.rays.luxel_rays());
        job.executor.for_each(extent.height, [&](std::size_t row) {
            const auto y = static_cast<std::uint32_t>(row);
            for (std::uint32_t x = 0; x < extent.width; ++x) {
                const CausticRadiance light =
                    caustics(x, band.first_row + y, CausticLayersThere{bounces, x, y});
                seen.direct(x, y) = light.direct;
                seen.indirect(x, y) = light.indirect;
            }
        });
    });
    return seen;
}

}  // namespace mir
