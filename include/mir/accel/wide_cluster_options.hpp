// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide_options.hpp"

namespace mir {

/// How a wide bounding volume hierarchy is built from its leaves up. Choices change speed and
/// memory, never what is visible.
struct WideClusterOptions {
    std::uint32_t leaf_size = 4;  ///< most triangles of a leaf; 1 to 8

    /// How far along Morton's curve a cluster looks for its nearest, in clusters; 1 to 64. More
    /// makes better trees, more slowly.
    std::uint32_t radius = 8;

    /// What visiting a node is taken to cost, in triangle tests; 0.1 to 100. More makes trees of
    /// fewer nodes. A node is as large as the rows of five triangles; traversal on processors liked
    /// 7 better than 2 by some percent.
    float node_cost = 5.0f;

    /// Most nodes on the way from the root to a triangle, raised to what a balanced tree needs.
    /// 1 to WideBvhOptions::depth_limit: clusters are joined in their order along the curve where
    /// the nearest could not keep it.
    std::uint32_t max_depth = WideBvhOptions::depth_limit;
};

/// @throws Error(invalid_argument) when an option is out of its range.
inline void check(const WideClusterOptions& options) {
    check(WideBvhOptions{.leaf_size = options.leaf_size, .max_depth = options.max_depth});
    expects(options.radius >= 1 && options.radius <= 64,
            "the wide tree's radius must lie between 1 and 64 (neighbours that a cluster looks at "
            "on either side); choose one there");
    expects(options.node_cost >= 0.1f && options.node_cost <= 100.0f,
            "the wide tree's node_cost must lie between 0.1 and 100 (triangle tests that take as "
            "long as a node); choose one there");
}

}  // namespace mir
