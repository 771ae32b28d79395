// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/shaft/device/leaf_pool.hpp"
#include "mir/shaft/device/leaf_search.hpp"
#include "mir/shaft/device/work_queue.hpp"

namespace mir {

/// Looks for the leaves of pairs of 32 luxels and a VPL. Their block has no list: kernel for
/// groups, a cluster per lane, four blocks at a time. Leaves the words of clear pairs, facing
/// masks, as they are. Pairs with leaves are queued with them, those whose search gave up or for
/// which there is no room without.
template <Space S, VplSet P>
struct ClusterShafts {
    /// As BlockShafts::resident_blocks.
    static constexpr std::uint32_t resident_blocks = 6;
    /// Words of visibility of a block and a VPL.
    static constexpr std::uint32_t block_words = block_luxels / cluster_luxels;
    /// Lanes whose searches have ended wait for the next pairs until so few others search,
    static constexpr std::uint32_t few_lanes = 20;
    /// and until so many nodes have been visited since pairs were last handed out. That has a
    /// price.
    static constexpr std::uint32_t least_turns = 8;

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

    /// Takes pairs from `blocks` until none is left. Any number of groups does all the work.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t /*i*/, Workspace& space) const {
        LaneGroup::PerLane<Task> tasks;
        LaneGroup::PerLane<LeafSearch> searches;
        LaneGroup::PerLane<ShaftSlabs> slabs;
        LaneGroup::PerLane<LeafStack> stacks;
        group.each([&](std::uint32_t lane) {
            tasks[lane] = {false, {}};
            searches[lane].begin(false);
        });
        const std::uint32_t count = blocks.size() * block_words;
        bool has_more = true;
        for (std::uint32_t turns = 0;; ++turns) {
            std::uint32_t running = running_lanes(group, searches);
            const bool are_few = LaneGroup::count(running) <= few_lanes && turns >= least_turns;
            if (has_more && (are_few || running == 0)) {
                conclude(group, tasks, searches, space);
                has_more = begin(group, ~running, count, tasks, searches, slabs);
                running = running_lanes(group, searches);
                turns = 0;
            }
            if (running == 0 && !has_more) break;
            visit_nodes(group, bvh, slabs, most_nodes, searches, stacks, space.leaves);
        }
        conclude(group, tasks, searches, space);
    }

 private:
    /// What a lane works on.
    struct Task {
        bool is_alive;
        OpenPair pair;
    };

    /// Gives some lanes a search each. False when none is left.
    MIR_HD bool begin(const LaneGroup& group, std::uint32_t lanes, std::uint32_t count,
                      LaneGroup::PerLane<Task>& tasks, LaneGroup::PerLane<LeafSearch>& searches,
                      LaneGroup::PerLane<ShaftSlabs>& slabs) const {
        const std::uint32_t first = blocks.take(group, LaneGroup::count(lanes));
        group.each([&](std::uint32_t lane) {
            if ((lanes >> lane & 1u) == 0) return;
            const std::uint32_t at = first + LaneGroup::count_before(lanes, lane);
            tasks[lane] = at < count ? task(at) : Task{false, {}};
            const bool on = tasks[lane].is_alive && is_proved(tasks[lane].pair);
            if (on)
                slabs[lane] =
                    make_shaft_slabs(clusters[tasks[lane].pair.cluster],
                                     vpls[tasks[lane].pair.vpl].position, sigma, bvh.exact.reach);
            searches[lane].begin(on);
        });
        return first < count;
    }

    /// Passes on what the searches that have ended found.
    MIR_HD void conclude(const LaneGroup& group, const LaneGroup::PerLane<Task>& tasks,
                         const LaneGroup::PerLane<LeafSearch>& searches,
                         const Workspace& space) const {
        std::uint32_t undecided = group.ballot([&](std::uint32_t lane) {
            return tasks[lane].is_alive && !searches[lane].is_running() &&
                   searches[lane].state != LeafSearchState::complete;
        });
        undecided |= store(group, tasks, searches, space);
        static_cast<void>(
            open.append(group, undecided, [&](std::uint32_t lane) { return tasks[lane].pair; }));
    }

    /// Cluster at % block_words of the block at / block_words in the queue.
    [[nodiscard]] MIR_HD Task task(std::uint32_t at) const {
        const OpenPair block = blocks.items[at / block_words];
        const std::uint32_t cluster = block.cluster * block_words + at % block_words;
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
        LaneGroup::PerLane<std::uint32_t> counts;
        LaneGroup::PerLane<std::uint32_t> places;
        const std::uint32_t lists = group.ballot([&](std::uint32_t lane) {
            const bool is_complete = searches[lane].state == LeafSearchState::complete;
            counts[lane] = is_complete ? searches[lane].listed : 0u;
            return counts[lane] > 0;
        });
        const std::uint32_t stored = pool.reserve(group, counts, places);
        group.each([&](std::uint32_t lane) {
            if ((stored >> lane & 1u) == 0) return;
            for (std::uint32_t k = 0; k < counts[lane]; ++k)
                pool.words[places[lane] + k] = space.leaves.met[k][lane].bits;
        });
        const std::uint32_t left = listed.append(group, stored, [&](std::uint32_t lane) {
            return ListedPair{tasks[lane].pair, places[lane], counts[lane]};
        });
        return left | (lists & ~stored);
    }
};

}  // namespace mir
