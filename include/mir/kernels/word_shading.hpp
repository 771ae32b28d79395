// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/data/soa.hpp"
#include "mir/kernels/vpl_rows.hpp"
#include "mir/shading/prepared_luxel.hpp"

namespace mir {

/// ShadingPass for words of visibility (VisibilityWords). Kernel for groups, 32 luxels each, a
/// luxel per lane. Words are read 32 at a time and VPLs that none of the luxels sees skipped
/// together. Writes W m^-2 sr^-1, VPLs summed in their order: the bits of ShadingPass.
template <GBuffer G, VplSet P, Shading F>
struct WordShading {
    /// Four words, so that the device stores and fetches them as one. Padding it stores by bytes.
    struct alignas(16) Intensity {
        float r = 0.0f;       ///< W sr^-1
        float g = 0.0f;       ///< W sr^-1
        float b = 0.0f;       ///< W sr^-1
        float unused = 0.0f;  ///< not read
    };
    /// What a group works in: 32 VPLs, which all lanes read one after the other.
    struct Workspace {
        VplRows vpls;                             ///< and which luxels of a word see them
        Intensity intensities[LaneGroup::width];  ///< theirs
    };

    G luxels;                              ///< of the tile, whole groups of 32
    P vpls;                                ///< those that `words` knows of, in its order
    const std::uint32_t* words = nullptr;  ///< VisibilityWords::words of the tile
    F shade;                               ///< a device asks it for all lanes of a word with a bit
    SoaView<Rgb> radiance;                 ///< W m^-2 sr^-1 by blocked index

    /// Luxels 32 i to 32 i + 31 (blocked indices). Black for those that no bit is set of.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        LaneGroup::PerLane<PreparedLuxel<F>> own_luxels;
        LaneGroup::PerLane<Rgb> sums;
        group.each([&](std::uint32_t lane) {
            const LuxelIndex own = i * LaneGroup::width + lane;
            own_luxels[lane] = PreparedLuxel<F>::of(shade, luxels.hit(own), luxels.surface(own));
            sums[lane] = {};
        });
        const std::uint32_t* const own_words = words + std::size_t{i} * vpls.size();
        LaneGroup::PerLane<std::uint32_t> own, next;
        const auto fetch = [&](VplIndex first, LaneGroup::PerLane<std::uint32_t>& into) {
            group.each([&](std::uint32_t lane) {
                const VplIndex j = of_lane(first, lane);
                into[lane] = j < vpls.size() ? own_words[j] : 0u;
            });
        };
        fetch(0, own);
        for (VplIndex first = 0; first < vpls.size(); first += LaneGroup::width) {
            group.each([&](std::uint32_t lane) {
                if (own[lane] != 0) keep(vpls[of_lane(first, lane)], own[lane], lane, space);
            });
            std::uint32_t seen = group.ballot([&](std::uint32_t lane) { return own[lane] != 0; });
            fetch(first + LaneGroup::width, next);
            while (seen != 0) {
                const std::uint32_t k = LaneGroup::highest(seen);
                add(group, own_luxels, k, space, sums);
                seen &= LaneGroup::bits(0, k);
            }
            // Not each_apart(): no lane may keep() the next VPLs while another reads these.
            group.each([&](std::uint32_t lane) { own[lane] = next[lane]; });
        }
        group.each(
            [&](std::uint32_t lane) { radiance.store(i * LaneGroup::width + lane, sums[lane]); });
    }

 private:
    /// VPL of a lane, the first for the last lane. Highest bits are found faster than lowest ones.
    [[nodiscard]] MIR_HD static VplIndex of_lane(VplIndex first, std::uint32_t lane) {
        return first + (LaneGroup::width - 1 - lane);
    }

    /// Adds the light of the VPL in place `at` of the workspace.
    MIR_HD void add(const LaneGroup& group, const LaneGroup::PerLane<PreparedLuxel<F>>& own_luxels,
                    std::uint32_t at, const Workspace& space, LaneGroup::PerLane<Rgb>& sums) const {
        const VplRows::Row row = space.vpls[at];
        const Intensity j = space.intensities[at];
        const Vpl vpl{row.position, row.normal, {j.r, j.g, j.b}};
        group.each_apart([&](std::uint32_t lane) {
            const bool is_lit = (row.lit >> lane & 1u) != 0;
            // A lane of a warp would save nothing by leaving, and the branch costs all of them.
            if (!LaneGroup::is_warp && !is_lit) return;
            const Rgb c = own_luxels[lane].lit_by(vpl, shade);
            sums[lane] = sum_if(is_lit, sums[lane], c);
        });
    }

    MIR_HD static void keep(const Vpl& vpl, std::uint32_t lit, std::uint32_t at, Workspace& space) {
        space.vpls.keep(vpl, lit, 0, at);
        space.intensities[at] = {vpl.intensity.r, vpl.intensity.g, vpl.intensity.b, 0.0f};
    }
};
template <class G, class P, class F>
WordShading(G, P, const std::uint32_t*, F, SoaView<Rgb>) -> WordShading<G, P, F>;

}  // namespace mir
