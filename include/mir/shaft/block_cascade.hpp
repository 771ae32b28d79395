// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide_packet.hpp"
#include "mir/shaft/block_records.hpp"
#include "mir/shaft/pair_search.hpp"
#include "mir/shaft/shaft_slots.hpp"

namespace mir {

/// What the cascade of the host may cost. Any numbers are right: they decide speed alone.
struct CascadeLimits {
    std::uint32_t block_nodes = 128;     ///< visited by the shaft of 256 luxels
    std::uint32_t part_nodes = 96;       ///< by that of a quarter
    std::uint32_t packet_triangles = 48; ///< asked for sixteen luxels before they walk by themselves
};

namespace detail {

/// Triangles that may hit segments of a pair, in lanes. Uninitialised beyond `batches`.
class LaneList {
 public:
    static constexpr std::uint32_t most_batches = 8;

    CandidateLanes batch[most_batches];
    std::uint32_t batches = 0;

    /// Appends some lanes; false when there is no room for all of them.
    bool append(const CandidateLanes& lanes, std::uint32_t chosen) {
        while (chosen != 0) {
            if (size_ == most_batches * lane_count) return false;
            const std::uint32_t to = size_ % lane_count;
            if (to == 0) batch[batches++].used = 0;
            CandidateLanes& last = batch[batches - 1];
            copy_lane(lanes, pop_lowest(chosen), last, to);
            last.used |= 1u << to;
            ++size_;
        }
        return true;
    }
    [[nodiscard]] bool empty() const { return size_ == 0; }

 private:
    std::uint32_t size_ = 0;
};

/// Some lanes of a list: a word per batch.
struct LaneChoice {
    std::uint32_t lanes[LaneList::most_batches];
};

}  // namespace detail

/// Which of the 256 luxels of a block see one VPL: the cascade of docs/shafts.md, vectorised.
/// Bits are those of is_hidden(). A value for one pair; on the host.
class BlockCascade {
 public:
    BlockCascade(const WideBvhView<Space::host>& bvh, const BlockRecords& block, Vec3 apex,
                 const CascadeLimits& limits)
        : bvh_(bvh), block_(block), apex_(apex), limits_(limits) {
        const ClusterRecord& all = block.all.record;
        spread_ = larger(max_abs(all.low - apex), max_abs(all.high - apex));
    }

    /// Clears the bits of luxels that do not see the VPL.
    void decide(BlockMask& mask) const {
        const bool provable =
            is_proved_scale(bvh_.reach) && block_.all.within && within_reach(apex_, bvh_.reach);
        if (!provable) return by_packets(mask);
        detail::LaneList list;
        const PairState state = search(block_.all, limits_.block_nodes, list);
        if (state == PairState::clear) return;
        for (std::uint32_t p = 0; p < BlockRecords::parts; ++p) {
            std::uint32_t* const part = mask.packet + p * BlockRecords::part_packets;
            if (state == PairState::covered)
                clear_part(part);
            else if (any(part))
                decide_part(p, part, state, list);
        }
    }

 private:
    static bool any(const std::uint32_t* part) {
        std::uint32_t bits = 0;
        for (std::uint32_t k = 0; k < BlockRecords::part_packets; ++k) bits |= part[k];
        return bits != 0;
    }
    static void clear_part(std::uint32_t* part) {
        for (std::uint32_t k = 0; k < BlockRecords::part_packets; ++k) part[k] = 0;
    }

    void by_packets(BlockMask& mask) const {
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
            if (mask.packet[g] != 0)
                mask.packet[g] = visible_in_packet(bvh_, apex_, block_.points[g], mask.packet[g]);
    }

    /// Walks the shaft of a cluster through the hierarchy.
    PairState search(const BlockRecords::Cluster& cluster, std::uint32_t most_nodes,
                     detail::LaneList& list) const {
        const SlotShaft shaft(make_shaft(cluster.record, apex_, block_.sigma));
        std::uint32_t stack[(WideNode::width - 1) * WideBvhView<Space::host>::max_depth + 1];
        std::uint32_t places[detail::lane_count + WideNode::width * WideBvhOptions::largest_leaf];
        std::uint32_t waiting = 1;
        std::uint32_t found = 0;
        stack[0] = WideBvhView<Space::host>::root;
        for (std::uint32_t visited = 0;; ++visited) {
            const bool done = waiting == 0;
            while (found >= detail::lane_count || (done && found != 0)) {
                const std::uint32_t count = found < detail::lane_count ? found : detail::lane_count;
                found -= count;
                const PairState state = add(cluster, places + found, count, list);
                if (state != PairState::clear) return state;
            }
            if (done) return list.empty() ? PairState::clear : PairState::listed;
            if (visited == most_nodes) return PairState::unknown;
            const WideNode& node = bvh_.nodes[stack[--waiting]];
            const std::uint32_t met = shaft.met(node);
            for (std::uint32_t inner = met & detail::inner_slots(node); inner != 0;)
                stack[waiting++] = node.ref[detail::pop_lowest(inner)];
            for (std::uint32_t leaves = met & detail::leaf_slots(node); leaves != 0;) {
                const std::uint32_t k = detail::pop_lowest(leaves);
                for (std::int32_t i = 0; i < node.count[k]; ++i)
                    places[found++] = node.ref[k] + static_cast<std::uint32_t>(i);
            }
        }
    }

