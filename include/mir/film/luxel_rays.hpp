// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/random.hpp"
#include "mir/data/specular_plan.hpp"
#include "mir/film/luxel_grid.hpp"
#include "mir/scene/camera_optics.hpp"

namespace mir {

/// The camera rays of an image as kernels make them. One per luxel, a pure function of its place
/// and the seed. CameraRays::luxel_rays() makes it. Host and device: see CameraOptics.
struct LuxelRays {
    CameraOptics optics;     ///< of the camera
    LuxelGrid grid;          ///< of the whole image
    std::uint64_t seed = 0;  ///< of the places on film and lens

    /// Ray of the luxel at (x, y) of the whole luxel image.
    [[nodiscard]] MIR_HD Ray operator()(std::uint32_t x, std::uint32_t y) const {
        const Extent pixels = grid.pixels;
        const Vec2 position = grid.position(x, y, seed);
        const float aspect = static_cast<float>(pixels.width) / static_cast<float>(pixels.height);
        Random random(seed, Stream::lens, std::uint64_t{y} * grid.luxels().width + x);
        return optics.ray({position.x / static_cast<float>(pixels.width),
                           position.y / static_cast<float>(pixels.height)},
                          aspect, random.next_2d());
    }

    /// What the specular chain of that ray begins with. The luxels of a pixel draw by evenly spaced
    /// numbers: an event as likely as one luxel of them has one.
    [[nodiscard]] MIR_HD SpecularPlan specular_plan(std::uint32_t x, std::uint32_t y) const {
        const std::uint32_t n = grid.per_pixel();
        if (n == 1) return {};
        const std::uint32_t px = x / grid.per_pixel_x, py = y / grid.per_pixel_y;
        const std::uint32_t k = y % grid.per_pixel_y * grid.per_pixel_x + x % grid.per_pixel_x;
        const float own = 1.0f / static_cast<float>(n);
        const float shift =
            Random(seed, Stream::specular_chain, std::uint64_t{py} * grid.pixels.width + px).next();
        const float first = shift + static_cast<float>(k) * own;
        return {first < 1.0f ? first : first - 1.0f, smaller(own, 0.25f)};
    }
};

}  // namespace mir
