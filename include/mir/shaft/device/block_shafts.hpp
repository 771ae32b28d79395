// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/shaft/device/faced_blocks.hpp"
#include "mir/shaft/device/leaf_pool.hpp"
#include "mir/shaft/device/leaf_search.hpp"
#include "mir/shaft/device/vpl_batch.hpp"
#include "mir/shaft/device/work_queue.hpp"

namespace mir {

/// Decides pairs of 256 luxels and a VPL. Kernel for groups, a block per lane, neighbouring blocks
/// and one VPL a group. Zeroes the words of pairs that a triangle covers, leaves those of clear
/// ones as they are, facing masks (FacingPass), and queues the rest: with all triangles that are
/// partial, if it has found them, since those of each cluster are among them.
template <Space S, VplSet P>
struct BlockShafts {
    /// Thread blocks that a multiprocessor of a GPU is to hold at least.
    static constexpr std::uint32_t resident_blocks = 7;
    /// Words of visibility of a block and a VPL.
    static constexpr std::uint32_t block_words = block_luxels / cluster_luxels;
    static constexpr std::uint32_t most_triangles = 32;  ///< tested for a pair
    static_assert(most_triangles <= LaneGroup::width);   // share_list() has a lane for each

    /// What a group works in.
    struct Workspace {
        LeafColumns<16> leaves;  ///< that the lanes' shafts meet
    };

    const ClusterRecord* blocks = nullptr;  ///< of 256 luxels
    P vpls;                                 ///< all, not those of the batch alone
    VplBatch batch;                         ///< whose pairs are decided
    QuantisedBvhView<S> bvh;                ///< of the scene
    float sigma = 0.0f;                     ///< of the scene, metres, as for the records
    std::uint32_t most_nodes = 0;           ///< visited by a shaft
    FacedBlocks faced;                      ///< by the batch, of all blocks
    std::uint32_t* words = nullptr;         ///< as VisibilityWords
    WorkQueue<ListedPair> listed;           ///< blocks with partial triangles; may run full
    LeafPool pool;                          ///< for the triangles of `listed`; may run full
    WorkQueue<OpenPair> open;               ///< other blocks; has room for all

    /// Groups that cover all pairs.
    [[nodiscard]] static std::uint32_t groups(std::uint32_t blocks, VplBatch batch) {
        return (blocks + LaneGroup::width - 1) / LaneGroup::width * batch.count;
    }

    /// Group `i` < groups(). VPL batch.first + i % batch.count and the 32 blocks from 32 (i /
    /// batch.count) on.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        const std::uint32_t k = i % batch.count;
        const VplIndex j = batch.first + k;
        const std::uint32_t first = i / batch.count * LaneGroup::width;
        const Vec3 apex = vpls[j].position;
        const float reach = bvh.exact.reach;
        const bool is_proved = is_proved_scale(reach) && within_reach(apex, reach);

        LaneGroup::PerLane<PairState> states;
        LaneGroup::PerLane<LeafSearch> searches;
        LaneGroup::PerLane<ShaftSlabs> slabs;
        LaneGroup::PerLane<LeafStack> stacks;
        group.each([&](std::uint32_t lane) {
            const std::uint32_t block = first + lane;
            const bool is_alive = block < faced.blocks && faced.at(block, k) != 0;
            const bool on = is_alive && is_proved && within_reach(blocks[block], reach);
            states[lane] = is_alive ? PairState::unknown : PairState::clear;
            if (on) slabs[lane] = make_shaft_slabs(blocks[block], apex, sigma, reach);
            searches[lane].begin(on);
        });
        while (running_lanes(group, searches) != 0)
            visit_nodes(group, bvh, slabs, most_nodes, searches, stacks, space.leaves);
        LaneGroup::PerLane<std::uint32_t> partial;
        classify(group, first, apex, searches, space, states, partial);
        group.each([&](std::uint32_t lane) {
            if (states[lane] == PairState::covered) clear_words(first + lane, j);
        });
        const std::uint32_t undecided = group.ballot([&](std::uint32_t lane) {
            return states[lane] == PairState::unknown || states[lane] == PairState::listed;
        });
        const std::uint32_t stored = store(group, {first, j}, searches, space, partial);
        static_cast<void>(open.append(group, undecided & ~stored, [&](std::uint32_t lane) {
            return OpenPair{first + lane, j};
        }));
    }

 private:
    MIR_HD void clear_words(std::uint32_t block, VplIndex j) const {
        std::uint32_t* word = words + std::size_t{block} * block_words * vpls.size() + j;
        for (std::uint32_t k = 0; k < block_words; ++k) word[std::size_t{k} * vpls.size()] = 0;
    }

