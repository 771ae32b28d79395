// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/bounds.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace mir::detail {

/// True when two boxes have a point in common.
[[nodiscard]] inline bool touch(const Bounds& a, const Bounds& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return false;
    return true;
}

/// A tree over boxes that finds those which touch a box. Boxes are halved at the median of their
/// centres along the widest axis. Const use from any thread.
class BoxTree {
 public:
    /// Element i is box i; none may be empty.
    explicit BoxTree(const std::vector<Bounds>& boxes) {
        leaves_.reserve(boxes.size());
        for (const Bounds& box : boxes)
            leaves_.push_back({box, static_cast<std::uint32_t>(leaves_.size())});
        if (!leaves_.empty()) build(0, static_cast<std::uint32_t>(leaves_.size()));
    }

    /// Calls visit(i) for every box i that touches `box`. The order is the tree's own.
    template <class Visit>
    void each_touching(const Bounds& box, const Visit& visit) const {
        if (!nodes_.empty()) search(0, box, visit);
    }

 private:
    static constexpr std::uint32_t leaf_size = 4;

    struct Leaf {
        Bounds box;
        std::uint32_t index;
    };

    /// Leaves [first, last); the first child follows its node.
    struct Node {
        Bounds box;
        std::uint32_t first = 0;
        std::uint32_t last = 0;
        std::uint32_t second_child = 0;  ///< 0 in leaves
    };

    std::uint32_t build(std::uint32_t first, std::uint32_t last) {
        const auto at = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({{}, first, last});
        for (std::uint32_t i = first; i < last; ++i) {
            nodes_[at].box.add(leaves_[i].box.low);
            nodes_[at].box.add(leaves_[i].box.high);
        }
        if (last - first <= leaf_size) return at;
        const Vec3 size = nodes_[at].box.high - nodes_[at].box.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t middle = first + (last - first) / 2;
        const auto begin = leaves_.begin();
        std::nth_element(begin + first, begin + middle, begin + last,
                         [axis](const Leaf& a, const Leaf& b) {
                             const float place = a.box.centre()[axis];
                             const float other = b.box.centre()[axis];
                             return place != other ? place < other : a.index < b.index;
                         });
        build(first, middle);
        const std::uint32_t second = build(middle, last);
        nodes_[at].second_child = second;
        return at;
    }

    template <class Visit>
    void search(std::uint32_t at, const Bounds& box, const Visit& visit) const {
        const Node& node = nodes_[at];
        if (!touch(node.box, box)) return;
        if (node.second_child != 0) {
            search(at + 1, box, visit);
            search(node.second_child, box, visit);
            return;
        }
        for (std::uint32_t i = node.first; i < node.last; ++i)
            if (touch(leaves_[i].box, box)) visit(leaves_[i].index);
    }

    std::vector<Leaf> leaves_;
    std::vector<Node> nodes_;
};

}  // namespace mir::detail
