// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuts/cut_policy.hpp"
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
        std::vector<Candidate> heap;
        blocks::LitVpls batch;
        heap.reserve(picks + 1);
        heap.push_back(candidate<Set>(block, tree, shading, batch, tree.root()));
        while (heap.size() < picks && heap.front().deviation > 0.0f) {
            std::pop_heap(heap.begin(), heap.end());
            const VplNode node = heap.back().node;
            heap.back() = candidate<Set>(block, tree, shading, batch, node.left());
            std::push_heap(heap.begin(), heap.end());
            heap.push_back(candidate<Set>(block, tree, shading, batch, node.right()));
            std::push_heap(heap.begin(), heap.end());
        }
        return in_leaf_order(heap);
    }

 private:
    struct Candidate {
        VplNode node;
        float deviation = 0.0f;

        friend bool operator<(const Candidate& a, const Candidate& b) {
            return a.deviation != b.deviation ? a.deviation < b.deviation
                                              : a.node.first > b.node.first;
        }
    };

    template <InstructionSet Set, Shading F>
    [[nodiscard]] Candidate candidate(const CutBlock<F>& block, const VplTree& tree,
                                      const F& shading, blocks::LitVpls& batch,
                                      const VplNode& node) const {
        if (node.is_leaf()) return {node, 0.0f};
        // One group tells: luxels of all squares of the block. Another one for each node.
        std::uint32_t group = node.first * 7 % blocks::groups_per_block;
        while (block.candidates[group] == 0) group = (group + 1) % blocks::groups_per_block;
        const float deviation = node_deviation<Set>(block, group, tree, node, shading, batch);
        return {node, larger(deviation, floor * largest_light(block.bounds, tree, node, shading))};
    }

    /// The most that a node's VPLs can bring to the block. The luxel reflects all light. The luxel
    /// reflects all light.
    template <Shading F>
    [[nodiscard]] static float largest_light(const blocks::BlockBounds& luxels, const VplTree& tree,
                                             const VplNode& node, const F& shading) {
        const VplBounds& vpls = tree.bounds(node);
        const Vec3 gap =
            glm::max(glm::max(vpls.low - luxels.high, luxels.low - vpls.high), Vec3(0.0f));
        const float geometry = smaller(1.0f / length_squared(gap), shading.bound);
        return static_cast<float>(node.count) * vpls.most * geometry;
    }

    static VplCut in_leaf_order(const std::vector<Candidate>& heap) {
        VplCut cut;
        cut.reserve(heap.size());
        for (const Candidate& c : heap) cut.push_back(c.node);
        std::sort(cut.begin(), cut.end(),
                  [](const VplNode& a, const VplNode& b) { return a.first < b.first; });
        return cut;
    }
};

}  // namespace mir
