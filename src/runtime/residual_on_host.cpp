// SPDX-License-Identifier: MIT
#include "runtime/residual_on_host.hpp"

#include "mir/for_each_luxel.hpp"
#include "runtime/residual_light.hpp"

namespace mir {
namespace {

/// The layers of bounces 1, 2, ... at one luxel.
struct LayersThere {
    std::span<Image<Rgb>* const> layers;
    std::uint32_t x;
    std::uint32_t y;

    void add(std::uint32_t bounce, Rgb light) const {
        if (bounce - 1 < layers.size()) (*layers[bounce - 1])(x, y) += light;
    }
};

}  // namespace

Image<Rgb> residual_on_host(RenderFrame& frame, const AnyLuxels& luxels, std::uint32_t first_row,
                            float bound, std::span<Image<Rgb>* const> bounces) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    const LuxelBand band{first_row, job.rays.grid, job.settings.seed};
    return std::visit(
        [&]<Bsdf B>(const LuxelsOf<B>& of) {
            const ResidualLight<B, AnyRayCaster, AnyVisibility> light(
                {job.geometry, job.lights, std::get<SurfaceTable<B>>(job.surfaces),
                 rays.ray_caster(), rays.visibility()},
                job.settings, bound, band);
            Image<Rgb> image(of.gbuffer.extent());
            for_each_luxel(
                of.gbuffer, job.executor,
                [&](std::uint32_t x, std::uint32_t y, const auto& here, LuxelIndex i) {
                    const Hit hit = here.hit(i);
                    if (is_empty(hit)) return;
                    image(x, y) = light(hit, here.surface(i), x, y, LayersThere{bounces, x, y});
                });
            return image;
        },
        luxels);
}

}  // namespace mir
