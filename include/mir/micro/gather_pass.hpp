// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/soa.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/micro/gather_point.hpp"

namespace mir {

/// Luxels of a tile, padding included, and where their gathered light goes.
template <class G>
struct GatherTile {
    /// What a luxel gathers with.
    using Point = GatherPoint<typename G::Surface>;

    G luxels;          ///< by blocked index
    Tile tile;         ///< in the band
    LuxelBand band;    ///< whose luxel_numbers() gather() gets, of Stream::gather
    SoaView<Rgb> out;  ///< W m^-2 sr^-1

    /// Luxel i; an empty one for padding.
    [[nodiscard]] MIR_HD Point point(LuxelIndex i) const {
        const LuxelPlace at = BlockedLayout::of(tile).place(i);
        if (at.x >= tile.width || at.y >= tile.height) return {};
        const Hit hit = luxels.hit(i);
        if (is_empty(hit)) return {};
        return {hit, luxels.surface(i),
                band.luxel_numbers(tile.x + at.x, tile.y + at.y, Stream::gather)};
    }
};

template <class G>
GatherTile(G, Tile, LuxelBand, SoaView<Rgb>) -> GatherTile<G>;

/// One luxel, all light that it gathers by rays. Kernel over a run of the luxels of a tile; the
/// bits of gather_light().
template <class G, class Gather>
struct GatherPass {
    GatherTile<G> tile;    ///< luxels and where their light goes
    Gather gather;         ///< a RayGather
    LuxelIndex first = 0;  ///< luxel (blocked index) of kernel index 0

    /// Luxel first + i; writes black where it is empty or padding.
    MIR_HD void operator()(LuxelIndex i) const {
        const auto p = tile.point(first + i);
        tile.out.store(first + i, is_empty(p.hit) ? Rgb{} : gather(p.hit, p.surface, p.random));
    }
};
template <class G, class Gather>
GatherPass(GatherTile<G>, Gather, LuxelIndex) -> GatherPass<G, Gather>;

/// The same by micro-buffers: kernel for groups, some luxels for each.
template <class G, class Gather>
struct BufferGatherPass {
    using Workspace = typename Gather::Workspace;  ///< fast memory of a group, that of the gather
    /// Luxels of a group; runs must be multiples of it.
    static constexpr std::uint32_t luxels = Workspace::pictures;

    GatherTile<G> tile;    ///< luxels and where their light goes
    Gather gather;         ///< a BufferGather
    LuxelIndex first = 0;  ///< luxel (blocked index) where group 0 begins

    /// The luxels of group i, by all lanes together; lane 0 writes.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        const LuxelIndex begin = first + i * luxels;
        gather(
            group, [&](std::uint32_t k) { return tile.point(begin + k); }, space,
            [&](std::uint32_t k, Rgb light) {
                group.each([&](std::uint32_t lane) {
                    if (lane == 0) tile.out.store(begin + k, light);
                });
            });
    }
};
template <class G, class Gather>
BufferGatherPass(GatherTile<G>, Gather, LuxelIndex) -> BufferGatherPass<G, Gather>;

}  // namespace mir
