// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/luxel_block.hpp"
#include "mir/cuts/vpl_tree.hpp"

#include <concepts>
#include <vector>

namespace mir {

/// Nodes that hold every leaf of a tree once, in leaf order.
using VplCut = std::vector<VplNode>;

/// 256 luxels of an image, ready to meet VPLs, and a box around them.
template <Shading F>
using CutBlock = blocks::LuxelBlock<F, blocks::BoundedHitBlock>;

/// Chooses the cut by which a block of luxels gathers a tree of VPLs. The result must
/// depend only on the arguments, not on threads, tiles or the picks to come. Any cut
/// is unbiased; a good one makes the picks of a node differ little in what they
/// bring.
///
/// Axioms (tests/cuts/cut_suite.hpp): the nodes hold every leaf once, in leaf order; the same
/// arguments give the same cut, for every instruction set.
template <class P, class F>
concept CutPolicy = Shading<F> &&
    requires(const P p, const CutBlock<F>& block, const VplTree& tree, const F& shading) {
    { p.template choose<InstructionSet::baseline>(block, tree, shading) } -> std::same_as<VplCut>;
};

/// Every VPL, one by one: the sum that is the mean of every other cut. Model of CutPolicy.
struct CompleteCut {
    /// All leaves.
    template <InstructionSet Set, Shading F>
    [[nodiscard]] VplCut choose(const CutBlock<F>& /*block*/, const VplTree& tree,
                                const F& /*shading*/) const {
        VplCut cut;
        append_leaves(tree.root(), cut);
        return cut;
    }

 private:
    static void append_leaves(const VplNode& node, VplCut& cut) {
        if (node.is_leaf()) return cut.push_back(node);
        append_leaves(node.left(), cut);
        append_leaves(node.right(), cut);
    }
};

/// Parts of about equal numbers of VPLs, for comparison: as plain VPLs are, but stratified. Model
/// of CutPolicy.
struct EqualCountCut {
    std::uint32_t picks = 256;  ///< most nodes, at least 1

    /// Nodes of one level of the tree, or of two.
    template <InstructionSet Set, Shading F>
    [[nodiscard]] VplCut choose(const CutBlock<F>& /*block*/, const VplTree& tree,
                                const F& /*shading*/) const {
        VplCut cut;
        append_parts(tree.root(), picks, cut);
        return cut;
    }

 private:
    static void append_parts(const VplNode& node, std::uint32_t parts, VplCut& cut) {
        if (parts <= 1 || node.is_leaf()) return cut.push_back(node);
        append_parts(node.left(), parts / 2, cut);
        append_parts(node.right(), parts - parts / 2, cut);
    }
};

}  // namespace mir
