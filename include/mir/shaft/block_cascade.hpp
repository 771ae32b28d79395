// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide_packet.hpp"
#include "mir/shaft/block_records.hpp"
#include "mir/shaft/pair_search.hpp"
#include "mir/shaft/shaft_slots.hpp"

#include <algorithm>

#if defined(MIR_CASCADE_COUNT) && MIR_CASCADE_COUNT == 2
struct MirT { int i; unsigned long t0; MirT(int i_):i(i_),t0(__builtin_ia32_rdtsc()){} ~MirT(){ mir::cascade_count[i] += (long)(__builtin_ia32_rdtsc()-t0);} };
#define MIR_T(i) MirT mir_t##i(i)
#undef MIR_N
#define MIR_N(a,b) ((void)0)
#else
#define MIR_T(i) ((void)0)
#endif
namespace mir {

/// What the cascade of the host may cost. Any numbers are right: they decide speed alone.
struct CascadeLimits {
    std::uint32_t block_nodes = 32;    ///< visited by the shaft of 256 luxels
    std::uint32_t block_batches = 12;  ///< of sixteen triangles each that it may list
    std::uint32_t part_nodes = 32;     ///< visited by that of a quarter, beyond those left to it
};

namespace detail {

/// Triangles that may hit segments of a pair, in lanes. Uninitialised beyond `size`.
struct LaneList {
    static constexpr std::uint32_t capacity = 24;

    CandidateLanes batch[capacity];
    std::uint32_t size = 0;
};

/// Some lanes of a list: a word per batch.
struct LaneChoice {
    std::uint32_t lanes[LaneList::capacity];
};

/// Nodes that a walk has still to visit, the next one last. Uninitialised beyond `size`.
struct WaitingNodes {
    static constexpr std::uint32_t capacity =
        (WideNode::width - 1) * WideBvhView<Space::host>::max_depth + 1;

    std::uint32_t node[capacity];
    std::uint32_t size = 0;

    WaitingNodes() = default;
    WaitingNodes(const WaitingNodes& other) : size(other.size) {
        std::copy(other.node, other.node + size, node);
    }
};

}  // namespace detail

/// Which of the 256 luxels of a block see one VPL: the cascade of docs/shafts.md, vectorised.
/// Bits are those of is_hidden(). Made for one pair; on the host.
class BlockCascade {
 public:
    BlockCascade(const WideBvhView<Space::host>& bvh, const TriangleLanes* lanes,
                 const BlockRecords& block, Vec3 apex, const CascadeLimits& limits)
        : bvh_(bvh), lanes_(lanes), block_(block), apex_(apex), limits_(limits) {
        const ClusterRecord& all = block.all.record;
        spread_ = larger(max_abs(all.low - apex), max_abs(all.high - apex));
    }

