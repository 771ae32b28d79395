// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/data/luxel.hpp"
#include "mir/film/luxel_grid.hpp"

namespace mir {

/// What Guides tell of one pixel.
struct GuidePixel {
    Rgb albedo;          ///< hemispherical reflectance, 0..1
    Vec3 normal{0};      ///< mean of shading normals, world space, not unit
    Vec3 position{0};    ///< of the first luxel that sees a surface, world space, metres
    float depth = 0.0f;  ///< from the lens plane, metres; 0: background
};

/// The plane that depth is measured from: Camera::depth() for kernels.
struct LensPlane {
    Vec3 position{0};    ///< a point of the plane: the camera's, world space, metres
    Vec3 back{0, 0, 1};  ///< unit

    /// Distance of `point` before the plane, metres; negative behind it.
    [[nodiscard]] MIR_HD float depth(Vec3 point) const { return glm::dot(position - point, back); }
};

/// The guides of a pixel from its luxels in raster order. `luxels.hit(x, y)` and `.surface(x, y)`
/// are those of a band that starts with row `y0` of the pixel at (x0, y0).
template <Bsdf B, class Luxels>
MIR_HD GuidePixel guides_of_pixel(const Luxels& luxels, const LuxelGrid& grid,
                                  const LensPlane& lens, std::uint32_t x0, std::uint32_t y0) {
    const float share = 1.0f / static_cast<float>(grid.per_pixel());
    GuidePixel pixel;
    for (std::uint32_t y = y0; y < y0 + grid.per_pixel_y; ++y)
        for (std::uint32_t x = x0; x < x0 + grid.per_pixel_x; ++x) {
            const Hit hit = luxels.hit(x, y);
            if (is_empty(hit)) continue;
            const auto s = luxels.surface(x, y);
            pixel.albedo += B::albedo(s.bsdf, s.normal, s.wo) * share;
            pixel.normal += s.normal * share;
            if (pixel.depth != 0.0f) continue;
            pixel.position = hit.position;
            pixel.depth = lens.depth(hit.position);
        }
    return pixel;
}

/// Kernel over the pixels of a band in row order: its guides.
template <Bsdf B, class Luxels>
struct GuidePass {
    Luxels luxels;             ///< of the band, by their places in it
    LuxelGrid grid;            ///< of the whole image
    LensPlane lens;            ///< that depth is measured from
    Rgb* albedo = nullptr;     ///< an element per pixel of the band, like the following
    Vec3* normal = nullptr;    ///< as in GuidePixel
    Vec3* position = nullptr;  ///< world space, metres
    float* depth = nullptr;    ///< metres

    /// Pixel i of the band.
    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t x = i % grid.pixels.width;
        const std::uint32_t y = i / grid.pixels.width;
        const GuidePixel pixel =
            guides_of_pixel<B>(luxels, grid, lens, x * grid.per_pixel_x, y * grid.per_pixel_y);
        albedo[i] = pixel.albedo;
        normal[i] = pixel.normal;
        position[i] = pixel.position;
        depth[i] = pixel.depth;
    }
};

}  // namespace mir