    /// Lists those of some triangles that are partial; anything but clear ends the search.
    PairState add(const BlockRecords::Cluster& cluster, const std::uint32_t* places,
                  std::uint32_t count, detail::LaneList& list) const {
        detail::CandidateLanes lanes;
        detail::prepare_lanes(bvh_.triangles, places, count, apex_, spread_, block_.sigma, lanes);
        const detail::LaneOcclusion found = occlusion(lanes, cluster.box, block_.sigma);
        if (found.full != 0) return PairState::covered;
        return list.append(lanes, lanes.used & ~found.none) ? PairState::clear : PairState::unknown;
    }

    /// Chooses the triangles of a list that are partial to a smaller cluster.
    PairState narrow(const BlockRecords::Cluster& cluster, const detail::LaneList& list,
                     const detail::LaneChoice& known, detail::LaneChoice& chosen,
                     std::uint32_t& count) const {
        count = 0;
        for (std::uint32_t b = 0; b < list.batches; ++b) {
            chosen.lanes[b] = known.lanes[b];
            if (known.lanes[b] == 0) continue;
            const detail::LaneOcclusion found =
                occlusion(list.batch[b], cluster.box, block_.sigma);
            if ((found.full & known.lanes[b]) != 0) return PairState::covered;
            chosen.lanes[b] &= ~found.none;
            count += static_cast<std::uint32_t>(__builtin_popcount(chosen.lanes[b]));
        }
        return count == 0 ? PairState::clear : PairState::listed;
    }

    void decide_part(std::uint32_t p, std::uint32_t* words, PairState of_block,
                     const detail::LaneList& of_block_list) const {
        const BlockRecords::Cluster& part = block_.part[p];
        detail::LaneList own;
        const detail::LaneList* list = &of_block_list;
        detail::LaneChoice chosen;
        PairState state = PairState::unknown;
        if (of_block == PairState::listed) {
            detail::LaneChoice all;
            for (std::uint32_t b = 0; b < list->batches; ++b) all.lanes[b] = list->batch[b].used;
            std::uint32_t count = 0;
            state = narrow(part, *list, all, chosen, count);
        } else if (part.within) {
            state = search(part, limits_.part_nodes, own);
            list = &own;
            for (std::uint32_t b = 0; b < own.batches; ++b) chosen.lanes[b] = own.batch[b].used;
        }
        if (state == PairState::clear) return;
        if (state == PairState::covered) return clear_part(words);
        for (std::uint32_t k = 0; k < BlockRecords::part_packets; ++k) {
            if (words[k] == 0) continue;
            const std::uint32_t g = p * BlockRecords::part_packets + k;
            words[k] = decide_packet(g, words[k], state, *list, chosen);
        }
    }

    std::uint32_t decide_packet(std::uint32_t g, std::uint32_t open, PairState of_part,
                                const detail::LaneList& list,
                                const detail::LaneChoice& of_part_chosen) const {
        const BlockRecords::Cluster& packet = block_.packet[g];
        if (of_part == PairState::listed) {
            detail::LaneChoice chosen;
            std::uint32_t count = 0;
            const PairState state = narrow(packet, list, of_part_chosen, chosen, count);
            if (state == PairState::clear) return open;
            if (state == PairState::covered) return 0;
            if (count <= limits_.packet_triangles) return by_list(g, open, list, chosen);
        }
        if (!packet.within) return visible_in_packet(bvh_, apex_, block_.points[g], open);
        const SlotShaft shaft(make_shaft(packet.record, apex_, block_.sigma));
        return detail::WidePacketWalk(bvh_, shaft, apex_, block_.points[g], open).run();
    }

    std::uint32_t by_list(std::uint32_t g, std::uint32_t open, const detail::LaneList& list,
                          const detail::LaneChoice& chosen) const {
        for (std::uint32_t b = 0; b < list.batches; ++b) {
            const detail::CandidateLanes& batch = list.batch[b];
            for (std::uint32_t rest = chosen.lanes[b]; rest != 0;) {
                const std::uint32_t k = detail::pop_lowest(rest);
                open &= ~hit_lanes(bvh_.triangles[batch.triangle[k]], batch.origin(k),
                                   block_.points[g], open);
                if (open == 0) return 0;
            }
        }
        return open;
    }

    const WideBvhView<Space::host>& bvh_;
    const BlockRecords& block_;
    Vec3 apex_;
    CascadeLimits limits_;
    float spread_ = 0.0f;
};

}  // namespace mir
