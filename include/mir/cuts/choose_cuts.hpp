// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/gbuffer.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/cuts/growing_cut.hpp"
#include "mir/cuts/interleaved_order.hpp"
#include "mir/cuts/node_light.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/shading/can_be_lit.hpp"
#include "mir/shading/prepared_luxel.hpp"

#include <limits>

namespace mir {

/// Cuts of blocks in memory that kernels share. Block `i` has `room` places from i * room on.
struct CutTable {
    VplNode* nodes = nullptr;             ///< of the cuts, in leaf order
    std::uint32_t* sizes = nullptr;       ///< nodes of each cut; 0 where no luxel counts
    GrowingCut::Listed* lists = nullptr;  ///< for work
    GrowingCut::Ranked* heaps = nullptr;  ///< for work
    std::uint32_t room = 0;               ///< most nodes of a cut

    /// Bytes that a block of so much room needs.
    static constexpr std::uint64_t bytes_of_block(std::uint32_t room) {
        return sizeof(*sizes) +
               std::uint64_t{room} * (sizeof(*nodes) + sizeof(*lists) + sizeof(*heaps));
    }
    /// Nodes of the cut of block `i`.
    [[nodiscard]] MIR_HD VplNode* cut(std::uint32_t i) const {
        return nodes + std::size_t{i} * room;
    }
    /// Memory in which it grows.
    [[nodiscard]] MIR_HD GrowingCut growing(std::uint32_t i) const {
        return {lists + std::size_t{i} * room, heaps + std::size_t{i} * room};
    }
};

/// Kernel for groups of lanes, a block each: DeviationCut, with its bits. A lane is a luxel of the
/// group that tells the deviation of one of two nodes at a time, the halves of one.
template <GBuffer G, Space S, Shading F>
struct ChooseCuts {
    /// What a group works in.
    struct Workspace {
        std::uint32_t counting[8];                ///< luxels that count, a bit each, interleaved
        NodeSample samples[2][NodeSample::most];  ///< of both nodes
        float variances[LaneGroup::width];        ///< of luxels
        float deviations[2];                      ///< of both nodes
    };

    G luxels;                       ///< of the tile
    VplTreeView<S> tree;            ///< has leaves
    F shade;                        ///< its bound limits what a node can bring
    float floor = 0.0f;             ///< DeviationCut::floor
    std::uint32_t first_block = 0;  ///< of the tile, the first of the table
    CutTable cuts;                  ///< written; `room` nodes are wanted

    /// Block first_block + i.
    MIR_HD void operator()(const LaneGroup& group, std::uint32_t i, Workspace& space) const {
        const LuxelIndex first = (first_block + i) * BlockedLayout::block_size;
        Box box;
        std::uint32_t size = 0;
        if (find_counting(group, first, space, box)) {
            const GrowingCut cut = cuts.growing(i);
            const VplNode root = tree.root();
            find_deviations(group, first, box, root, root, space);
            group.each([&](std::uint32_t lane) {
                if (lane == 0) cut.start(root, space.deviations[0]);
            });
            size = 1;
            for (; size < cuts.room && cut.deviation() > 0.0f; ++size) {
                const VplNode node = cut.widest();
                find_deviations(group, first, box, node.left(), node.right(), space);
                group.each([&](std::uint32_t lane) {
                    if (lane == 0) cut.divide(size, space.deviations[0], space.deviations[1]);
                });
            }
        }
        group.each([&](std::uint32_t lane) {
            if (lane != 0) return;
            cuts.growing(i).write(size, cuts.cut(i));
            cuts.sizes[i] = size;
        });
    }

 private:
    static constexpr std::uint32_t group_size = InterleavedOrder::group_size;
    static constexpr float farthest = std::numeric_limits<float>::max();

    /// Around the luxels that count.
    struct Box {
        Vec3 low;
        Vec3 high;
    };

