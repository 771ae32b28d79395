// SPDX-License-Identifier: MIT
#pragma once

#include "mir/for_each_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/runtime/render_context.hpp"
#include "mir/sampling/probe_rays.hpp"
#include "mir/scene/light_table.hpp"

#include <array>
#include <utility>

namespace mir {

/// Some two thousand luxels, spread over the image, whose indirect light paths find. What else
/// finds that light is compared with them. Bits depend on scene, settings and seed alone.
template <Bsdf B, class Engine, Executor E>
class IndirectProbes {
 public:
    using Context = RenderContext<B, Engine, E>;  ///< of the render

    /// Traces the camera rays. What is passed in must outlive it.
    IndirectProbes(const Context& context, const LightTable& lights)
        : context_(context),
          tracer_({context.geometry, lights, context.surfaces, context.engine.ray_caster(),
                   context.engine.visibility()},
                  options_of(context.settings)),
          rays_{context.rays.camera, context.aspect(), places, context.settings.seed},
          luxels_(rays_.cells(), rays_.cells()) {
        fill_gbuffer<B>(luxels_, 0, rays_, context.engine.ray_caster(), context.surfaces,
                        context.executor);
    }

    /// One in each cell of a grid on the film, at a random place; empty where a ray meets nothing.
    [[nodiscard]] const BlockedGBuffer<typename B::Params>& luxels() const { return luxels_; }

    /// Their random numbers.
    [[nodiscard]] LuxelBand numbers() const {
        return {0, luxel_grid(luxels_.extent(), 1), context_.settings.seed};
    }

    /// Light of 2 to bounce_limit() scattering events towards the viewer, W m^-2 sr^-1, in two
    /// estimates independent of each other.
    [[nodiscard]] std::array<Image<Rgb>, 2> light() const {
        std::array<Image<Rgb>, 2> halves{Image<Rgb>(luxels_.extent()),
                                         Image<Rgb>(luxels_.extent())};
        for_each_luxel(luxels_, context_.executor,
                       [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
                           const Hit hit = luxels.hit(i);
                           if (is_empty(hit)) return;
                           Random random = numbers().luxel_numbers(x, y, Stream::missing);
                           for (Image<Rgb>& half : halves)
                               half(x, y) = trace({hit, luxels.surface(i)}, random);
                       });
        return halves;
    }

 private:
    using Tracer = PathTracer<B, decltype(std::declval<const Engine&>().ray_caster()),
                              decltype(std::declval<const Engine&>().visibility())>;
    static constexpr std::uint32_t places = 2048;

    static PathTracerOptions options_of(const RenderSettings& settings) {
        PathTracerOptions options;
        options.directions = 24;
        options.max_bounce = settings.bounce_limit();
        return options;
    }

    [[nodiscard]] Rgb trace(const typename Tracer::Vertex& luxel, Random& random) const {
        std::array<RgbSum, 3> bounces{};
        tracer_.trace(luxel, random, bounces);
        return bounces[2].rgb();
    }

    Context context_;
    Tracer tracer_;
    ProbeRays rays_;
    BlockedGBuffer<typename B::Params> luxels_;
};

}  // namespace mir
