// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/block_shafts.hpp"

namespace mir {

/// Memory for the leaves that shafts meet.
struct LeafPool {
    MetLeaves* leaves = nullptr;    ///< `capacity` of them
    std::uint32_t capacity = 0;     ///< leaves that there is room for
    std::uint32_t* used = nullptr;  ///< starts at 0
};

/// Looks for the leaves of pairs of 32 luxels and a VPL that a block's shaft left open: kernel for
/// groups, a cluster per lane, four blocks at a time. Leaves the words of clear pairs, facing
/// masks, as they are. Pairs with leaves are queued with them, those whose search gave up or for
/// which there is no room without.
template <Space S, VplSet P>
struct ClusterShafts {
    /// As BlockShafts::resident_blocks.
    static constexpr std::uint32_t resident_blocks = 6;
    /// Words of visibility of a block and a VPL.
    static constexpr std::uint32_t block_words = block_luxels / cluster_luxels;
    /// Blocks that a group takes together, a cluster per lane.
    static constexpr std::uint32_t blocks_at_once = LaneGroup::width / block_words;

    /// What a group works in.
    struct Workspace {
        LeafColumns<32> leaves;  ///< that the lanes' shafts meet
    };

    const ClusterRecord* clusters = nullptr;  ///< of 32 luxels
    P vpls;                                   ///< those of the words
    QuantisedBvhView<S> bvh;                  ///< of the scene
    float sigma = 0.0f;                       ///< of the scene, metres, as for the records
    std::uint32_t most_nodes = 0;             ///< visited by a shaft
    const std::uint32_t* words = nullptr;     ///< as VisibilityWords
    WorkQueue<OpenPair> blocks;               ///< to decide
    WorkQueue<ListedPair> listed;  ///< clusters with all leaves of their shafts; may run full
    LeafPool pool;                 ///< for the leaves of `listed`; may run full
    WorkQueue<OpenPair> open;      ///< clusters, left to single segments; has room for all

    /// Takes pairs from `blocks` until none is left: any number of groups does all the work.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t /*i*/, Workspace& space) const {
        const std::uint32_t count = blocks.size();
        for (std::uint32_t first = blocks.take(group, blocks_at_once); first < count;
             first = blocks.take(group, blocks_at_once))
            search(group, first, count, space);
    }

 private:
    /// What a lane works on.
    struct Task {
        bool is_alive;
        OpenPair pair;
    };

    MIR_HD void search(const LaneGroup& group, std::uint32_t first, std::uint32_t count,
                       Workspace& space) const {
        LaneGroup::PerLane<Task> tasks;
        LaneGroup::PerLane<LeafSearch> searches;
        LaneGroup::PerLane<ShaftSlabs> slabs;
        group.each([&](std::uint32_t lane) {
            tasks[lane] = task_of(first, count, lane);
            const bool on = tasks[lane].is_alive && is_proved(tasks[lane].pair);
            if (on)
                slabs[lane] =
                    make_shaft_slabs(clusters[tasks[lane].pair.cluster],
                                     vpls[tasks[lane].pair.vpl].position, sigma, bvh.exact.reach);
            searches[lane].begin(on);
        });
        search_leaves(group, bvh, slabs, most_nodes, searches, space.leaves);
        std::uint32_t undecided = group.ballot([&](std::uint32_t lane) {
            return tasks[lane].is_alive && searches[lane].state != LeafSearchState::complete;
        });
        undecided |= store(group, tasks, searches, space);
        static_cast<void>(
            open.append(group, undecided, [&](std::uint32_t lane) { return tasks[lane].pair; }));
    }

    [[nodiscard]] MIR_HD Task task_of(std::uint32_t first, std::uint32_t count,
                                      std::uint32_t lane) const {
        const std::uint32_t at = first + lane / block_words;
        if (at >= count) return {false, {}};
        const OpenPair block = blocks.items[at];
        const std::uint32_t cluster = block.cluster * block_words + lane % block_words;
        const std::uint32_t word = words[std::size_t{cluster} * vpls.size() + block.vpl];
        return {word != 0, {cluster, block.vpl}};
    }

    [[nodiscard]] MIR_HD bool is_proved(OpenPair pair) const {
        const float reach = bvh.exact.reach;
        return is_proved_scale(reach) && within_reach(vpls[pair.vpl].position, reach) &&
               within_reach(clusters[pair.cluster], reach);
    }

    /// Queues the pairs of all lanes that have a complete list. Returns the lanes for which there
    /// was no room.
    [[nodiscard]] MIR_HD std::uint32_t store(const LaneGroup& group,
                                             const LaneGroup::PerLane<Task>& tasks,
                                             const LaneGroup::PerLane<LeafSearch>& searches,
                                             const Workspace& space) const {
        LaneGroup::PerLane<std::uint32_t> place;
        group.each([&](std::uint32_t lane) {
            const bool is_complete = searches[lane].state == LeafSearchState::complete;
            place[lane] = is_complete ? searches[lane].listed : 0u;
        });
        const std::uint32_t lists =
            group.ballot([&](std::uint32_t lane) { return place[lane] > 0; });
        // Asked before more is added: so the count cannot wrap around.
        if (lists == 0 || group.add(*pool.used, 0) > pool.capacity) return lists;
        const std::uint32_t total = group.sums_before(place);
        const std::uint32_t first = group.add(*pool.used, total);
        const std::uint32_t fitting = group.ballot([&](std::uint32_t lane) {
            return first + place[lane] + searches[lane].listed <= pool.capacity;
        });
        group.each([&](std::uint32_t lane) {
            if ((lists & fitting) >> lane & 1u)
                return copy(first + place[lane], lane, searches[lane], space);
        });
        const std::uint32_t left = listed.append(group, lists & fitting, [&](std::uint32_t lane) {
            return ListedPair{tasks[lane].pair, first + place[lane], searches[lane].listed};
        });
        return left | (lists & ~fitting);
    }

    MIR_HD void copy(std::uint32_t to, std::uint32_t lane, const LeafSearch& search,
                     const Workspace& space) const {
        for (std::uint32_t k = 0; k < search.listed; ++k)
            pool.leaves[to + k] = space.leaves.met[k][lane];
    }
};

}  // namespace mir