    /// False if no luxel counts.
    MIR_HD bool find_counting(const LaneGroup& group, LuxelIndex first, Workspace& space,
                              Box& box) const {
        LaneGroup::PerLane<Vec3> low, high;
        group.each_apart([&](std::uint32_t lane) {
            low[lane] = Vec3(farthest);
            high[lane] = Vec3(-farthest);
        });
        bool any = false;
        for (std::uint32_t word = 0; word < 8; ++word) {
            const std::uint32_t counting = group.ballot([&](std::uint32_t lane) {
                const LuxelIndex own = luxel_of(first, word * 2 + lane / group_size, lane);
                const Hit hit = luxels.hit(own);
                if (!can_be_lit(shade, hit, luxels.surface(own))) return false;
                low[lane] = glm::min(low[lane], hit.position);
                high[lane] = glm::max(high[lane], hit.position);
                return true;
            });
            group.each([&](std::uint32_t lane) {
                if (lane == 0) space.counting[word] = counting;
            });
            any = any || counting != 0;
        }
        for (int axis = 0; axis < 3; ++axis) {
            LaneGroup::PerLane<float> least, most;
            group.each_apart([&](std::uint32_t lane) {
                least[lane] = low[lane][axis];
                most[lane] = high[lane][axis];
            });
            box.low[axis] = group.smallest(least);
            box.high[axis] = group.largest(most);
        }
        return any;
    }

    /// Finds the deviations of two nodes, each by one half of the lanes.
    MIR_HD void find_deviations(const LaneGroup& group, LuxelIndex first, const Box& box,
                                const VplNode& left, const VplNode& right, Workspace& space) const {
        group.each([&](std::uint32_t lane) {
            const VplNode node = lane < group_size ? left : right;
            const std::uint32_t k = lane % group_size;
            if (!node.is_leaf() && k < NodeSample::count_of(node))
                space.samples[lane / group_size][k] = NodeSample::of(tree, node, k);
        });
        group.each([&](std::uint32_t lane) {
            const VplNode node = lane < group_size ? left : right;
            space.variances[lane] = node.is_leaf() ? 0.0f : variance(first, lane, node, space);
        });
        group.each([&](std::uint32_t lane) {
            if (lane >= 2) return;
            const VplNode node = lane == 0 ? left : right;
            space.deviations[lane] = node.is_leaf() ? 0.0f : deviation(box, node, lane, space);
        });
    }

    /// Variance of what the samples of a lane's node bring to its luxel.
    [[nodiscard]] MIR_HD float variance(LuxelIndex first, std::uint32_t lane, const VplNode& node,
                                        const Workspace& space) const {
        const auto candidates = [&](std::uint32_t g) {
            return space.counting[g / 2] >> g % 2 * group_size & 0xFFFFu;
        };
        const std::uint32_t g = telling_group(node, InterleavedOrder::groups, candidates);
        if ((candidates(g) >> lane % group_size & 1u) == 0) return 0.0f;
        const LuxelIndex own = luxel_of(first, g, lane);
        const auto luxel = PreparedLuxel<F>::of(shade, luxels.hit(own), luxels.surface(own));
        SampleMoments moments;
        for (std::uint32_t k = 0; k < NodeSample::count_of(node); ++k) {
            const NodeSample& sample = space.samples[lane / group_size][k];
            moments.add(sample.share, luxel.lit_by(sample.vpl, shade));
        }
        return moments.variance();
    }

    /// Deviation of the node of a half of the lanes.
    [[nodiscard]] MIR_HD float deviation(const Box& box, const VplNode& node, std::uint32_t half,
                                         const Workspace& space) const {
        float sum = 0.0f;
        for (std::uint32_t k = 0; k < group_size; ++k)
            sum += space.variances[half * group_size + k];
        const float largest =
            largest_light(box.low, box.high, tree.bounds(node), node.count, shade.bound);
        return larger(root_of_mean(sum, group_size), floor * largest);
    }

    /// The luxel of a lane in a group of the block.
    [[nodiscard]] MIR_HD static LuxelIndex luxel_of(LuxelIndex first, std::uint32_t g,
                                                    std::uint32_t lane) {
        return first + InterleavedOrder::place_of(g, lane % group_size);
    }
};
template <class G, Space S, class F>
ChooseCuts(G, VplTreeView<S>, F, float, std::uint32_t, CutTable) -> ChooseCuts<G, S, F>;

}  // namespace mir