    /// Tests the triangles of a lane's leaves against its pyramid, one per turn. Bits of
    /// partial[lane] tell which of them are partial, where these are all that there are.
    MIR_HD void classify(const LaneGroup& group, std::uint32_t first, Vec3 apex,
                         const LaneGroup::PerLane<LeafSearch>& searches, const Workspace& space,
                         LaneGroup::PerLane<PairState>& states,
                         LaneGroup::PerLane<std::uint32_t>& partial) const {
        LaneGroup::PerLane<Pyramid> pyramids;
        LaneGroup::PerLane<LeafCursor> cursors;
        group.each([&](std::uint32_t lane) {
            const LeafSearch& search = searches[lane];
            partial[lane] = 0;
            cursors[lane].begin(search.listed);
            if (search.listed > 0) pyramids[lane] = make_pyramid(blocks[first + lane], apex, sigma);
            if (search.state == LeafSearchState::complete) states[lane] = PairState::clear;
        });
        const auto lanes_with_more = [&] {
            return group.ballot([&](std::uint32_t lane) { return cursors[lane].has_more(); });
        };
        for (std::uint32_t turn = 0; turn < most_triangles && lanes_with_more() != 0; ++turn)
            group.each([&](std::uint32_t lane) {
                LeafCursor& cursor = cursors[lane];
                if (!cursor.has_more()) return;
                if (!cursor.find(bvh.links, space.leaves, lane)) return;
                const Occlusion found =
                    occlusion(bvh.exact.triangles[cursor.triangles.pop()], pyramids[lane]);
                partial[lane] |= (found == Occlusion::none ? 0u : 1u) << turn;
                if (found == Occlusion::full) cursor.stop();
                states[lane] = after(states[lane], found);
            });
        group.each([&](std::uint32_t lane) {
            if (cursors[lane].has_more()) states[lane] = PairState::unknown;
            if (states[lane] != PairState::listed) partial[lane] = 0;
        });
    }

    /// What is known of a pair after one more of its triangles.
    [[nodiscard]] MIR_HD static PairState after(PairState state, Occlusion found) {
        if (found == Occlusion::full) return PairState::covered;
        const bool is_first = found == Occlusion::partial && state == PairState::clear;
        return is_first ? PairState::listed : state;
    }

    /// Queues the pairs of lanes that have partial triangles, with these. `pair` is that of lane 0.
    /// Returns the lanes for which there was room.
    [[nodiscard]] MIR_HD std::uint32_t store(
        const LaneGroup& group, OpenPair pair, const LaneGroup::PerLane<LeafSearch>& searches,
        const Workspace& space, const LaneGroup::PerLane<std::uint32_t>& partial) const {
        LaneGroup::PerLane<std::uint32_t> counts;
        LaneGroup::PerLane<std::uint32_t> places;
        group.each([&](std::uint32_t lane) { counts[lane] = LaneGroup::count(partial[lane]); });
        const std::uint32_t stored = pool.reserve(group, counts, places);
        group.each([&](std::uint32_t lane) {
            if ((stored >> lane & 1u) != 0)
                copy(places[lane], lane, searches[lane].listed, partial[lane], space);
        });
        const std::uint32_t left = listed.append(group, stored, [&](std::uint32_t lane) {
            return ListedPair{{pair.cluster + lane, pair.vpl}, places[lane], counts[lane]};
        });
        return stored & ~left;
    }

    /// Copies the triangles of a lane's leaves whose bits are set in `partial`. Bits are those of
    /// the turns in which classify() has tested them.
    MIR_HD void copy(std::uint32_t to, std::uint32_t lane, std::uint32_t nodes,
                     std::uint32_t partial, const Workspace& space) const {
        LeafCursor cursor;
        cursor.begin(nodes);
        for (; partial != 0; partial >>= 1) {
            if (!cursor.find(bvh.links, space.leaves, lane)) continue;
            const std::uint32_t triangle = cursor.triangles.pop();
            if ((partial & 1u) != 0) pool.words[to++] = triangle;
        }
    }

    /// The triangles of a lane's leaves, one node after the other.
    struct LeafCursor {
        std::uint32_t at;         ///< in the lane's column
        std::uint32_t listed;     ///< of it
        LeafTriangles triangles;  ///< of the node before, those that are left

        MIR_HD void begin(std::uint32_t count) {
            at = 0;
            listed = count;
            triangles = {{0, 0}, {0, 0}};
        }
        [[nodiscard]] MIR_HD bool has_more() const { return !triangles.empty() || at < listed; }
        MIR_HD void stop() { begin(0); }

        /// Goes to the next node when none is left; false when that has none either.
        template <std::uint32_t Capacity>
        MIR_HD bool find(const NodeLinks* links, const LeafColumns<Capacity>& columns,
                         std::uint32_t lane) {
            if (!triangles.empty()) return true;
            const MetLeaves met = columns.met[at++][lane];
            triangles = links[met.node()].leaves(met.slots());
            return !triangles.empty();
        }
    };
};

}  // namespace mir
