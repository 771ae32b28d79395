// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/data/soa.hpp"

namespace mir {

/// ShadingPass for words of visibility (VisibilityWords): kernel for groups, 32 luxels each, a
/// luxel per lane. Words are read 32 at a time and VPLs that none of the luxels sees skipped
/// together. Writes W m^-2 sr^-1, VPLs summed in their order: the bits of ShadingPass.
template <GBuffer G, VplSet P, Shading F>
struct WordShading {
    /// Groups need no memory.
    struct Workspace {};

    G luxels;                              ///< of the tile, whole groups of 32
    P vpls;                                ///< those that `words` knows of, in its order
    const std::uint32_t* words = nullptr;  ///< VisibilityWords::words of the tile
    F shade;                               ///< asked for pairs that see each other
    SoaView<Rgb> radiance;                 ///< W m^-2 sr^-1 by blocked index

    /// Luxels 32 i to 32 i + 31 (blocked indices). Black for those that no bit is set of.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace&) const {
        LaneGroup::PerLane<Hit> hits;
        LaneGroup::PerLane<typename F::Surface> surfaces;
        LaneGroup::PerLane<Rgb> sums;
        group.each([&](std::uint32_t lane) {
            hits[lane] = luxels.hit(i * LaneGroup::width + lane);
            surfaces[lane] = luxels.surface(i * LaneGroup::width + lane);
            sums[lane] = {};
        });
        const std::uint32_t* const own_words = words + std::size_t{i} * vpls.size();
        for (VplIndex first = 0; first < vpls.size(); first += LaneGroup::width) {
            LaneGroup::PerLane<std::uint32_t> own;
            group.each([&](std::uint32_t lane) {
                own[lane] = first + lane < vpls.size() ? own_words[first + lane] : 0u;
            });
            std::uint32_t seen = group.ballot([&](std::uint32_t lane) { return own[lane] != 0; });
            for (; seen != 0; seen &= seen - 1) {
                const std::uint32_t k = LaneGroup::lowest(seen);
                const std::uint32_t lit = group.broadcast(own, k);
                const Vpl vpl = vpls[first + k];
                group.each([&](std::uint32_t lane) {
                    if ((lit >> lane & 1u) != 0)
                        sums[lane] += shade(hits[lane], surfaces[lane], vpl);
                });
            }
        }
        group.each(
            [&](std::uint32_t lane) { radiance.store(i * LaneGroup::width + lane, sums[lane]); });
    }
};
template <class G, class P, class F>
WordShading(G, P, const std::uint32_t*, F, SoaView<Rgb>) -> WordShading<G, P, F>;

}  // namespace mir
