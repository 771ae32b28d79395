// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/math.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mir {

/// A balanced kd-tree over points that tells how far the nearest of them are. Points are halved at
/// the median of the widest axis of their box; the median of points [first, last) of the order is
/// the node, so there are no other nodes. Const use from any thread.
/// Source: Bentley, "Multidimensional binary search trees used for associative searching", CACM
/// 18(9), 1975.
class PointTree {
 public:
    /// Copies the points.
    explicit PointTree(std::span<const Vec3> points) {
        nodes_.reserve(points.size());
        for (const Vec3& p : points) nodes_.push_back({p, 0});
        build(0, nodes_.size());
    }

    /// Square of the distance to the k-th nearest point, from 1. A point at `from` itself counts.
    /// @throws Error(invalid_argument) unless there are k points.
    [[nodiscard]] float kth_distance_squared(Vec3 from, std::uint32_t k) const {
        expects(k >= 1 && k <= nodes_.size(),
                "more nearest points were asked for than there are; ask for fewer");
        std::vector<float> heap(k, std::numeric_limits<float>::infinity());
        search(0, nodes_.size(), from, heap);
        return heap.front();
    }

 private:
    struct Node {
        Vec3 place;
        int axis;
    };

    void build(std::size_t first, std::size_t last) {
        if (last - first < 2) return;
        Vec3 low = nodes_[first].place;
        Vec3 high = low;
        for (std::size_t i = first; i < last; ++i) {
            low = glm::min(low, nodes_[i].place);
            high = glm::max(high, nodes_[i].place);
        }
        const Vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = first + (last - first) / 2;
        const auto at = [this](std::size_t i) {
            return nodes_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        std::nth_element(at(first), at(middle), at(last), [axis](const Node& a, const Node& b) {
            return a.place[axis] < b.place[axis];
        });
        nodes_[middle].axis = axis;
        build(first, middle);
        build(middle + 1, last);
    }

    /// `heap` holds the smallest squared distances so far, the largest of them first.
    void search(std::size_t first, std::size_t last, Vec3 from, std::vector<float>& heap) const {
        if (first == last) return;
        const std::size_t middle = first + (last - first) / 2;
        const Node& node = nodes_[middle];
        const float squared = length_squared(node.place - from);
        if (squared < heap.front()) {
            std::pop_heap(heap.begin(), heap.end());
            heap.back() = squared;
            std::push_heap(heap.begin(), heap.end());
        }
        const float beyond = from[node.axis] - node.place[node.axis];
        const bool low_first = beyond < 0.0f;
        if (low_first)
            search(first, middle, from, heap);
        else
            search(middle + 1, last, from, heap);
        if (beyond * beyond > heap.front()) return;
        if (low_first)
            search(middle + 1, last, from, heap);
        else
            search(first, middle, from, heap);
    }

    std::vector<Node> nodes_;
};

}  // namespace mir
