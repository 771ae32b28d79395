// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/detail/binary_node.hpp"
#include "mir/accel/wide_node.hpp"

namespace mir::detail {

// Why trees keep their depth. Let H(h) = ceil(h / 3) be the nodes that a binary tree of height h
// needs if every wide node takes three levels of it. Claim: a wide node below d others, made of a
// binary node of height h, keeps d + H(h) <= D, the largest depth allowed. It does at the root
// (cluster_plan.hpp). Children are less high than h, so nodes are opened by area if
// d + 1 + H(h - 1) <= D. Otherwise the highest one is opened seven times: once, then the two at
// most that have h - 1, then the four at most that have h - 2, which leaves h - 3, and
// d + 1 + H(h - 3) = d + H(h). What fits into a leaf has height 0 and becomes one.

/// Nodes of the binary tree that become the children of a wide node.
struct WideChildren {
    static constexpr std::uint32_t none = 0xFFFFFFFFu;

    std::uint32_t at[WideNode::width];  ///< `none` behind the last
};

/// Some nodes of the binary tree, opened one after the other.
class OpenedNodes {
 public:
    /// `first` says where the triangles below each node begin, in the order of leaves.
    MIR_HD OpenedNodes(const BinaryNode* nodes, std::uint32_t* first, std::uint32_t root)
        : nodes_(nodes), first_(first) {
        children_.at[0] = root;
        for (std::uint32_t k = 1; k < WideNode::width; ++k) children_.at[k] = WideChildren::none;
    }

    [[nodiscard]] MIR_HD bool is_full() const { return count_ == WideNode::width; }
    [[nodiscard]] MIR_HD const WideChildren& children() const { return children_; }

    /// Place of the largest surface among nodes of more than `size` triangles, or width; of equal
    /// ones that of the most triangles, lest coincident triangles become a long chain.
    [[nodiscard]] MIR_HD std::uint32_t largest(std::uint32_t size, float area_scale) const {
        std::uint32_t best = WideNode::width;
        float largest_area = -1.0f;
        std::uint32_t most = 0;
        for (std::uint32_t k = 0; k < count_; ++k) {
            const BinaryNode& node = nodes_[children_.at[k]];
            if (node.count <= size) continue;
            const float area = half_area(node.low, node.high, area_scale);
            if (area < largest_area || (area == largest_area && node.count <= most)) continue;
            best = k;
            largest_area = area;
            most = node.count;
        }
        return best;
    }

    /// Place of the highest node that does not fit into a leaf, or width.
    [[nodiscard]] MIR_HD std::uint32_t highest() const {
        std::uint32_t best = WideNode::width;
        std::uint32_t most = 0;
        for (std::uint32_t k = 0; k < count_; ++k) {
            const std::uint32_t height = nodes_[children_.at[k]].height;
            if (height <= most) continue;
            best = k;
            most = height;
        }
        return best;
    }

    /// Puts its two children where the node was and behind the last.
    MIR_HD void open(std::uint32_t place) {
        const std::uint32_t opened = children_.at[place];
        const BinaryNode& node = nodes_[opened];
        first_[node.left] = first_[opened];
        first_[node.right] = first_[opened] + nodes_[node.left].count;
        children_.at[place] = node.left;
        children_.at[count_++] = node.right;
    }

 private:
    const BinaryNode* nodes_;
    std::uint32_t* first_;
    WideChildren children_;
    std::uint32_t count_ = 1;
};

/// How nodes are opened.
struct OpeningRule {
    std::uint32_t leaf_size = 0;
    std::uint32_t max_depth = 0;  ///< nodes
    float area_scale = 0.0f;

    /// The children of a wide node below `depth` others.
    [[nodiscard]] MIR_HD WideChildren open(const BinaryNode* nodes, std::uint32_t* first,
                                           std::uint32_t root, std::uint32_t depth) const {
        OpenedNodes opened(nodes, first, root);
        const std::uint32_t height = nodes[root].height;
        const bool by_area = depth + 1 + (height + 1) / 3 <= max_depth;
        while (!opened.is_full()) {
            std::uint32_t next = by_area ? opened.largest(leaf_size, area_scale) : opened.highest();
            // Slots that are left hold parts of leaves: their boxes are tested anyway.
            if (next == WideNode::width) next = opened.largest(1, area_scale);
            if (next == WideNode::width) break;
            opened.open(next);
        }
        return opened.children();
    }
};

}  // namespace mir::detail
