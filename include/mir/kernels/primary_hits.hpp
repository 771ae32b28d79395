// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/find_surface.hpp"
#include "mir/data/gbuffer_words.hpp"
#include "mir/scene/geometry_view.hpp"
#include "mir/shading/surface_table_view.hpp"

namespace mir {

/// One luxel, one camera ray: writes what the ray saw first, or an empty luxel. Kernel over all
/// luxels of a G-buffer, padding included: index i is luxel i % 256 of block i / 256. The words are
/// those that fill_gbuffer() writes, given the same rays and the same closest hits.
template <class Rays, RayFinder Finder, Space S, Bsdf B>
struct PrimaryHits {
    Rays rays;      ///< rays(x, y) is the ray of a luxel of the whole image, as in LuxelRays
    Finder finder;  ///< of the triangles of `geometry`
    GeometryView<S> geometry;         ///< world space, with the offset by which hits are lifted
    SurfaceTableView<S, B> surfaces;  ///< what materials are at a point
    GBufferWords<typename B::Params> out;  ///< where luxels are written, every word of them
    std::uint32_t first_row = 0;           ///< of the image that `out` begins with

    /// Luxel `i` of the G-buffer, counted through all its blocks.
    MIR_HD void operator()(std::uint32_t i) const {
        const TileIndex t = out.tiles.tile_of(i / BlockedLayout::block_size);
        const LuxelIndex luxel = i - out.tiles.first_block(t) * BlockedLayout::block_size;
        const Tile tile = out.tiles[t];
        const LuxelPlace at = BlockedLayout::of(tile).place(luxel);
        SurfacePoint p;
        Ray ray;
        bool is_found = false;
        if (at.x < tile.width && at.y < tile.height) {
            ray = rays(tile.x + at.x, first_row + tile.y + at.y);
            is_found = find_surface(finder, geometry, ray, p);
        }
        if (is_found)
            store(t, luxel, ray, p);
        else
            clear(t, luxel);
    }

 private:
    MIR_HD void store(TileIndex t, LuxelIndex i, const Ray& ray, const SurfacePoint& p) const {
        out.hits(t).store(i, {lift(p), p.geometric_normal});
        out.surfaces(t).store(i, surfaces.luxel_surface(p, -ray.direction));
    }

    MIR_HD void clear(TileIndex t, LuxelIndex i) const {
        clear(out.hits(t), i);
        clear(out.surfaces(t), i);
    }
    /// Zero words, as in a new BlockedGBuffer; the zeros of parameters may have others.
    template <class T>
    MIR_HD static void clear(SoaView<T> view, LuxelIndex i) {
        for (std::uint32_t k = 0; k < SoaView<T>::words; ++k)
            view.planes[std::size_t{k} * view.stride + i] = 0;
    }
};
template <class Rays, class Finder, Space S, class B>
PrimaryHits(Rays, Finder, GeometryView<S>, SurfaceTableView<S, B>, GBufferWords<typename B::Params>,
            std::uint32_t) -> PrimaryHits<Rays, Finder, S, B>;

}  // namespace mir
