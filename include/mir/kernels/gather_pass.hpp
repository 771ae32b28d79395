// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/blocked_layout.hpp"
#include "mir/data/soa.hpp"
#include "mir/kernels/luxel_light.hpp"

namespace mir {

/// One luxel, all light that it gathers from discs: writes it, or black. Kernel over the luxels of
/// a tile, padding included; the bits of gather_light().
template <class G, class Gather>
struct GatherPass {
    G luxels;
    Tile tile;      ///< in the band
    Gather gather;  ///< RayGather or BufferGather
    LuxelBand band;
    SoaView<Rgb> out;

    MIR_HD void operator()(LuxelIndex i) const {
        const LuxelPlace at = BlockedLayout::of(tile).place(i);
        Rgb sum;
        if (at.x < tile.width && at.y < tile.height) {
            const Hit hit = luxels.hit(i);
            if (!is_empty(hit))
                sum = gather(hit, luxels.surface(i),
                             band.luxel_numbers(tile.x + at.x, tile.y + at.y, Stream::gather));
        }
        out.store(i, sum);
    }
};
template <class G, class Gather>
GatherPass(G, Tile, Gather, LuxelBand, SoaView<Rgb>) -> GatherPass<G, Gather>;

}  // namespace mir
