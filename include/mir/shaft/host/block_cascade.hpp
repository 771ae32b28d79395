// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/exact/pair_search.hpp"
#include "mir/shaft/host/lane_search.hpp"

namespace mir {

/// Which of the 256 luxels of a block see one VPL. The cascade of docs/shafts.md in vectors of
/// sixteen. Bits are those of is_hidden(). Made for one pair, on the host; not initialised where it
/// need not be.
template <InstructionSet Set>
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
        if (!provable) {
            for (std::uint32_t g = 0; g < BlockMask::packets; ++g) decide_alone(g, mask.packet[g]);
            return;
        }
        if (detail::LaneSearcher<Set>(bvh_, triangles_, block_.all, apex_, block_.sigma, search_)
                .run(limits)) {
            mask = {};
            return;
        }
        if (search_.finds_nothing()) return;
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g) decide_by_list(g, mask.packet[g]);
        if (search_.waiting.size() == 0) return;
        for (std::uint32_t g = 0; g < BlockMask::packets; g += 2)
            walk_pair(g, mask.packet[g], mask.packet[g + 1]);
    }

 private:
    /// Through the whole hierarchy, without a shaft.
    void decide_alone(std::uint32_t g, std::uint32_t& open) const {
        if (open != 0) open = visible_in_packet<Set>(bvh_, apex_, block_.points[g], open);
    }

    /// By those triangles of the list that are partial to the packet.
    void decide_by_list(std::uint32_t g, std::uint32_t& open) const {
        if (open == 0) return;
        detail::LaneChoice chosen;
        open = narrow(block_.packet[g].box, chosen) ? 0 : seen_past(chosen, g, open);
    }

    /// Packets g and g + 1 below the nodes that wait. Together if both have open lanes, because
    /// they mostly meet the same nodes and triangles.
    void walk_pair(std::uint32_t g, std::uint32_t& first, std::uint32_t& second) {
        const BlockRecords::Cluster& pair = block_.pair[g / 2];
        if (first != 0 && second != 0 && pair.within) {
            constexpr std::uint32_t width = PointPacket::width;
            const std::uint32_t open = walk<2>(pair, g, first | second << width);
            first = open & ((1u << width) - 1u);
            second = open >> width;
        } else {
            walk_alone(g, first);
            walk_alone(g + 1, second);
        }
    }
    void walk_alone(std::uint32_t g, std::uint32_t& open) {
        if (block_.packet[g].within)
            open = walk<1>(block_.packet[g], g, open);
        else
            decide_alone(g, open);
    }

    /// Chooses the triangles of the list that are partial to a packet. True when one covers it.
    /// Without an early end, which would make each batch wait for the one before.
    bool narrow(const detail::ClusterBox& box, detail::LaneChoice& chosen) const {
        std::uint32_t full = 0;
        for (std::uint32_t b = 0; b < search_.batches; ++b) {
            const std::uint32_t known = search_.chosen.lanes[b];
            const detail::LaneOcclusion found = occlusion<Set>(search_.batch[b], box, block_.sigma);
            full |= found.full & known;
            chosen.lanes[b] = known & ~found.none;
        }
        return full != 0;
    }

    /// Lanes of packet `g` that see the VPL past the chosen triangles.
    [[nodiscard]] std::uint32_t seen_past(const detail::LaneChoice& chosen, std::uint32_t g,
                                          std::uint32_t open) const {
        const ClusterRecord& packet = block_.packet[g].record;
        const detail::SharedEnd end = detail::shared_end(apex_, packet.low, packet.high);
        for (std::uint32_t b = 0; b < search_.batches; ++b) {
            const detail::CandidateLanes& batch = search_.batch[b];
            for (std::uint32_t rest = chosen.lanes[b]; rest != 0;) {
                const std::uint32_t k = detail::pop_lowest(rest);
                open &= ~detail::hit_lanes<Set>(triangles_[batch.group].rows(k), batch.origin(k),
                                                end, block_.points[g], open);
                if (open == 0) return 0;
            }
        }
        return open;
    }

    /// Asks a cluster of packets, from `g` on, below the nodes that wait. The triangles that
    /// blocked the packets before come first.
    template <std::uint32_t Packets>
    [[nodiscard]] std::uint32_t walk(const BlockRecords::Cluster& cluster, std::uint32_t g,
                                     std::uint32_t open) {
        const detail::SharedEnd end =
            detail::shared_end(apex_, cluster.record.low, cluster.record.high);
        for (const std::uint32_t t : blockers_) {
            if (open == 0 || t == detail::no_triangle) continue;
            const TriangleRows& rows = bvh_.triangles[t];
            open &= ~detail::hit_lanes_of<Set, Packets>(rows, end, block_.points + g, open);
        }
        if (open == 0) return 0;
        const SlotShaft shaft(make_shaft(cluster.record, apex_, block_.sigma));
        detail::WidePacketWalk<Set, SlotShaft, Packets> walk(bvh_, shaft, apex_, block_.points + g,
                                                             open);
        open = walk.run(search_.waiting);
        if (walk.blocker() != detail::no_triangle) {
            blockers_[1] = blockers_[0];
            blockers_[0] = walk.blocker();
        }
        return open;
    }

    const WideBvhView<Space::host>& bvh_;
    const TriangleLanes* triangles_;
    const BlockRecords& block_;
    Vec3 apex_;
    std::uint32_t blockers_[2] = {detail::no_triangle,
                                  detail::no_triangle};  ///< the last one first
    detail::LaneSearch search_;
};

}  // namespace mir
