// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/lane_search.hpp"
#include "mir/shaft/pair_search.hpp"

namespace mir {

/// Which of the 256 luxels of a block see one VPL: the cascade of docs/shafts.md in vectors of
/// sixteen. Bits are those of is_hidden(). Made for one pair, on the host; not initialised where it
/// need not be.
class BlockCascade {
 public:
    /// `triangles` are make_triangle_lanes() of the hierarchy's. All must outlive the cascade.
    BlockCascade(const WideBvhView<Space::host>& bvh, const TriangleLanes* triangles,
                 const BlockRecords& block, Vec3 apex)
        : bvh_(bvh), triangles_(triangles), block_(block), apex_(apex) {}

    /// Clears the bits of luxels that do not see the VPL.
    void decide(BlockMask& mask, const CascadeLimits& limits) {
        const bool provable =
            is_proved_scale(bvh_.reach) && block_.all.within && within_reach(apex_, bvh_.reach);
        const bool covered = provable && detail::LaneSearcher(bvh_, triangles_, block_.all, apex_,
                                                              block_.sigma, search_)
                                             .run(limits);
        if (provable && !covered && search_.finds_nothing()) return;
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g) {
            std::uint32_t& open = mask.packet[g];
            if (open == 0) continue;
            if (covered)
                open = 0;
            else
                open = provable ? decide_packet(g, open) : decide_alone(g, open);
        }
    }

 private:
    /// Through the whole hierarchy, without a shaft.
    [[nodiscard]] std::uint32_t decide_alone(std::uint32_t g, std::uint32_t open) const {
        return visible_in_packet(bvh_, apex_, block_.points[g], open);
    }

    [[nodiscard]] std::uint32_t decide_packet(std::uint32_t g, std::uint32_t open) {
        detail::LaneChoice chosen;
        if (narrow(block_.packet[g].box, chosen)) return 0;
        open = decide_by_list(g, open, chosen);
        if (open == 0 || search_.waiting_nodes == 0) return open;
        if (!block_.packet[g].within) return decide_alone(g, open);
        return decide_by_walk(g, open);
    }

    /// Chooses the triangles of the list that are partial to a packet. True when one covers it.
    /// Without an early end, which would make each batch wait for the one before.
    bool narrow(const detail::ClusterBox& box, detail::LaneChoice& chosen) const {
        std::uint32_t full = 0;
        for (std::uint32_t b = 0; b < search_.batches; ++b) {
            const std::uint32_t known = search_.chosen.lanes[b];
            const detail::LaneOcclusion found = occlusion(search_.batch[b], box, block_.sigma);
            full |= found.full & known;
            chosen.lanes[b] = known & ~found.none;
        }
        return full != 0;
    }

    [[nodiscard]] std::uint32_t decide_by_list(std::uint32_t g, std::uint32_t open,
                                               const detail::LaneChoice& chosen) const {
        for (std::uint32_t b = 0; b < search_.batches; ++b) {
            const detail::CandidateLanes& batch = search_.batch[b];
            for (std::uint32_t rest = chosen.lanes[b]; rest != 0;) {
                const std::uint32_t k = detail::pop_lowest(rest);
                open &= ~detail::hit_lanes(triangles_[batch.group].rows(k), batch.origin(k),
                                           block_.points[g], open);
                if (open == 0) return 0;
            }
        }
        return open;
    }

    /// Below the nodes that wait, after the triangles that blocked the packets before.
    [[nodiscard]] std::uint32_t decide_by_walk(std::uint32_t g, std::uint32_t open) {
        for (const std::uint32_t t : blockers_) {
            if (t == Walk::no_triangle) continue;
            const TriangleRows& rows = bvh_.triangles[t];
            open &=
                ~detail::hit_lanes(rows, detail::origin_rows(rows, apex_), block_.points[g], open);
        }
        if (open == 0) return 0;
        const SlotShaft shaft(make_shaft(block_.packet[g].record, apex_, block_.sigma));
        Walk walk(bvh_, shaft, apex_, block_.points[g], open);
        open = walk.run(search_.waiting, search_.waiting_nodes);
        if (walk.blocker() != Walk::no_triangle) {
            blockers_[1] = blockers_[0];
            blockers_[0] = walk.blocker();
        }
        return open;
    }

    using Walk = detail::WidePacketWalk<SlotShaft>;

    const WideBvhView<Space::host>& bvh_;
    const TriangleLanes* triangles_;
    const BlockRecords& block_;
    Vec3 apex_;
    std::uint32_t blockers_[2] = {Walk::no_triangle, Walk::no_triangle};  ///< the last one first
    detail::LaneSearch search_;
};

}  // namespace mir
