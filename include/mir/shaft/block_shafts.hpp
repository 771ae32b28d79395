// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/vpl_set.hpp"
#include "mir/shaft/faced_blocks.hpp"
#include "mir/shaft/leaf_search.hpp"
#include "mir/shaft/vpl_batch.hpp"
#include "mir/shaft/work_queue.hpp"

namespace mir {

/// Decides pairs of 256 luxels and a VPL: kernel for groups, a block per lane, neighbouring blocks
/// and one VPL a group. Zeroes the words of pairs that a triangle covers, leaves those of clear
/// ones as they are, facing masks (FacingPass), and queues the rest.
template <Space S, VplSet P>
struct BlockShafts {
    /// Thread blocks that a multiprocessor of a GPU is to hold at least.
    static constexpr std::uint32_t resident_blocks = 7;
    /// Words of visibility of a block and a VPL.
    static constexpr std::uint32_t block_words = block_luxels / cluster_luxels;
    static constexpr std::uint32_t most_triangles = 32;  ///< tested for a pair

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
    WorkQueue<OpenPair> open;               ///< blocks; has room for all

    /// Groups that cover all pairs.
    [[nodiscard]] static std::uint32_t groups(std::uint32_t blocks, VplBatch batch) {
        return (blocks + LaneGroup::width - 1) / LaneGroup::width * batch.count;
    }

    /// Group `i` < groups(): VPL batch.first + i % batch.count and the 32 blocks from
    /// 32 (i / batch.count) on.
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
        classify(group, first, apex, searches, space, states);
        group.each([&](std::uint32_t lane) {
            if (states[lane] == PairState::covered) clear_words(first + lane, j);
        });
        const std::uint32_t undecided = group.ballot([&](std::uint32_t lane) {
            return states[lane] == PairState::unknown || states[lane] == PairState::listed;
        });
        static_cast<void>(open.append(group, undecided, [&](std::uint32_t lane) {
            return OpenPair{first + lane, j};
        }));
    }

 private:
    MIR_HD void clear_words(std::uint32_t block, VplIndex j) const {
        std::uint32_t* word = words + std::size_t{block} * block_words * vpls.size() + j;
        for (std::uint32_t k = 0; k < block_words; ++k) word[std::size_t{k} * vpls.size()] = 0;
    }

    /// Tests the triangles of a lane's leaves against its pyramid, one per turn.
    MIR_HD void classify(const LaneGroup& group, std::uint32_t first, Vec3 apex,
                         const LaneGroup::PerLane<LeafSearch>& searches, const Workspace& space,
                         LaneGroup::PerLane<PairState>& states) const {
        LaneGroup::PerLane<Pyramid> pyramids;
        LaneGroup::PerLane<LeafCursor> cursors;
        group.each([&](std::uint32_t lane) {
            const LeafSearch& search = searches[lane];
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
                if (found == Occlusion::none) return;
                if (found == Occlusion::full) cursor.stop();
                if (found == Occlusion::full)
                    states[lane] = PairState::covered;
                else if (states[lane] == PairState::clear)
                    states[lane] = PairState::listed;
            });
        group.each([&](std::uint32_t lane) {
            if (cursors[lane].has_more()) states[lane] = PairState::unknown;
        });
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
