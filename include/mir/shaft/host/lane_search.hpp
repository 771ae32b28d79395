// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_bvh_view.hpp"
#include "mir/accel/wide/wide_packet.hpp"
#include "mir/shaft/exact/shaft_slots.hpp"
#include "mir/shaft/host/block_records.hpp"

#include <algorithm>

namespace mir {

/// What the cascade of the host may cost. Any numbers are right: they decide speed alone.
struct CascadeLimits {
    std::uint32_t nodes = 8;    ///< visited by the shaft of 256 luxels
    std::uint32_t batches = 4;  ///< of sixteen triangles each that it may list; 16 count
};

namespace detail {

/// Some lanes of a list of batches: a word per batch. Uninitialised beyond the list's size.
struct LaneChoice {
    static constexpr std::uint32_t capacity = 16;

    std::uint32_t lanes[capacity];
};

/// What a search knows of the segments of a pair. Those that any triangle hits are hit by one of
/// the chosen lanes of the list or by one below a node that waits. Uninitialised beyond the sizes.
struct LaneSearch {
    CandidateLanes batch[LaneChoice::capacity];
    LaneChoice chosen;
    std::uint32_t batches = 0;
    WaitingNodes waiting;  ///< the next one last

    [[nodiscard]] bool finds_nothing() const { return batches == 0 && waiting.size() == 0; }
};

/// Walks the shaft of a cluster through the hierarchy. From the root until no node waits or the
/// limits are reached. What is then left is handed on, none of the work is lost.
template <InstructionSet Set = InstructionSet::baseline>
class LaneSearcher {
 public:
    LaneSearcher(const WideBvhView<Space::host>& bvh, const TriangleLanes* triangles,
                 const BlockRecords::Cluster& cluster, Vec3 apex, float sigma, LaneSearch& search)
        : bvh_(bvh),
          triangles_(triangles),
          cluster_(cluster),
          apex_(apex),
          sigma_(sigma),
          spread_(larger(max_abs(cluster.record.low - apex), max_abs(cluster.record.high - apex))),
          search_(search) {}

    /// Fills an empty search. True when one single triangle hits all segments.
    bool run(const CascadeLimits& limits) {
        most_batches_ = std::min(limits.batches, LaneChoice::capacity);
        const SlotShaft shaft(make_shaft(cluster_.record, apex_, sigma_));
        search_.waiting.push_root(bvh_.reach);
        for (std::uint32_t i = 0; i < limits.nodes && search_.waiting.size() != 0; ++i) {
            const std::uint32_t before = search_.batches;
            const WideNode& node = bvh_.nodes[search_.waiting.last()];
            const std::uint32_t met = shaft.template met<Set>(node);
            const Addition added = add_leaves(node, met & leaf_slots<Set>(node));
            if (added == Addition::covers) return true;
            if (added == Addition::no_room) {
                search_.batches = before;  // the node goes on waiting
                return false;
            }
            search_.waiting.pop();
            push(node, met & inner_slots<Set>(node));
        }
        return false;
    }

 private:
    enum class Addition { listed, no_room, covers };

    /// So that the first slot is the next one.
    void push(const WideNode& node, std::uint32_t slots) {
        while (slots != 0) {
            const std::uint32_t k = pop_highest(slots);
            prefetch(bvh_.nodes + node.ref[k], sizeof(WideNode));
            search_.waiting.push(node, k);
        }
    }

    /// Lists the triangles of leaves, those that share a batch of the hierarchy together.
    Addition add_leaves(const WideNode& node, std::uint32_t slots) {
        std::uint32_t group = 0;
        std::uint32_t lanes = 0;
        while (slots != 0) {
            const std::uint32_t k = pop_lowest(slots);
            const std::uint32_t last = node.ref[k] + static_cast<std::uint32_t>(node.count[k]);
            for (std::uint32_t first = node.ref[k]; first != last;) {
                const std::uint32_t its = first / lane_count;
                const std::uint32_t end = std::min(last, (its + 1) * lane_count);
                if (its != group && lanes != 0) {
                    const Addition added = add(group, lanes);
                    if (added != Addition::listed) return added;
                    lanes = 0;
                }
                group = its;
                lanes |= ((1u << (end - first)) - 1u) << first % lane_count;
                first = end;
            }
        }
        return lanes == 0 ? Addition::listed : add(group, lanes);
    }

    /// Lists those of a group's triangles that are partial.
    Addition add(std::uint32_t group, std::uint32_t lanes) {
        if (search_.batches >= most_batches_) return Addition::no_room;
        CandidateLanes& batch = search_.batch[search_.batches];
        batch.group = group;
        prepare_lanes(triangles_[group], apex_, spread_, sigma_, batch);
        const LaneOcclusion found = occlusion<Set>(batch, cluster_.box, sigma_);
        if ((found.full & lanes) != 0) return Addition::covers;
        const std::uint32_t partial = lanes & ~found.none;
        search_.chosen.lanes[search_.batches] = partial;
        if (partial != 0) ++search_.batches;
        return Addition::listed;
    }

    const WideBvhView<Space::host>& bvh_;
    const TriangleLanes* triangles_;
    const BlockRecords::Cluster& cluster_;
    Vec3 apex_;
    float sigma_;
    float spread_;
    LaneSearch& search_;
    std::uint32_t most_batches_ = 0;
};

}  // namespace detail
}  // namespace mir
