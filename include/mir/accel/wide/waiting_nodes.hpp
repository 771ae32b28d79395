// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_bvh_view.hpp"

namespace mir {

/// Nodes of a wide hierarchy that a walk has met and not visited. Their boxes stand with them. They
/// are kept as the children of nodes that are made up, so that another walk can meet eight of them
/// at once, by what it does with the children of any node. On the host; without values until
/// pushed.
class WaitingNodes {
 public:
    /// Most nodes that wait: enough for a walk that visits the last one first.
    static constexpr std::uint32_t capacity = WideBvhView<Space::host>::most_waiting;

    /// How many there are.
    [[nodiscard]] std::uint32_t size() const { return size_; }
    /// Number of the node that was pushed last; there must be one.
    [[nodiscard]] std::uint32_t last() const { return group_of(size_ - 1).ref[slot_of(size_ - 1)]; }
    /// Forgets it.
    void pop() { --size_; }

    /// Adds the child of `parent` in a slot, which is a node.
    void push(const WideNode& parent, std::uint32_t slot) {
        add(parent.ref[slot], [&](int axis) {
            return Range{parent.low(axis, slot), parent.high(axis, slot)};
        });
    }
    /// Adds the root of a hierarchy of that reach, metres.
    void push_root(float reach) {
        // More than reach and what boxes lie beyond it: as with any box, what a segment needs lies
        // inside with room to spare.
        const float edge = reach * (1.0f + 0x1p-16f);
        add(WideBvhView<Space::host>::root, [edge](int) { return Range{-edge, edge}; });
    }

    /// Made-up nodes, which hold those that wait in the order in which they came.
    [[nodiscard]] std::uint32_t groups() const {
        return (size_ + WideNode::width - 1) / WideNode::width;
    }
    /// One of them. Only the slots of slots_of() have values.
    [[nodiscard]] const WideNode& group(std::uint32_t g) const { return groups_[g]; }
    /// Its slots that hold a node.
    [[nodiscard]] std::uint32_t slots_of(std::uint32_t g) const {
        const std::uint32_t left = size_ - g * WideNode::width;
        return left >= WideNode::width ? (1u << WideNode::width) - 1u : (1u << left) - 1u;
    }

 private:
    struct Range {
        float low;
        float high;
    };

    template <class Box>
    void add(std::uint32_t node, const Box& box) {
        WideNode& to = groups_[size_ / WideNode::width];
        const std::uint32_t slot = slot_of(size_++);
        for (int axis = 0; axis < 3; ++axis) {
            const Range range = box(axis);
            to.set_bounds(axis, slot, range.low, range.high);
        }
        to.ref[slot] = node;
        to.count[slot] = WideNode::inner;
    }

    [[nodiscard]] const WideNode& group_of(std::uint32_t i) const {
        return groups_[i / WideNode::width];
    }
    [[nodiscard]] static std::uint32_t slot_of(std::uint32_t i) { return i % WideNode::width; }

    std::uint32_t size_ = 0;
    WideNode groups_[(capacity + WideNode::width - 1) / WideNode::width];
};

}  // namespace mir
