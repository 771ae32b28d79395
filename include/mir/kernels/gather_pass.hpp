// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/soa.hpp"
#include "mir/kernels/luxel_light.hpp"

namespace mir {

/// Luxels of a tile, padding included, and where the light that each of them gathers goes.
template <class G>
struct GatherTile {
    G luxels;          ///< by blocked index
    Tile tile;         ///< in the band
    LuxelBand band;    ///< whose luxel_numbers() gather() gets, of Stream::gather
    SoaView<Rgb> out;  ///< W m^-2 sr^-1

    /// write(light) what gather(hit, surface, random) finds at a luxel, or black.
    template <class Gather, class Write>
    MIR_HD void at(LuxelIndex i, const Gather& gather, const Write& write) const {
        const LuxelPlace at = BlockedLayout::of(tile).place(i);
        Rgb sum;
        if (at.x < tile.width && at.y < tile.height) {
            const Hit hit = luxels.hit(i);
            if (!is_empty(hit))
                sum = gather(hit, luxels.surface(i),
                             band.luxel_numbers(tile.x + at.x, tile.y + at.y, Stream::gather));
        }
        write(sum);
    }
};

template <class G>
GatherTile(G, Tile, LuxelBand, SoaView<Rgb>) -> GatherTile<G>;

/// One luxel, all light that it gathers by rays: kernel over a run of the luxels of a tile; the
/// bits of gather_light().
template <class G, class Gather>
struct GatherPass {
    GatherTile<G> tile;    ///< luxels and where their light goes
    Gather gather;         ///< a RayGather
    LuxelIndex first = 0;  ///< luxel (blocked index) of kernel index 0

    /// Luxel first + i; writes black where it is empty or padding.
    MIR_HD void operator()(LuxelIndex i) const {
        tile.at(first + i, gather, [&](Rgb light) { tile.out.store(first + i, light); });
    }
};
template <class G, class Gather>
GatherPass(GatherTile<G>, Gather, LuxelIndex) -> GatherPass<G, Gather>;

/// The same by micro-buffers: kernel for groups, a luxel for each.
template <class G, class Gather>
struct BufferGatherPass {
    using Workspace = typename Gather::Workspace;  ///< fast memory of a group, that of the gather

    GatherTile<G> tile;    ///< luxels and where their light goes
    Gather gather;         ///< a BufferGather
    LuxelIndex first = 0;  ///< luxel (blocked index) of group 0

    /// Luxel first + i, by all lanes of the group together; lane 0 writes.
    MIR_HD void operator()(const LaneGroup& group, LuxelIndex i, Workspace& space) const {
        const auto by_group = [&](const Hit& hit, const auto& surface, Random random) {
            return gather(group, hit, surface, random, space);
        };
        tile.at(first + i, by_group, [&](Rgb light) {
            group.each([&](std::uint32_t lane) {
                if (lane == 0) tile.out.store(first + i, light);
            });
        });
    }
};
template <class G, class Gather>
BufferGatherPass(GatherTile<G>, Gather, LuxelIndex) -> BufferGatherPass<G, Gather>;

}  // namespace mir
