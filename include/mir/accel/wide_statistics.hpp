// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace mir {

/// What a wide bounding volume hierarchy looks like and what it took to build it.
struct WideBvhStatistics {
    /// What visiting a node, which tests eight boxes, is taken to cost, in triangle tests.
    static constexpr double node_cost = 2.0;

    std::uint64_t triangles = 0;
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;
    std::uint32_t depth = 0;         ///< most nodes on the way from the root to a triangle
    std::uint32_t largest_leaf = 0;  ///< triangles
    double expected_nodes = 0.0;     ///< visited by a line through the root's box, by areas
    double expected_tests = 0.0;     ///< of triangles, by such a line
    std::uint64_t bytes = 0;         ///< of nodes, triangle rows and their indices

    double prepare_seconds = 0.0;   ///< accept boxes
    double top_seconds = 0.0;       ///< nodes too large for one thread
    double subtrees_seconds = 0.0;  ///< everything below
    double assemble_seconds = 0.0;  ///< into one array, triangle rows

    /// Expected cost of a line through the root's box, in triangle tests.
    [[nodiscard]] double sah_cost() const { return node_cost * expected_nodes + expected_tests; }

    /// Of all stages.
    [[nodiscard]] double seconds() const {
        return prepare_seconds + top_seconds + subtrees_seconds + assemble_seconds;
    }
    [[nodiscard]] double triangles_per_leaf() const { return ratio(triangles, leaves); }
    /// Mean number of children of a node, at most 8.
    [[nodiscard]] double children_per_node() const {
        return nodes == 0 ? 0.0 : ratio(nodes - 1 + leaves, nodes);
    }
    [[nodiscard]] double bytes_per_triangle() const { return ratio(bytes, triangles); }

 private:
    static double ratio(std::uint64_t a, std::uint64_t b) {
        return b == 0 ? 0.0 : static_cast<double>(a) / static_cast<double>(b);
    }
};

}  // namespace mir
