// SPDX-License-Identifier: MIT
#include "runtime/residual_light.hpp"

#include "mir/for_each_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/runtime/film_layer.hpp"

#include <array>

namespace mir {
namespace {

using Bounces = std::array<RgbSum, 256>;  ///< by scattering events

PathTracerOptions options_of(const RenderSettings& settings, float bound) {
    PathTracerOptions options;
    options.directions = settings.compensate_per_luxel();
    options.max_bounce = settings.bounce_limit();
    options.bound = bound;
    options.part = BoundPart::removed;
    options.bound_lamps = settings.direct == DirectLight::vpl;
    return options;
}

/// By paths of a tracer from luxels of its model.
template <class Tracer, class GBuffer>
Image<Rgb> add_traced(RenderJob& job, const Tracer& tracer, const GBuffer& gbuffer,
                      std::uint32_t first_row, std::span<Image<Rgb>* const> layers) {
    const LuxelBand rows{first_row, job.rays.grid, job.settings.seed};
    const std::uint32_t last = job.settings.bounce_limit();
    Image<Rgb> light(gbuffer.extent());
    for_each_luxel(gbuffer, job.executor,
                   [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
                       const Hit hit = luxels.hit(i);
                       if (is_empty(hit)) return;
                       Random random = rows.luxel_numbers(x, y, Stream::residual);
                       Bounces bounces{};
                       tracer.trace({hit, luxels.surface(i)}, random,
                                    std::span(bounces).first(std::size_t{last} + 1));
                       RgbSum sum;
                       for (std::uint32_t b = 1; b <= last; ++b) sum += bounces[b];
                       light(x, y) = sum.rgb();
                       (*layers[indirect_layer])(x, y) += light(x, y);
                       for (std::size_t l = first_bounce_layer; l < layers.size(); ++l)
                           (*layers[l])(x, y) += bounces[l - first_bounce_layer + 1].rgb();
                   });
    return light;
}

}  // namespace

Image<Rgb> add_residual_light(RenderFrame& frame, const AnyLuxels& luxels, std::uint32_t first_row,
                              float bound, std::span<Image<Rgb>* const> layers) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    return std::visit(
        [&]<Bsdf B>(const LuxelsOf<B>& of) {
            const PathTracer<B, AnyRayCaster, AnyVisibility> tracer(
                {job.geometry, job.lights, std::get<SurfaceTable<B>>(job.surfaces),
                 rays.ray_caster(), rays.visibility()},
                options_of(job.settings, bound));
            return add_traced(job, tracer, of.gbuffer, first_row, layers);
        },
        luxels);
}

}  // namespace mir
