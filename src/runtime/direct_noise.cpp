// SPDX-License-Identifier: MIT
#include "runtime/direct_noise.hpp"

#include "mir/for_each_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/runtime/pass_seed.hpp"
#include "mir/shading/sky_tries.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace mir {
namespace {

constexpr std::uint32_t places = 2048;

/// Guides to the sky as of blocks whose luxels all lie at one place, row by row; from one set of
/// tries. None where there is no use for them.
template <class Luxels>
std::vector<SkyGuide> sky_guides_at(RenderJob& job, const AnyVisibility& visibility,
                                    const Luxels& luxels, DirectSamples samples) {
    if (!samples.want_sky_guide() || job.lights.environment().empty()) return {};
    const Extent extent = luxels.extent();
    const LuxelBand numbers{0, luxel_grid(extent, 1), job.settings.seed};
    const SkyTries<AnyVisibility> tries(job.lights.view(), visibility);
    std::vector<SkyGuide> guides(static_cast<std::size_t>(extent.area()));
    for_each_luxel(luxels, job.executor,
                   [&](std::uint32_t x, std::uint32_t y, const auto& place, LuxelIndex i) {
                       const Hit hit = place.hit(i);
                       if (is_empty(hit)) return;
                       const Random random = numbers.luxel_numbers(x, y, Stream::sky);
                       SkyTried tried;
                       for (std::uint32_t k = 0; k < SkyTried::side; ++k)
                           tried.seen[k] = tries(hit, k, 0, random);
                       guides[std::size_t{y} * extent.width + x] = SkyGuide(&tried, 1, 1);
                   });
    return guides;
}

/// Mean luminance of all luxels of a pixel, as if all lay at one place. Of each place.
template <Bsdf B>
std::vector<double> estimate(RenderJob& job, AnyVisibility visibility,
                             const BlockedGBuffer<typename B::Params>& luxels,
                             DirectSamples samples, const std::vector<SkyGuide>& skies,
                             std::uint64_t which) {
    const LuxelGrid grid = luxel_grid(luxels.extent(), job.settings.luxels_per_pixel);
    const LuxelLight<B, AnyVisibility> light(job.lights, visibility, samples,
                                             {0, grid, pass_seed(job.settings.seed, which)});
    std::vector<double> means(static_cast<std::size_t>(luxels.extent().area()));
    for_each_luxel(
        luxels, job.executor,
        [&](std::uint32_t x, std::uint32_t y, const auto& place, LuxelIndex i) {
            const Hit hit = place.hit(i);
            if (is_empty(hit)) return;
            const std::size_t at = std::size_t{y} * luxels.extent().width + x;
            const SkyGuide* const sky = skies.empty() ? nullptr : &skies[at];
            double sum = 0.0;
            for (std::uint32_t cell = 0; cell < grid.per_pixel(); ++cell)
                sum += static_cast<double>(luminance(
                    light(hit, place.surface(i), x * grid.per_pixel_x + cell % grid.per_pixel_x,
                          y * grid.per_pixel_y + cell / grid.per_pixel_x, sky)));
            means[at] = sum / grid.per_pixel();
        });
    return means;
}

/// From two independent estimates of every place.
double relative_noise(const std::vector<double>& a, const std::vector<double>& b) {
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

}  // namespace

double direct_noise(RenderFrame& frame, DirectSamples samples) {
    RenderJob& job = frame.job();
    const AnyEngine& rays = frame.rays();
    const ProbeRays probes{job.rays.camera, job.aspect(), places, job.settings.seed};
    return job.with_surfaces([&]<Bsdf B>(const SurfaceTable<B>& surfaces) {
        BlockedGBuffer<typename B::Params> luxels(probes.cells(), probes.cells());
        fill_gbuffer<B>(luxels, 0, probes, rays.ray_caster(), surfaces, job.executor);
        const AnyVisibility visibility = rays.visibility();
        const std::vector<SkyGuide> skies = sky_guides_at(job, visibility, luxels, samples);
        return relative_noise(estimate<B>(job, visibility, luxels, samples, skies, 1),
                              estimate<B>(job, visibility, luxels, samples, skies, 2));
    });
}

}  // namespace mir
