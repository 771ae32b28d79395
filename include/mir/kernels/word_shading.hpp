// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/triangle_rows.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/data/soa.hpp"
#include "mir/shading/prepared_luxel.hpp"

namespace mir {

/// ShadingPass for words of visibility (VisibilityWords): kernel for groups, 32 luxels each, a
/// luxel per lane. Words are read 32 at a time and VPLs that none of the luxels sees skipped
/// together. Writes W m^-2 sr^-1, VPLs summed in their order: the bits of ShadingPass.
template <GBuffer G, VplSet P, Shading F>
struct WordShading {
    /// What a group works in: 32 VPLs, which all lanes read one after the other.
    struct Workspace {
        AffineRow positions[LaneGroup::width];    ///< metres; w is not used
        AffineRow normals[LaneGroup::width];      ///< w is not used
        AffineRow intensities[LaneGroup::width];  ///< W sr^-1; w is not used
    };

    G luxels;                              ///< of the tile, whole groups of 32
    P vpls;                                ///< those that `words` knows of, in its order
    const std::uint32_t* words = nullptr;  ///< VisibilityWords::words of the tile
    F shade;                               ///< asked for pairs that see each other
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
        for (VplIndex first = 0; first < vpls.size(); first += LaneGroup::width) {
            LaneGroup::PerLane<std::uint32_t> own;
            group.each([&](std::uint32_t lane) {
                own[lane] = first + lane < vpls.size() ? own_words[first + lane] : 0u;
                if (own[lane] != 0) keep(vpls[first + lane], lane, space);
            });
            std::uint32_t seen = group.ballot([&](std::uint32_t lane) { return own[lane] != 0; });
            for (; seen != 0; seen &= seen - 1) {
                const std::uint32_t k = LaneGroup::lowest(seen);
                const std::uint32_t lit = group.broadcast(own, k);
                const Vpl vpl = kept(k, space);
                group.each([&](std::uint32_t lane) {
                    if ((lit >> lane & 1u) != 0) sums[lane] += own_luxels[lane].lit_by(vpl, shade);
                });
            }
        }
        group.each(
            [&](std::uint32_t lane) { radiance.store(i * LaneGroup::width + lane, sums[lane]); });
    }

 private:
    MIR_HD static void keep(const Vpl& vpl, std::uint32_t at, Workspace& space) {
        space.positions[at] = {vpl.position.x, vpl.position.y, vpl.position.z, 0.0f};
        space.normals[at] = {vpl.normal.x, vpl.normal.y, vpl.normal.z, 0.0f};
        space.intensities[at] = {vpl.intensity.r, vpl.intensity.g, vpl.intensity.b, 0.0f};
    }
    [[nodiscard]] MIR_HD static Vpl kept(std::uint32_t at, const Workspace& space) {
        const AffineRow p = space.positions[at];
        const AffineRow n = space.normals[at];
        const AffineRow j = space.intensities[at];
        return {{p.x, p.y, p.z}, {n.x, n.y, n.z}, {j.x, j.y, j.z}};
    }
};
template <class G, class P, class F>
WordShading(G, P, const std::uint32_t*, F, SoaView<Rgb>) -> WordShading<G, P, F>;

}  // namespace mir
