// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/core/random.hpp"
#include "mir/data/image.hpp"
#include "mir/film/luxel_grid.hpp"
#include "mir/for_each_luxel.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/shading/scene_light.hpp"

namespace mir {

/// Where the rows of a G-buffer lie in the whole luxel image; random numbers are keyed by it.
struct LuxelBand {
    std::uint32_t first_row = 0;
    LuxelGrid grid;
    std::uint64_t seed = 0;

    /// Numbers of the pixel that holds luxel (x, y) of the band, the same for all its luxels.
    [[nodiscard]] Random pixel_numbers(std::uint32_t x, std::uint32_t y) const {
        const std::uint64_t pixel_row = (first_row + y) / grid.per_pixel_y;
        return {seed, Stream::direct_light, pixel_row * grid.pixels.width + x / grid.per_pixel_x};
    }

    /// Numbers of luxel (x, y) of the band alone, for what luxels do not share.
    [[nodiscard]] Random luxel_numbers(std::uint32_t x, std::uint32_t y, Stream stream) const {
        return {seed, stream, std::uint64_t{first_row + y} * grid.luxels().width + x};
    }

    /// Number of the luxel inside its pixel.
    [[nodiscard]] std::uint32_t cell(std::uint32_t x, std::uint32_t y) const {
        return (first_row + y) % grid.per_pixel_y * grid.per_pixel_x + x % grid.per_pixel_x;
    }
};

/// Direct light by next-event estimation: radiance towards the viewer of every luxel,
/// W m^-2 sr^-1. `samples` points on emissive triangles per luxel, chosen by power; point, spot
/// and directional lights are summed exactly. Unbiased. Emission is not included.
template <Bsdf B, TiledGBuffer G, Visibility V, Executor E>
Image<Rgb> direct_light(const G& gbuffer, const LightTable& lights, const V& visibility,
                        LuxelBand band, std::uint32_t samples, float ray_offset, E& executor) {
    Image<Rgb> image(gbuffer.extent());
    const EmitterLight<B, V> emitters{lights, visibility, samples, ray_offset};
    const DeltaLight<B, V> deltas{lights, visibility};
    for_each_luxel(
        gbuffer, executor, [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
            const Hit hit = luxels.hit(i);
            if (is_empty(hit)) return;
            const auto surface = luxels.surface(i);
            const SharedSamples shared{band.grid.per_pixel(), band.cell(x, y)};
            image(x, y) =
                emitters(hit, surface, shared, band.pixel_numbers(x, y)) + deltas(hit, surface);
        });
    return image;
}

}  // namespace mir
