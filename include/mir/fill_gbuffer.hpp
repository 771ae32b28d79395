// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/film/luxel_rays.hpp"
#include "mir/scene/camera.hpp"
#include "mir/shading/luxel_tracer.hpp"
#include "mir/shading/surface_table.hpp"

namespace mir {

/// The camera rays of an image, one per luxel. Each is a pure function of its place and the seed.
struct CameraRays {
    Camera camera;           ///< its own aspect_ratio is not used: the grid's is
    LuxelGrid grid;          ///< which luxels there are
    std::uint64_t seed = 0;  ///< of the luxels' places and of the points of the lens

    /// The same for kernels.
    [[nodiscard]] LuxelRays luxel_rays() const { return {camera.optics(), grid, seed}; }

    /// Ray of the luxel at (x, y) of the whole luxel image.
    [[nodiscard]] Ray operator()(std::uint32_t x, std::uint32_t y) const {
        return luxel_rays()(x, y);
    }
    /// LuxelRays::specular_plan().
    [[nodiscard]] SpecularPlan specular_plan(std::uint32_t x, std::uint32_t y) const {
        return luxel_rays().specular_plan(x, y);
    }
};

/// First phase: traces the camera ray of every luxel of `gbuffer`. The G-buffer holds the rows from
/// `first_row` on of the luxel image. `rays(x, y)` is the ray of a luxel, as in CameraRays. Points
/// are lifted. Luxels that see nothing emit what `background` sends them.
/// @throws Error(invalid_argument) when rays of an image's luxels are given and the G-buffer has
///         columns or rows that the image does not have.
template <Bsdf B, class Rays, class R, Executor E>
void fill_gbuffer(BlockedGBuffer<typename B::Params>& gbuffer, std::uint32_t first_row,
                  const Rays& rays, const LuxelTracer<R, Space::host, B>& tracer,
                  const EnvironmentView<Space::host>& background, E& executor) {
    if constexpr (requires { rays.grid.luxels(); }) {
        const Extent image = rays.grid.luxels();
        const Extent band = gbuffer.extent();
        expects(band.width == image.width && first_row <= image.height &&
                    band.height <= image.height - first_row,
                "a G-buffer does not fit the image of its camera rays (its width differs, or its "
                "rows end below the last); make it of the grid's luxels, all columns wide");
    }
    struct Row {
        TileIndex tile;
        std::uint32_t y;
    };
    std::vector<Row> rows;
    for (TileIndex t = 0; t < gbuffer.tiles().size(); ++t)
        for (std::uint32_t y = 0; y < gbuffer.tiles()[t].height; ++y) rows.push_back({t, y});

    executor.for_each(rows.size(), [&](std::size_t i) {
        const Row row = rows[i];
        const Tile tile = gbuffer.tiles()[row.tile];
        const auto layout = BlockedLayout::of(tile);
        for (std::uint32_t x = 0; x < tile.width; ++x) {
            const SeenLuxel seen = tracer.luxel(rays, tile.x + x, first_row + tile.y + row.y);
            gbuffer.store(row.tile, layout(x, row.y), tracer.hit(seen),
                          tracer.surface(seen, background));
        }
    });
}

/// The same before a black background.
template <Bsdf B, class Rays, RayCaster R, Executor E>
void fill_gbuffer(BlockedGBuffer<typename B::Params>& gbuffer, std::uint32_t first_row,
                  const Rays& rays, const R& caster, const SurfaceTable<B>& surfaces, E& executor) {
    fill_gbuffer(gbuffer, first_row, rays, LuxelTracer{caster, surfaces.view()}, {}, executor);
}

}  // namespace mir
