// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_node.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace mir {

/// What a wide bounding volume hierarchy looks like.
struct WideBvhStatistics {
    /// What visiting a node, which tests eight boxes, is taken to cost, in triangle tests.
    static constexpr double node_cost = 2.0;

    std::uint64_t triangles = 0;     ///< in leaves; one that was split counts in each
    std::uint64_t nodes = 0;         ///< the root included
    std::uint64_t leaves = 0;        ///< slots of nodes that hold triangles
    std::uint32_t depth = 0;         ///< most nodes on the way from the root to a triangle
    std::uint32_t largest_leaf = 0;  ///< triangles
    double expected_nodes = 0.0;     ///< visited by a line through the root's box, by areas
    double expected_tests = 0.0;     ///< of triangles, by such a line

    /// Expected cost of a line through the root's box, in triangle tests.
    [[nodiscard]] double sah_cost() const { return node_cost * expected_nodes + expected_tests; }
    /// Mean number of triangles of a leaf; 0 when there is none.
    [[nodiscard]] double triangles_per_leaf() const { return ratio(triangles, leaves); }
    /// Mean number of children of a node, at most 8.
    [[nodiscard]] double children_per_node() const {
        return nodes == 0 ? 0.0 : ratio(nodes - 1 + leaves, nodes);
    }

 private:
    static double ratio(std::uint64_t a, std::uint64_t b) {
        return b == 0 ? 0.0 : static_cast<double>(a) / static_cast<double>(b);
    }
};

namespace detail {

/// Half the surface of a box, m^2.
inline double half_area(const double (&low)[3], const double (&high)[3]) {
    const double x = high[0] - low[0];
    const double y = high[1] - low[1];
    const double z = high[2] - low[2];
    return x * y + y * z + z * x;
}

/// The same around a child of a node.
inline double half_area(const WideNode& node, std::uint32_t slot) {
    return half_area({node.low(0, slot), node.low(1, slot), node.low(2, slot)},
                     {node.high(0, slot), node.high(1, slot), node.high(2, slot)});
}

/// The same around all children; 0 if there are none.
inline double half_area(const WideNode& node) {
    double low[3] = {};
    double high[3] = {};
    bool found = false;
    for (std::uint32_t slot = 0; slot < WideNode::width; ++slot) {
        if (node.count[slot] == WideNode::empty) continue;
        for (int axis = 0; axis < 3; ++axis) {
            const double l = node.low(axis, slot);
            const double h = node.high(axis, slot);
            low[axis] = found ? std::min(low[axis], l) : l;
            high[axis] = found ? std::max(high[axis], h) : h;
        }
        found = true;
    }
    return half_area(low, high);
}

}  // namespace detail

/// Counts what a tree consists of. `nodes` are in an order in which each follows the one whose
/// child it is, as build_wide_bvh() and BackendWideBvh write them.
inline WideBvhStatistics wide_statistics(std::span<const WideNode> nodes) {
    const double root = detail::half_area(nodes[0]);
    WideBvhStatistics s;
    s.nodes = nodes.size();
    s.expected_nodes = root > 0.0 ? 1.0 : 0.0;
    std::vector<std::uint32_t> depth(nodes.size(), 1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const WideNode& node = nodes[i];
        s.depth = std::max(s.depth, depth[i]);
        for (std::uint32_t slot = 0; slot < WideNode::width; ++slot) {
            const double share = root > 0.0 ? detail::half_area(node, slot) / root : 0.0;
            if (node.is_inner(slot)) {
                depth[node.ref[slot]] = depth[i] + 1;
                s.expected_nodes += share;
            }
            if (!node.is_leaf(slot)) continue;
            const auto count = static_cast<std::uint32_t>(node.count[slot]);
            ++s.leaves;
            s.triangles += count;
            s.largest_leaf = std::max(s.largest_leaf, count);
            s.expected_tests += count * share;
        }
    }
    return s;
}

}  // namespace mir
