// SPDX-License-Identifier: MIT
#pragma once

#include "mir/for_each_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/runtime/pass_seed.hpp"
#include "mir/runtime/render_context.hpp"
#include "mir/sampling/probe_rays.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/direct_samples.hpp"

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace mir {

/// Measures the noise of direct light in a pixel, at two thousand places
/// spread over the image.
/// Bits depend on scene, settings and seed alone.
template <Bsdf B, class Engine, Executor E>
class DirectNoise {
 public:
    using Context = RenderContext<B, Engine, E>;  ///< of the render

    /// What is passed in must outlive it.
    DirectNoise(const Context& context, const LightTable& lights)
        : context_(context),
          lights_(lights),
          rays_{context.rays.camera, context.aspect(), places, context.settings.seed} {}

    /// Standard deviation of a pixel's direct light over the light itself, root mean square over
    /// the places, 0 to 1.4: 0 where all of it is summed exactly or where there is none. Pixels
    /// much darker than the mean weigh less. `samples` of each luxel. On the context's executor.
    [[nodiscard]] double measure(DirectSamples samples) const {
        BlockedGBuffer<typename B::Params> luxels(rays_.cells(), rays_.cells());
        fill_gbuffer<B>(luxels, 0, rays_, context_.engine.ray_caster(), context_.surfaces,
                        context_.executor);
        return relative_noise(estimate(luxels, samples, 1), estimate(luxels, samples, 2));
    }

 private:
    static constexpr std::uint32_t places = 2048;

    /// Mean luminance of all luxels of a pixel, as if all lay at one place; of each place.
    [[nodiscard]] std::vector<double> estimate(const BlockedGBuffer<typename B::Params>& luxels,
                                               DirectSamples samples, std::uint64_t which) const {
        const auto visibility = context_.engine.visibility();
        const LuxelGrid grid = luxel_grid(luxels.extent(), context_.settings.luxels_per_pixel);
        const LuxelLight<B, std::remove_cv_t<decltype(visibility)>> light{
            {lights_, visibility, samples.emitters},
            {lights_, visibility},
            {lights_, visibility, samples.environment},
            {0, grid, pass_seed(context_.settings.seed, which)},
            samples.distant_vpls};
        std::vector<double> means(static_cast<std::size_t>(luxels.extent().area()));
        for_each_luxel(
            luxels, context_.executor,
            [&](std::uint32_t x, std::uint32_t y, const auto& place, LuxelIndex i) {
                const Hit hit = place.hit(i);
                if (is_empty(hit)) return;
                double sum = 0.0;
                for (std::uint32_t cell = 0; cell < grid.per_pixel(); ++cell)
                    sum += static_cast<double>(luminance(
                        light(hit, place.surface(i), x * grid.per_pixel_x + cell % grid.per_pixel_x,
                              y * grid.per_pixel_y + cell / grid.per_pixel_x)));
                means[y * luxels.extent().width + x] = sum / grid.per_pixel();
            });
        return means;
    }

    /// From two independent estimates of every place.
    static double relative_noise(const std::vector<double>& a, const std::vector<double>& b) {
        double all = 0.0;
        double lit = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            all += 0.5 * (a[i] + b[i]);
            if (a[i] + b[i] > 0.0) ++lit;
        }
        if (!(lit > 0.0)) return 0.0;
        const double dim = 0.1 * all / lit;
        double squares = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double mean = 0.5 * (a[i] + b[i]);
            const double variance = 0.5 * (a[i] - b[i]) * (a[i] - b[i]);
            squares += variance / (mean * mean + dim * dim);
        }
        return std::sqrt(squares / lit);
    }

    Context context_;
    const LightTable& lights_;
    ProbeRays rays_;
};

}  // namespace mir
