// SPDX-License-Identifier: MIT
#pragma once

#include "mir/for_each_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/runtime/film_layers.hpp"
#include "mir/runtime/image_bands.hpp"
#include "mir/scene/light_table.hpp"

#include <array>

namespace mir {

/// The light that the bound keeps VPLs from giving to luxels, traced back by paths that leave each
/// luxel as its BSDF says: f cos max(0, 1 - b/G) / p times the light that the point they meet sends
/// back, which is that of a path tracer without bound. Unbiased; surfaces met reflect with their
/// full BSDF, so what is added is what the bound removed where those are Lambertian, as VPLs are,
/// or where VPLs keep a lobe that was not widened. Source: Kollig and Keller, "Illumination in the
/// presence of weak singularities", MCQMC 2004, with paths in place of the recursion. Bits depend
/// on seed and luxel alone.
template <Bsdf B, class Engine, Executor E>
class ResidualLight {
 public:
    using Context = RenderContext<B, Engine, E>;  ///< of the render

    /// What is missing under `bound`, m^-2. What is passed in must outlive it.
    ResidualLight(const Context& context, const LightTable& lights, float bound)
        : context_(context),
          tracer_({context.geometry, lights, context.surfaces, context.engine.ray_caster(),
                   context.engine.visibility()},
                  options_of(context.settings, bound)) {}

    /// Adds the light to the layers of a band: to that of the indirect light, and to those of the
    /// bounces where there are any. Returns it, W m^-2 sr^-1.
    Image<Rgb> add_to(std::vector<Image<Rgb>>& layers, const ImageBand<B>& band) const {
        const LuxelBand rows{band.first_row, context_.rays.grid, context_.settings.seed};
        Image<Rgb> light(band.extent());
        for_each_luxel(band.gbuffer, context_.executor,
                       [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
                           const Hit hit = luxels.hit(i);
                           if (is_empty(hit)) return;
                           const Bounces bounces =
                               trace({hit, luxels.surface(i)},
                                     rows.luxel_numbers(x, y, Stream::residual));
                           RgbSum sum;
                           for (std::uint32_t b = 1; b <= context_.settings.bounce_limit(); ++b)
                               sum += bounces[b];
                           light(x, y) = sum.rgb();
                           layers[indirect_layer](x, y) += light(x, y);
                           for (std::size_t l = first_bounce_layer; l < layers.size(); ++l)
                               layers[l](x, y) += bounces[l - first_bounce_layer + 1].rgb();
                       });
        return light;
    }

 private:
    using Tracer = PathTracer<B, decltype(std::declval<const Engine&>().ray_caster()),
                              decltype(std::declval<const Engine&>().visibility())>;
    using Bounces = std::array<RgbSum, 256>;  ///< by scattering events

    static PathTracerOptions options_of(const RenderSettings& settings, float bound) {
        PathTracerOptions options;
        options.directions = settings.compensate_per_luxel();
        options.max_bounce = settings.bounce_limit();
        options.bound = bound;
        options.part = BoundPart::removed;
        options.bound_lamps = settings.direct == DirectLight::vpl;
        return options;
    }

    [[nodiscard]] Bounces trace(const typename Tracer::Vertex& luxel, Random random) const {
        Bounces bounces{};
        tracer_.trace(luxel, random,
                      std::span(bounces).first(std::size_t{context_.settings.bounce_limit()} + 1));
        return bounces;
    }

    Context context_;
    Tracer tracer_;
};

}  // namespace mir
