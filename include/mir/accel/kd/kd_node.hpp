// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <cstdint>

namespace mir {

/// One node of a kd-tree, 8 bytes. It is a plane between two neighbouring children, or a leaf that
/// lists triangles. A trivially copyable value, the same on host and device.
class alignas(8) KdNode {
 public:
    /// Largest index of a child and largest number of references of a leaf.
    static constexpr std::uint32_t max_count = (1u << 30) - 1;

    /// A leaf without triangles.
    constexpr KdNode() = default;

    /// Plane at `split` metres on `axis` (0..2). The child below is node `below`, the child above
    /// is node `below + 1`.
    MIR_HD static constexpr KdNode inner(std::uint32_t axis, float split, std::uint32_t below) {
        KdNode n;
        n.split_ = split;
        n.word_ = below << 2 | axis;
        return n;
    }

    /// Leaf over references [first, first + count).
    MIR_HD static constexpr KdNode leaf(std::uint32_t first, std::uint32_t count) {
        KdNode n;
        n.first_ = first;
        n.word_ = count << 2 | leaf_tag;
        return n;
    }

    /// What the node is, and so which of the members below mean something.
    [[nodiscard]] MIR_HD constexpr bool is_leaf() const { return (word_ & 3u) == leaf_tag; }
    /// Of an inner node: 0 for x, 1 for y, 2 for z.
    [[nodiscard]] MIR_HD constexpr std::uint32_t axis() const { return word_ & 3u; }
    /// Of an inner node: where the plane lies on its axis, metres.
    [[nodiscard]] MIR_HD constexpr float split() const { return split_; }
    /// Of an inner node: index of the child below; the one above follows it.
    [[nodiscard]] MIR_HD constexpr std::uint32_t below() const { return word_ >> 2; }
    /// Of a leaf: place of its first reference.
    [[nodiscard]] MIR_HD constexpr std::uint32_t first() const { return first_; }
    /// Of a leaf: number of its references, 0 for an empty one.
    [[nodiscard]] MIR_HD constexpr std::uint32_t count() const { return word_ >> 2; }

 private:
    static constexpr std::uint32_t leaf_tag = 3;

    union {
        float split_;
        std::uint32_t first_ = 0;
    };
    std::uint32_t word_ = leaf_tag;
};

static_assert(sizeof(KdNode) == 8);

/// Both children of an inner node as they lie in memory. One fetch of 16 bytes can begin before it
/// is known which child comes next.
struct alignas(16) KdChildren {
    KdNode below;  ///< the child on the side of smaller coordinates
    KdNode above;  ///< the other
};

}  // namespace mir
