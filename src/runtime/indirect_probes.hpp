// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/frame.hpp"
#include "mir/core/warp.hpp"
#include "mir/for_each_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/sampling/probe_rays.hpp"
#include "runtime/render_frame.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace mir {

/// Some two thousand luxels at which light of discs and of paths is compared. They are spread over
/// the image. Bits depend on scene, settings, seed and the discs alone.
template <Bsdf B>
class IndirectProbes {
 public:
    /// Traces the camera rays, as all others by rays of the host. What is passed in must outlive
    /// it.
    IndirectProbes(RenderJob& job, const SurfaceTable<B>& surfaces, const AnyEngine& rays)
        : job_(job),
          caster_(rays.ray_caster()),
          tracer_({job.geometry, job.lights, surfaces, caster_, rays.visibility()},
                  options_of(job.settings)),
          rays_{job.rays.camera, job.aspect(), places, job.settings.seed},
          luxels_(rays_.cells(), rays_.cells()) {
        fill_gbuffer<B>(luxels_, 0, rays_, caster_, surfaces, job.executor);
    }

    /// One in each cell of a grid on the film, at a random place. Empty where a ray meets nothing.
    [[nodiscard]] const BlockedGBuffer<typename B::Params>& luxels() const { return luxels_; }

    /// Their random numbers.
    [[nodiscard]] LuxelBand numbers() const {
        return {0, luxel_grid(luxels_.extent(), 1), job_.settings.seed};
    }

    /// By how much light gathered from discs exceeds that of paths, W m^-2 sr^-1. Of 2 to
    /// bounce_limit() scattering events towards the viewer, in two estimates independent of each
    /// other. Both go along the same rays to what the luxel sees, `sent(point)` being the radiance
    /// that the discs send out there: so what few rays find is in both, and its noise in neither.
    template <class Sent>
    [[nodiscard]] std::array<Image<Rgb>, 2> excess(const Sent& sent) const {
        std::array<Image<Rgb>, 2> halves{Image<Rgb>(luxels_.extent()),
                                         Image<Rgb>(luxels_.extent())};
        for_each_luxel(luxels_, job_.executor,
                       [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
                           const Hit hit = luxels.hit(i);
                           if (is_empty(hit)) return;
                           Random random = numbers().luxel_numbers(x, y, Stream::missing);
                           for (Image<Rgb>& half : halves)
                               half(x, y) = mean_excess(hit, luxels.surface(i), sent, random);
                       });
        return halves;
    }

 private:
    using Tracer = PathTracer<B, AnyRayCaster, AnyVisibility>;
    static constexpr std::uint32_t places = 2048;

    static constexpr std::uint32_t rays_each = 24;

    static PathTracerOptions options_of(const RenderSettings& settings) {
        PathTracerOptions options;
        options.max_bounce = static_cast<std::uint8_t>(std::max(settings.bounce_limit() - 1, 1));
        return options;
    }

    /// Over rays by the cosine, as luxels gather.
    template <class Sent>
    [[nodiscard]] Rgb mean_excess(const Hit& hit, const Surface<typename B::Params>& s,
                                  const Sent& sent, Random& random) const {
        const Frame frame = Frame::around(s.normal);
        RgbSum sum;
        for (std::uint32_t k = 0; k < rays_each; ++k) {
            const Vec3 local = square_to_cosine_hemisphere(random.next_2d());
            const Ray ray{hit.position, frame.to_world(local)};
            if (!(local.z > 0.0f) || !(glm::dot(ray.direction, hit.normal) > 0.0f)) continue;
            const auto point = caster_.closest_hit(ray);
            const auto next = tracer_.luxel(ray);
            if (!point) continue;
            std::array<RgbSum, 2> bounces{};
            tracer_.trace(next, random, bounces);
            sum += (sent(*point) - bounces[1].rgb()) *
                   B::eval(s.bsdf, s.normal, ray.direction, s.wo) *
                   (local.z / cosine_hemisphere_pdf(local.z));
        }
        return (sum * (1.0 / rays_each)).rgb();
    }

    RenderJob& job_;
    AnyRayCaster caster_;
    Tracer tracer_;
    ProbeRays rays_;
    BlockedGBuffer<typename B::Params> luxels_;
};

}  // namespace mir
