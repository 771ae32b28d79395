// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/detail/cluster.hpp"
#include "mir/accel/wide/wide_children.hpp"

namespace mir::detail {

/// The wide nodes of one depth: they follow each other.
struct WideLevel {
    std::uint32_t begin = 0;
    std::uint32_t size = 1;
    std::uint32_t depth = 0;  ///< nodes above

    [[nodiscard]] MIR_HD std::uint32_t end() const { return begin + size; }
};

/// What is noted of wide nodes before they are written, by node.
struct WideNotes {
    std::uint32_t* roots = nullptr;  ///< nodes of the binary tree they are made of
    WideChildren* children = nullptr;
    std::uint32_t* first_child = nullptr;  ///< the first wide node among their children
    /// Place of the first triangle below. Those in leaves of the node itself come first, side by
    /// side, for they are read together.
    std::uint32_t* first_triangle = nullptr;
};

/// Kernel over one index: the first wide node is made of all.
struct StartAtRoot {
    const Cluster* all = nullptr;
    const BinaryNode* nodes = nullptr;
    WideNotes notes;
    std::uint32_t* count = nullptr;  ///< one word: of triangles in leaves

    MIR_HD void operator()(std::uint32_t /*i*/) const {
        notes.roots[0] = all->node;
        notes.first_triangle[0] = 0;
        *count = nodes[all->node].count;
    }
};

/// Kernel over the nodes of a level: chooses children and counts inner ones. One index more makes
/// sums of what it writes include all.
struct ChooseChildren {
    ChildChoice choice;
    WideNotes notes;
    std::uint32_t* inner = nullptr;
    WideLevel level;

    MIR_HD void operator()(std::uint32_t i) const {
        inner[i] = 0;
        if (i == level.size) return;
        const std::uint32_t at = level.begin + i;
        WideChildren& children = notes.children[at];
        choice.choose(notes.roots[at], level.depth, children);
        for (std::uint32_t k = 0; k < children.count; ++k)
            if (choice.tree.nodes[children.at[k]].count > choice.leaf_size) ++inner[i];
    }
};

/// Kernel over the nodes of a level and one index more. Numbers the nodes of the next, and their
/// triangles.
struct NumberChildren {
    const BinaryNode* nodes = nullptr;
    const std::uint32_t* inner_before = nullptr;
    WideNotes notes;
    std::uint32_t* next_size = nullptr;  ///< one word
    WideLevel level;
    std::uint32_t leaf_size = 0;

    MIR_HD void operator()(std::uint32_t i) const {
        if (i == level.size) {
            *next_size = inner_before[i];
            return;
        }
        const std::uint32_t at = level.begin + i;
        const WideChildren& children = notes.children[at];
        std::uint32_t next = level.end() + inner_before[i];
        std::uint32_t place = notes.first_triangle[at] + triangles_in_leaves(children);
        notes.first_child[at] = next;
        for (std::uint32_t k = 0; k < children.count; ++k) {
            const std::uint32_t count = nodes[children.at[k]].count;
            if (count <= leaf_size) continue;
            notes.roots[next] = children.at[k];
            notes.first_triangle[next++] = place;
            place += count;
        }
    }

 private:
    [[nodiscard]] MIR_HD std::uint32_t triangles_in_leaves(const WideChildren& children) const {
        std::uint32_t sum = 0;
        for (std::uint32_t k = 0; k < children.count; ++k) {
            const std::uint32_t count = nodes[children.at[k]].count;
            if (count <= leaf_size) sum += count;
        }
        return sum;
    }
};

}  // namespace mir::detail
