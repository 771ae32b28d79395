// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuts/cut_policy.hpp"
#include "mir/cuts/growing_cut.hpp"
#include "mir/cuts/node_deviation.hpp"

#include <algorithm>
#include <vector>

namespace mir {

/// Divides the node whose pick deviates most, again and again. A few VPLs of the node, with nothing
/// in between, estimate the deviation, so no ray is traced. A node that may hold a VPL next to the
/// block, which those few can miss, counts at least as `floor` of the most that its light can be.
/// Model of CutPolicy. Source: Walter et al., "Lightcuts", SIGGRAPH 2005, with a deviation instead
/// of a bound.
struct DeviationCut {
    std::uint32_t picks = 256;  ///< most nodes, at least 1
    /// Share of the largest light of a node, 0..1. Measured: 1e-4 is best or near it from 16 to
    /// 1024 picks (docs/decisions/050).
    float floor = 1e-4f;

    /// A cut of at most `picks` nodes; fewer where all are leaves.
    template <InstructionSet Set, Shading F>
    [[nodiscard]] VplCut choose(const CutBlock<F>& block, const VplTree& tree,
                                const F& shading) const {
        const std::size_t most = std::min(picks, tree.size());
        std::vector<GrowingCut::Listed> list(most);
        std::vector<GrowingCut::Ranked> heap(most);
        const GrowingCut growing{list.data(), heap.data()};
        blocks::LitVpls batch;
        const auto deviation = [&](const VplNode& node) {
            return deviation_of<Set>(block, tree, shading, batch, node);
        };
        growing.start(tree.root(), deviation(tree.root()));
        std::uint32_t size = 1;
        for (; size < picks && growing.deviation() > 0.0f; ++size) {
            const VplNode node = growing.widest();
            growing.divide(size, deviation(node.left()), deviation(node.right()));
        }
        VplCut cut(size);
        growing.write(size, cut.data());
        return cut;
    }

 private:
    template <InstructionSet Set, Shading F>
    [[nodiscard]] float deviation_of(const CutBlock<F>& block, const VplTree& tree,
                                     const F& shading, blocks::LitVpls& batch,
                                     const VplNode& node) const {
        if (node.is_leaf()) return 0.0f;
        const std::uint32_t group = telling_group(
            node, blocks::groups_per_block, [&](std::uint32_t g) { return block.candidates[g]; });
        const float largest = largest_light(block.bounds.low, block.bounds.high, tree.bounds(node),
                                            node.count, shading.bound);
        return larger(node_deviation<Set>(block, group, tree, node, shading, batch),
                      floor * largest);
    }
};

}  // namespace mir
