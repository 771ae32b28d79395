// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/data/soa.hpp"
#include "mir/shading/contribution.hpp"
#include "mir/shaft/cluster_record.hpp"
#include "mir/shaft/facing_bounds.hpp"

namespace mir {

/// Which luxels face which VPLs, seen or not: what shafts start from. Kernel for groups, a cluster
/// each. First a VPL per lane against all of the cluster; then, for VPLs that some luxels may face
/// and others not, a luxel per lane.
template <VplSet P>
struct FacingPass {
    /// Groups need no memory.
    struct Workspace {};

    SoaView<const Hit> hits;         ///< a multiple of 32
    P vpls;                          ///< a word of each cluster for each
    std::uint32_t* words = nullptr;  ///< as VisibilityWords; all are written

    /// Groups that cover all luxels.
    [[nodiscard]] static std::uint32_t groups(std::uint32_t luxels) {
        return luxels / cluster_luxels;
    }

    /// Cluster `i` and all VPLs.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace&) const {
        LaneGroup::PerLane<Hit> luxels;
        group.each(
            [&](std::uint32_t lane) { luxels[lane] = hits.load(i * cluster_luxels + lane); });
        const FacingBounds bounds = facing_bounds(group, luxels);
        for (VplIndex first = 0; first < vpls.size(); first += LaneGroup::width) {
            LaneGroup::PerLane<std::uint32_t> own;
            std::uint32_t open = group.ballot([&](std::uint32_t lane) {
                own[lane] = 0;
                if (first + lane >= vpls.size()) return false;
                const Facing facing = facing_of(bounds, vpls[first + lane]);
                if (facing == Facing::all) own[lane] = bounds.luxels;
                return facing == Facing::some;
            });
            for (; open != 0; open &= open - 1) {
                const std::uint32_t k = LaneGroup::lowest(open);
                const Vpl vpl = vpls[first + k];
                const std::uint32_t word =
                    group.ballot([&](std::uint32_t lane) { return faces(luxels[lane], vpl); });
                group.each([&](std::uint32_t lane) {
                    if (lane == k) own[lane] = word;
                });
            }
            group.each([&](std::uint32_t lane) {
                if (first + lane < vpls.size())
                    words[std::size_t{i} * vpls.size() + first + lane] = own[lane];
            });
        }
    }
};
template <class P>
FacingPass(SoaView<const Hit>, P, std::uint32_t*) -> FacingPass<P>;

}  // namespace mir