    /// Clears the bits of luxels that do not see the VPL.
    void decide(BlockMask& mask) {
        MIR_T(30);
        const bool provable =
            is_proved_scale(bvh_.reach) && block_.all.within && within_reach(apex_, bvh_.reach);
        if (!provable) return by_packets(mask);
        detail::WaitingNodes waiting;
        waiting.node[waiting.size++] = WideBvhView<Space::host>::root;
        detail::LaneChoice chosen;
        if (search(block_.all, limits_.block_nodes, limits_.block_batches, waiting, chosen)) {
            mask = {};
            return;
        }
        if (list_.size == 0 && waiting.size == 0) return;
        for (std::uint32_t p = 0; p < BlockRecords::parts; ++p) {
            std::uint32_t* const part = mask.packet + p * BlockRecords::part_packets;
            if (any(part)) decide_part(p, part, waiting, chosen);
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

    /// Walks the shaft of a cluster on from the nodes that wait, until none does or the limits are
    /// reached, and appends what is partial to the list. True when one triangle covers all.
    bool search(const BlockRecords::Cluster& cluster, std::uint32_t most_nodes,
                std::uint32_t most_batches, detail::WaitingNodes& waiting,
                detail::LaneChoice& chosen) {
        const bool isb = most_nodes == limits_.block_nodes; (void)isb;
#if defined(MIR_CASCADE_COUNT) && MIR_CASCADE_COUNT == 2
        MirT ttt(isb ? 25 : 26);
#endif
        const SlotShaft shaft(make_shaft(cluster.record, apex_, block_.sigma));
        for (std::uint32_t visited = 0; waiting.size != 0 && visited < most_nodes; ++visited) {
            const std::uint32_t node = waiting.node[--waiting.size];
            const std::uint32_t before = list_.size;
            MIR_N(most_nodes == limits_.block_nodes ? 18 : 19, 1);
            const std::uint32_t met = shaft.met(bvh_.nodes[node]);
            const Addition added = add_leaves(cluster, bvh_.nodes[node], met, most_batches, chosen);
            if (added == Addition::covers) return true;
            if (added == Addition::no_room) {
                list_.size = before;
                ++waiting.size;
                return false;
            }
            const WideNode& n = bvh_.nodes[node];
            for (std::uint32_t inner = met & detail::inner_slots(n); inner != 0;) {
                const std::uint32_t r = n.ref[detail::pop_lowest(inner)];
                const char* c = reinterpret_cast<const char*>(bvh_.nodes + r);
                for (int i = 0; i < 4; ++i) __builtin_prefetch(c + 64 * i);
                waiting.node[waiting.size++] = r;
            }
        }
        return false;
    }

    enum class Addition { listed, no_room, covers };

    Addition add_leaves(const BlockRecords::Cluster& cluster, const WideNode& node,
                        std::uint32_t met, std::uint32_t most_batches,
                        detail::LaneChoice& chosen) {
        std::uint32_t group = 0;
        std::uint32_t lanes = 0;
        for (std::uint32_t leaves = met & detail::leaf_slots(node); leaves != 0;) {
            const std::uint32_t k = detail::pop_lowest(leaves);
            if (node.ref[k] / 16 == group) continue;
            group = node.ref[k] / 16;
                const char* c = reinterpret_cast<const char*>(lanes_ + group);
                for (int i = 0; i < 12; ++i) __builtin_prefetch(c + 64 * i);
        }
        group = 0;
        for (std::uint32_t leaves = met & detail::leaf_slots(node); leaves != 0;) {
            const std::uint32_t k = detail::pop_lowest(leaves);
            const std::uint32_t last = node.ref[k] + static_cast<std::uint32_t>(node.count[k]);
            for (std::uint32_t first = node.ref[k]; first != last;) {
                const std::uint32_t its = first / detail::lane_count;
                const std::uint32_t end = std::min(last, (its + 1) * detail::lane_count);
                if (its != group && lanes != 0) {
                    const Addition a = add(cluster, group, lanes, most_batches, chosen);
                    if (a != Addition::listed) return a;
                    lanes = 0;
                }
                group = its;
                lanes |= ((1u << (end - first)) - 1u) << first % detail::lane_count;
                first = end;
            }
        }
        return lanes == 0 ? Addition::listed : add(cluster, group, lanes, most_batches, chosen);
    }

    /// Lists those of some triangles that are partial.
    Addition add(const BlockRecords::Cluster& cluster, std::uint32_t group, std::uint32_t lanes,
                 std::uint32_t most_batches, detail::LaneChoice& chosen) {
        MIR_N(23, 1);
        if (list_.size >= most_batches) return Addition::no_room;
        detail::CandidateLanes& batch = list_.batch[list_.size];
        detail::prepare_lanes(lanes_[group], apex_, spread_, block_.sigma, batch);
        batch.group = group;
        const detail::LaneOcclusion found = occlusion(batch, cluster.box, block_.sigma);
        if ((found.full & lanes) != 0) return Addition::covers;
        chosen.lanes[list_.size] = lanes & ~found.none;
        if (chosen.lanes[list_.size] != 0) ++list_.size;
        return Addition::listed;
    }

    /// Chooses the triangles that are partial to a smaller cluster. True when one covers it.
    bool narrow(const BlockRecords::Cluster& cluster, const detail::LaneChoice& known,
                detail::LaneChoice& chosen, std::uint32_t& any_lanes) const {
        MIR_T(27);
        std::uint32_t full = 0;
        any_lanes = 0;
        for (std::uint32_t b = 0; b < list_.size; ++b) {
            chosen.lanes[b] = known.lanes[b];
            if (known.lanes[b] == 0) continue;
            const detail::LaneOcclusion found = occlusion(list_.batch[b], cluster.box, block_.sigma);
            full |= found.full & known.lanes[b];
            chosen.lanes[b] &= ~found.none;
            any_lanes |= chosen.lanes[b];
        }
        return full != 0;
    }

    void decide_part(std::uint32_t p, std::uint32_t* words, const detail::WaitingNodes& of_block,
                     const detail::LaneChoice& block_choice) {
        const BlockRecords::Cluster& part = block_.part[p];
        const std::uint32_t before = list_.size;
        detail::LaneChoice chosen;
        detail::WaitingNodes waiting(of_block);
        std::uint32_t any_lanes = 0;
        bool covered = narrow(part, block_choice, chosen, any_lanes);
        if (BlockRecords::parts != 1 && !covered && waiting.size != 0 && part.within)
            covered = search(part, waiting.size + limits_.part_nodes, detail::LaneList::capacity,
                             waiting, chosen);
        MIR_N(4 + (covered ? 1 : waiting.size ? 3 : 2), 1);
        if (covered) {
            clear_part(words);
        } else if (any_lanes != 0 || list_.size != before || waiting.size != 0) {
            for (std::uint32_t k = 0; k < BlockRecords::part_packets; ++k)
                if (words[k] != 0)
                    words[k] = decide_packet(p * BlockRecords::part_packets + k, words[k], waiting,
                                             chosen);
        }
        list_.size = before;
    }

    std::uint32_t decide_packet(std::uint32_t g, std::uint32_t open,
                                const detail::WaitingNodes& waiting,
                                const detail::LaneChoice& part_choice) const {
        const BlockRecords::Cluster& packet = block_.packet[g];
        detail::LaneChoice chosen;
        std::uint32_t any_lanes = 0;
        if (narrow(packet, part_choice, chosen, any_lanes)) return 0;
        if (any_lanes != 0) open = by_list(g, open, chosen);
        if (open == 0 || waiting.size == 0) return open;
        if (!packet.within) return visible_in_packet(bvh_, apex_, block_.points[g], open);
        MIR_T(29);MIR_N(17, 1);
        const SlotShaft shaft(make_shaft(packet.record, apex_, block_.sigma));
        for (std::uint32_t& b : blocker_) {
            if (b == ~0u) continue;
            const TriangleRows& rows = bvh_.triangles[b];
            open &= ~hit_lanes(rows, detail::origin_rows(rows, apex_), block_.points[g], open);
            if (open == 0) return 0;
        }
        MIR_N(24, 1);
        detail::WidePacketWalk walk(bvh_, shaft, apex_, block_.points[g], open);
        const auto res = walk.run(waiting.node, waiting.size);
        if (walk.blocker != ~0u) {
            blocker_[1] = blocker_[0];
            blocker_[0] = walk.blocker;
        }
        return res;
    }

    std::uint32_t by_list(std::uint32_t g, std::uint32_t open,
                          const detail::LaneChoice& chosen) const {
        MIR_T(28);
        for (std::uint32_t b = 0; b < list_.size; ++b) {
            const detail::CandidateLanes& batch = list_.batch[b];
            for (std::uint32_t rest = chosen.lanes[b]; rest != 0;) {
                const std::uint32_t k = detail::pop_lowest(rest);
                MIR_N(16, 1);
                open &= ~hit_lanes(lanes_[batch.group].rows(k), batch.origin(k), block_.points[g],
                                   open);
                if (open == 0) return 0;
            }
        }
        return open;
    }

    const WideBvhView<Space::host>& bvh_;
    const TriangleLanes* lanes_;
    const BlockRecords& block_;
    Vec3 apex_;
    CascadeLimits limits_;
    float spread_ = 0.0f;
    mutable std::uint32_t blocker_[2] = {~0u, ~0u};
    detail::LaneList list_;
};

}  // namespace mir
