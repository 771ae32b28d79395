// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/detail/slot_costs.hpp"

namespace mir::detail {

// Why trees keep their depth. Let H(h) = ceil(h / 3) be the nodes that a binary tree of height h
// needs if every wide node takes three levels of it. Claim: a wide node below d others, made of a
// binary node of height h, keeps d + H(h) <= D, the largest depth allowed. It does at the root
// (cluster_plan.hpp). Children are less high than h, so they are chosen by cost if
// d + 1 + H(h - 1) <= D. Otherwise the highest one is opened seven times: once, then the two at
// most that have h - 1, then the four at most that have h - 2, which leaves h - 3, and
// d + 1 + H(h - 3) = d + H(h). What fits into a leaf has height 0 and becomes one.

/// A binary tree, with the costs of its nodes.
struct CostedTree {
    const BinaryNode* nodes = nullptr;
    const SlotCosts* costs = nullptr;
};

/// Nodes of the binary tree that become the children of a wide node.
struct WideChildren {
    std::uint32_t at[WideNode::width];
    std::uint32_t count;

    MIR_HD void add(std::uint32_t node) { at[count++] = node; }
};

/// Chooses the children of wide nodes.
struct ChildChoice {
    CostedTree tree;
    std::uint32_t leaf_size = 0;
    std::uint32_t max_depth = 0;  ///< nodes
    float area_scale = 0.0f;

    /// The children of a wide node below `depth` others, the largest first. What hides a whole
    /// block of luxels is large, and shafts look at the first slot first.
    MIR_HD void choose(std::uint32_t root, std::uint32_t depth, WideChildren& children) const {
        children.count = 0;
        if (depth + 1 + (tree.nodes[root].height + 1) / 3 <= max_depth)
            choose_cheapest(root, children);
        else
            open_highest(root, children);
        sort_by_area(children);
    }

 private:
    /// A node and the slots that it may take.
    struct Waiting {
        std::uint32_t node;
        std::uint32_t slots;
    };

    /// From left to right. Every one that waits has a slot at least, so there are never more than
    /// eight.
    MIR_HD void choose_cheapest(std::uint32_t root, WideChildren& children) const {
        Waiting waiting[WideNode::width];
        std::uint32_t count = 0;
        waiting[count++] = {root, tree.nodes[root].count == 1 ? 1 : WideNode::width};
        while (count > 0) {
            const Waiting next = waiting[--count];
            if (next.slots == 1) {
                children.add(next.node);
                continue;
            }
            const SlotCosts& left = tree.costs[tree.nodes[next.node].left];
            const SlotCosts& right = tree.costs[tree.nodes[next.node].right];
            const std::uint32_t to_left = share_slots(left, right, next.slots).left;
            waiting[count++] = {tree.nodes[next.node].right, right.needed(next.slots - to_left)};
            waiting[count++] = {tree.nodes[next.node].left, left.needed(to_left)};
        }
    }

    MIR_HD void open_highest(std::uint32_t root, WideChildren& children) const {
        children.add(root);
        while (children.count < WideNode::width) {
            const std::uint32_t place = highest(children);
            const std::uint32_t opened = children.at[place];
            if (tree.nodes[opened].count == 1) break;
            children.at[place] = tree.nodes[opened].left;
            children.add(tree.nodes[opened].right);
        }
    }

    /// Place of the highest node. Among those that fit into a leaf, of the largest surface.
    [[nodiscard]] MIR_HD std::uint32_t highest(const WideChildren& children) const {
        std::uint32_t best = 0;
        for (std::uint32_t k = 1; k < children.count; ++k)
            if (comes_before(tree.nodes[children.at[k]], tree.nodes[children.at[best]])) best = k;
        return best;
    }
    [[nodiscard]] MIR_HD bool comes_before(const BinaryNode& a, const BinaryNode& b) const {
        if (a.height != b.height) return a.height > b.height;
        if ((a.count == 1) != (b.count == 1)) return b.count == 1;
        return half_area(a.low, a.high, area_scale) > half_area(b.low, b.high, area_scale);
    }

    MIR_HD void sort_by_area(WideChildren& children) const {
        for (std::uint32_t i = 1; i < children.count; ++i) {
            const std::uint32_t child = children.at[i];
            std::uint32_t k = i;
            for (; k > 0 && area(child) > area(children.at[k - 1]); --k)
                children.at[k] = children.at[k - 1];
            children.at[k] = child;
        }
    }
    [[nodiscard]] MIR_HD float area(std::uint32_t node) const {
        return half_area(tree.nodes[node].low, tree.nodes[node].high, area_scale);
    }
};

}  // namespace mir::detail
