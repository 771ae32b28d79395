// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/image.hpp"
#include "mir/film/guide_images.hpp"
#include "mir/film/guide_pass.hpp"
#include "mir/scene/camera.hpp"

namespace mir {

namespace detail {

/// Luxels of a tiled G-buffer by their places in the image.
template <TiledGBuffer G>
struct LuxelsByPlace {
    const G& gbuffer;
    std::uint32_t tiles_x;

    [[nodiscard]] Hit hit(std::uint32_t x, std::uint32_t y) const {
        const TileIndex t = tile(x, y);
        return gbuffer.view(t).hit(index(t, x, y));
    }
    [[nodiscard]] auto surface(std::uint32_t x, std::uint32_t y) const {
        const TileIndex t = tile(x, y);
        return gbuffer.view(t).surface(index(t, x, y));
    }

 private:
    [[nodiscard]] TileIndex tile(std::uint32_t x, std::uint32_t y) const {
        return tile_holding(gbuffer.tiles(), tiles_x, x, y);
    }
    [[nodiscard]] LuxelIndex index(TileIndex t, std::uint32_t x, std::uint32_t y) const {
        const Tile tile = gbuffer.tiles()[t];
        return BlockedLayout::of(tile)(x - tile.x, y - tile.y);
    }
};

}  // namespace detail

/// Makes the guides of the pixels in a G-buffer of whole pixel rows. It starts at luxel row
/// `first_row`.
template <Bsdf B, TiledGBuffer G, Executor E>
void add_guides(Guides& guides, const G& gbuffer, std::uint32_t first_row, const LuxelGrid& grid,
                const Camera& camera, E& executor) {
    const detail::LuxelsByPlace<G> luxels{gbuffer, tiles_per_row(gbuffer.tiles())};
    const LensPlane lens{camera.position, camera.back};
    // Tiles share pixels when a pixel's luxels straddle their border: rows of pixels are the grain.
    executor.for_each(gbuffer.extent().height / grid.per_pixel_y, [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        const std::uint32_t py = first_row / grid.per_pixel_y + y;
        for (std::uint32_t px = 0; px < grid.pixels.width; ++px) {
            const GuidePixel pixel =
                guides_of_pixel<B>(luxels, grid, lens, px * grid.per_pixel_x, y * grid.per_pixel_y);
            guides.albedo(px, py) = pixel.albedo;
            guides.normal(px, py) = pixel.normal;
            guides.position(px, py) = pixel.position;
            guides.depth(px, py) = pixel.depth;
        }
    });
}

}  // namespace mir
