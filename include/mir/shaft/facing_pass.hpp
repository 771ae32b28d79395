// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/triangle_rows.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/data/soa.hpp"
#include "mir/shading/contribution.hpp"
#include "mir/shaft/cluster_record.hpp"

namespace mir {

/// Which luxels face which VPLs, seen or not: what shafts start from. Kernel for groups, four
/// clusters each, a luxel of each per lane; VPLs are read 32 at a time.
template <VplSet P>
struct FacingPass {
    /// Clusters of a group, and so words for each VPL.
    static constexpr std::uint32_t words_at_once = 4;

    /// What a group works in: VPLs.
    struct Workspace {
        AffineRow positions[LaneGroup::width];  ///< of 32 VPLs, metres; w is not used
        AffineRow normals[LaneGroup::width];    ///< of the same; w is not used
    };

    SoaView<const Hit> hits;         ///< a multiple of 128
    P vpls;                          ///< a word of each cluster for each
    std::uint32_t* words = nullptr;  ///< as VisibilityWords; all are written

    /// Groups that cover all luxels.
    [[nodiscard]] static std::uint32_t groups(std::uint32_t luxels) {
        return luxels / (cluster_luxels * words_at_once);
    }

    /// Clusters 4 i to 4 i + 3 and all VPLs.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        Words<Hit> luxels;
        for (std::uint32_t w = 0; w < words_at_once; ++w)
            group.each([&](std::uint32_t lane) {
                luxels[w][lane] = hits.load((i * words_at_once + w) * cluster_luxels + lane);
            });
        for (VplIndex first = 0; first < vpls.size(); first += LaneGroup::width) {
            group.each([&](std::uint32_t lane) {
                if (first + lane < vpls.size()) keep(vpls[first + lane], lane, space);
            });
            write(group, i, first, luxels, space);
        }
    }

 private:
    template <class T>
    using Words = LaneGroup::PerLane<T>[words_at_once];

    MIR_HD static void keep(const Vpl& vpl, std::uint32_t at, Workspace& space) {
        space.positions[at] = {vpl.position.x, vpl.position.y, vpl.position.z, 0.0f};
        space.normals[at] = {vpl.normal.x, vpl.normal.y, vpl.normal.z, 0.0f};
    }

    MIR_HD void write(const LaneGroup& group, std::uint32_t i, VplIndex first,
                      const Words<Hit>& luxels, const Workspace& space) const {
        const std::uint32_t count = smaller_count(vpls.size() - first);
        Words<std::uint32_t> own;
        for (std::uint32_t k = 0; k < count; ++k) {
            const AffineRow p = space.positions[k];
            const AffineRow n = space.normals[k];
            const Vpl vpl{{p.x, p.y, p.z}, {n.x, n.y, n.z}, {}};
            for (std::uint32_t w = 0; w < words_at_once; ++w) {
                const std::uint32_t word =
                    group.ballot([&](std::uint32_t lane) { return faces(luxels[w][lane], vpl); });
                group.each([&](std::uint32_t lane) {
                    if (lane == k) own[w][lane] = word;
                });
            }
        }
        for (std::uint32_t w = 0; w < words_at_once; ++w)
            group.each([&](std::uint32_t lane) {
                if (lane < count)
                    words[std::size_t{i * words_at_once + w} * vpls.size() + first + lane] =
                        own[w][lane];
            });
    }

    [[nodiscard]] MIR_HD static std::uint32_t smaller_count(std::uint32_t left) {
        return left < LaneGroup::width ? left : LaneGroup::width;
    }
};
template <class P>
FacingPass(SoaView<const Hit>, P, std::uint32_t*) -> FacingPass<P>;

}  // namespace mir
