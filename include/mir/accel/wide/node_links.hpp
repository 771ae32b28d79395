// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_node.hpp"
#include "mir/core/lane_group.hpp"

namespace mir {

/// Triangles of some leaves of one node, in the order of the hierarchy.
struct LeafTriangles {
    std::uint32_t first[2];  ///< place of bit 0 of either word
    std::uint32_t bits[2];   ///< bit k of a word: the triangle at first + k

    /// How many there are.
    [[nodiscard]] MIR_HD std::uint32_t count() const {
        return LaneGroup::count(bits[0]) + LaneGroup::count(bits[1]);
    }
    /// True when there is none.
    [[nodiscard]] MIR_HD bool empty() const { return (bits[0] | bits[1]) == 0; }

    /// Takes the next one, which must exist; returns its place.
    MIR_HD std::uint32_t pop() {
        const bool is_first_half = bits[0] != 0;
        const std::uint32_t from = is_first_half ? bits[0] : bits[1];
        const std::uint32_t left = from & (from - 1);
        (is_first_half ? bits[0] : bits[1]) = left;
        return (is_first_half ? first[0] : first[1]) + LaneGroup::lowest(from);
    }

    /// Calls f(place) for each.
    template <class F>
    MIR_HD void for_each(const F& f) const {
        for (std::uint32_t left = bits[0]; left != 0; left &= left - 1)
            f(first[0] + LaneGroup::lowest(left));
        for (std::uint32_t left = bits[1]; left != 0; left &= left - 1)
            f(first[1] + LaneGroup::lowest(left));
    }
};

/// Where the children of a WideNode are, in 16 bytes. Those that are nodes have consecutive numbers
/// in the order of their slots, and so have the triangles of its leaves their places, as
/// WideBvhView promises.
struct alignas(16) NodeLinks {
    std::uint32_t first_node;      ///< number of the first child that is a node
    std::uint32_t first_triangle;  ///< place of the first triangle of the leaves
    /// Byte j of word h. Triangles in the leaves of slots 4 h to 4 h + j. A leaf holds at most 8.
    std::uint32_t ends[2];

    /// Number of the child in slot `k`, which is a node. Bit k of `inner` says so of each slot.
    [[nodiscard]] MIR_HD static std::uint32_t node(std::uint32_t first_node, std::uint32_t inner,
                                                   std::uint32_t k) {
        return first_node + LaneGroup::count_before(inner, k);
    }

    /// Triangles of the leaves among `slots`, a bit for each; empty slots have none.
    [[nodiscard]] MIR_HD LeafTriangles leaves(std::uint32_t slots) const {
        const std::uint32_t in_first_half = ends[0] >> 24;
        return {{first_triangle, first_triangle + in_first_half},
                {half(ends[0], slots & 15u), half(ends[1], slots >> 4)}};
    }

 private:
    [[nodiscard]] MIR_HD static std::uint32_t half(std::uint32_t ends, std::uint32_t slots) {
        std::uint32_t bits = 0;
        std::uint32_t begin = 0;
        for (std::uint32_t k = 0; k < WideNode::width / 2; ++k) {
            const std::uint32_t end = ends >> 8 * k & 0xFFu;
            if ((slots >> k & 1u) != 0) bits |= LaneGroup::bits(begin, end - begin);
            begin = end;
        }
        return bits;
    }
};

/// Links of a node of a hierarchy.
[[nodiscard]] MIR_HD inline NodeLinks links_of(const WideNode& node) {
    NodeLinks links{0, 0, {0, 0}};
    std::uint32_t count = 0;
    bool has_nodes = false;
    bool has_leaves = false;
    for (std::uint32_t k = 0; k < WideNode::width; ++k) {
        if (node.is_inner(k) && !has_nodes) links.first_node = node.ref[k];
        if (node.is_leaf(k) && !has_leaves) links.first_triangle = node.ref[k];
        has_nodes = has_nodes || node.is_inner(k);
        has_leaves = has_leaves || node.is_leaf(k);
        if (k == 4) count = 0;
        if (node.is_leaf(k)) count += static_cast<std::uint32_t>(node.count[k]);
        links.ends[k / 4] |= count << 8 * (k % 4);
    }
    return links;
}

}  // namespace mir
