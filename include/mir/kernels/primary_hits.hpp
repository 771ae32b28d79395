// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/gbuffer_words.hpp"
#include "mir/shading/luxel_tracer.hpp"

namespace mir {

/// One luxel, one camera ray: writes what the ray sees. Kernel over all luxels of a G-buffer,
/// padding included: index i is luxel i % 256 of block i / 256. The words are those that
/// fill_gbuffer() writes, given the same rays and the same closest hits.
template <class Rays, class R, Space S, Bsdf B>
struct PrimaryHits {
    Rays rays;  ///< rays(x, y) is the ray of a luxel of the whole image, as in LuxelRays
    LuxelTracer<R, S, B> tracer;           ///< says what they see
    EnvironmentView<S> background;         ///< what luxels without a surface see
    GBufferWords<typename B::Params> out;  ///< where luxels are written, every word of them
    std::uint32_t first_row = 0;           ///< of the image that `out` begins with

    /// Luxel `i` of the G-buffer, counted through all its blocks.
    MIR_HD void operator()(std::uint32_t i) const {
        const TileIndex t = out.tiles.tile_of(i / BlockedLayout::block_size);
        const LuxelIndex luxel = i - out.tiles.first_block(t) * BlockedLayout::block_size;
        const Tile tile = out.tiles[t];
        const LuxelPlace at = BlockedLayout::of(tile).place(luxel);
        if (at.x < tile.width && at.y < tile.height) {
            const SeenLuxel seen = tracer.luxel(rays, tile.x + at.x, first_row + tile.y + at.y);
            out.hits(t).store(luxel, tracer.hit(seen));
            out.surfaces(t).store(luxel, tracer.surface(seen, background));
        } else {
            clear(out.hits(t), luxel);
            clear(out.surfaces(t), luxel);
        }
    }

 private:
    /// Zero words, as in a new BlockedGBuffer; the zeros of parameters may have others.
    template <class T>
    MIR_HD static void clear(SoaView<T> view, LuxelIndex i) {
        for (std::uint32_t k = 0; k < SoaView<T>::words; ++k)
            view.planes[std::size_t{k} * view.stride + i] = 0;
    }
};
template <class Rays, class R, Space S, class B>
PrimaryHits(Rays, LuxelTracer<R, S, B>, EnvironmentView<S>, GBufferWords<typename B::Params>,
            std::uint32_t) -> PrimaryHits<Rays, R, S, B>;

}  // namespace mir
