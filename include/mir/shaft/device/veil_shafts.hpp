// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/data/soa.hpp"
#include "mir/shaft/device/leaf_search.hpp"
#include "mir/shaft/device/vpl_batch.hpp"
#include "mir/shaft/exact/cluster_record.hpp"

#include <cstdint>

namespace mir {

/// Clears the bits of luxels and VPLs between which triangles that are not opaque stop the light.
/// Kernel for groups, 32 luxels and 32 VPLs each. First a shaft per lane, of those with a bit;
/// then, of VPLs whose shaft meets such a triangle, a segment per lane. `V` is the Visibility by
/// these triangles alone.
template <VplSet P, Visibility V>
struct VeilShafts {
    static constexpr Space space = V::space;  ///< of the hierarchy
    /// Nodes that a shaft may visit to find that it meets no leaf.
    static constexpr std::uint32_t most_nodes = 32;

    /// What a group works in.
    struct Workspace {
        LeafColumns<1> leaves;  ///< a first leaf: a second one ends the search
    };

    SoaView<const Hit> hits;                  ///< whole clusters of 32
    const ClusterRecord* clusters = nullptr;  ///< of 32 luxels
    P vpls;                                   ///< all, not those of the batch alone
    VplBatch batch;                           ///< whose words are written
    QuantisedBvhView<space> bvh;              ///< of triangles that are not opaque
    float sigma = 0.0f;                       ///< of the scene, metres, as for the records
    V segments;                               ///< by the same triangles
    std::uint32_t* words = nullptr;           ///< as VisibilityWords

    /// Groups that cover all luxels and VPLs of a batch.
    [[nodiscard]] static std::uint32_t groups(std::uint32_t luxels, VplBatch batch) {
        return luxels / LaneGroup::width * runs(batch);
    }

    /// Group `i` < groups(). Cluster i / r and the VPLs from 32 (i % r) of the batch on; there are
    /// r runs of 32.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space_of) const {
        const std::uint32_t cluster = i / runs(batch);
        const std::uint32_t first = i % runs(batch) * LaneGroup::width;
        LaneGroup::PerLane<std::uint32_t> lit;
        LaneGroup::PerLane<LeafSearch> searches;
        LaneGroup::PerLane<ShaftSlabs> slabs;
        LaneGroup::PerLane<LeafStack> stacks;
        group.each([&](std::uint32_t lane) {
            const std::uint32_t k = first + lane;
            lit[lane] = k < batch.count ? words[place(cluster, k)] : 0u;
            const bool on = lit[lane] != 0 && is_proved(cluster, k);
            if (on)
                slabs[lane] = make_shaft_slabs(clusters[cluster], vpls[batch.first + k].position,
                                               sigma, bvh.exact.reach);
            searches[lane].begin(on);
        });
        while (running_lanes(group, searches) != 0)
            visit_nodes(group, bvh, slabs, most_nodes, searches, stacks, space_of.leaves);
        std::uint32_t asked = group.ballot([&](std::uint32_t lane) {
            const LeafSearch& search = searches[lane];
            const bool is_clear = search.state == LeafSearchState::complete && search.listed == 0;
            return lit[lane] != 0 && !is_clear;
        });
        for (; asked != 0; asked &= asked - 1) {
            const std::uint32_t asking = LaneGroup::lowest(asked);
            ask(group, cluster, first + asking, group.broadcast(lit, asking));
        }
    }

 private:
    [[nodiscard]] MIR_HD static std::uint32_t runs(VplBatch batch) {
        return (batch.count + LaneGroup::width - 1) / LaneGroup::width;
    }
    [[nodiscard]] MIR_HD std::size_t place(std::uint32_t cluster, std::uint32_t k) const {
        return std::size_t{cluster} * vpls.size() + batch.first + k;
    }
    [[nodiscard]] MIR_HD bool is_proved(std::uint32_t cluster, std::uint32_t k) const {
        const float reach = bvh.exact.reach;
        return is_proved_scale(reach) && within_reach(vpls[batch.first + k].position, reach) &&
               within_reach(clusters[cluster], reach);
    }

    /// The luxels of `lit` and VPL `k` of the batch, one by one.
    MIR_HD void ask(const LaneGroup& group, std::uint32_t cluster, std::uint32_t k,
                    std::uint32_t lit) const {
        const Vec3 apex = vpls[batch.first + k].position;
        const std::uint32_t open = group.ballot([&](std::uint32_t lane) {
            return (lit >> lane & 1u) != 0 &&
                   segments.visible(apex, hits.load(cluster * LaneGroup::width + lane).position);
        });
        group.each([&](std::uint32_t lane) {
            if (lane == 0) words[place(cluster, k)] = open;
        });
    }
};

}  // namespace mir
