// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/image.hpp"
#include "mir/film/luxel_grid.hpp"
#include "mir/scene/camera.hpp"

namespace mir {

/// Pictures of what the camera sees, apart from light: for denoisers and compositors. Albedo and
/// normal are means over a pixel's luxels; position and depth are those of its first luxel that
/// sees a surface, because a mean of two surfaces lies on neither. Background: zero.
struct Guides {
    Image<Rgb> albedo;     ///< hemispherical reflectance, 0..1
    Image<Vec3> normal;    ///< shading normal, world space; shorter than 1 where it varies
    Image<Vec3> position;  ///< world space, metres
    Image<float> depth;    ///< distance from the lens plane, metres; 0: background

    explicit Guides(Extent pixels)
        : albedo(pixels), normal(pixels), position(pixels), depth(pixels) {}
};

/// Adds the luxel rows of a G-buffer, which starts at luxel row `first_row` and holds whole rows of
/// pixels. `albedo_of(surface)` gives the reflectance of a luxel.
template <TiledGBuffer G, Executor E, class Albedo>
void add_guides(Guides& guides, const G& gbuffer, std::uint32_t first_row, const LuxelGrid& grid,
                const Camera& camera, const Albedo& albedo_of, E& executor) {
    const auto luxel_at = [&](TileIndex t, std::uint32_t x, std::uint32_t y) {
        const Tile tile = gbuffer.tiles()[t];
        return BlockedLayout::of(tile)(x - tile.x, y - tile.y);
    };
    const float share = 1.0f / static_cast<float>(grid.per_pixel());
    // Tiles share pixels when a pixel's luxels straddle their border: rows of pixels are the grain,
    // and each goes through its luxels in raster order.
    const std::uint32_t tiles_x = tiles_per_row(gbuffer.tiles());
    const std::uint32_t pixel_rows = gbuffer.extent().height / grid.per_pixel_y;
    executor.for_each(pixel_rows, [&](std::size_t row) {
        const auto y0 = static_cast<std::uint32_t>(row) * grid.per_pixel_y;
        const std::uint32_t py = first_row / grid.per_pixel_y + static_cast<std::uint32_t>(row);
        for (std::uint32_t y = y0; y < y0 + grid.per_pixel_y; ++y)
            for (std::uint32_t x = 0; x < gbuffer.extent().width; ++x) {
                const TileIndex t = tile_holding(gbuffer.tiles(), tiles_x, x, y);
                const auto view = gbuffer.view(t);
                const LuxelIndex i = luxel_at(t, x, y);
                const Hit hit = view.hit(i);
                if (is_empty(hit)) continue;
                const auto surface = view.surface(i);
                const std::uint32_t px = x / grid.per_pixel_x;
                guides.albedo(px, py) += albedo_of(surface) * share;
                guides.normal(px, py) += surface.normal * share;
                if (guides.depth(px, py) != 0.0f) continue;
                guides.position(px, py) = hit.position;
                guides.depth(px, py) = camera.depth(hit.position);
            }
    });
}

}  // namespace mir
