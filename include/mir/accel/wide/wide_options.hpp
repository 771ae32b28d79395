// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cstdint>

namespace mir {

/// How a wide bounding volume hierarchy is built. Choices change speed and memory, never what is
/// visible.
struct WideBvhOptions {
    /// Most nodes on the way from the root to a triangle. Traversal has a stack of that size.
    static constexpr std::uint32_t depth_limit = 32;

    /// Most triangles that a leaf may hold, whatever the options say.
    static constexpr std::uint32_t largest_leaf = 8;

    std::uint32_t leaf_size = 4;  ///< most triangles of a leaf; 1 to largest_leaf

    /// Most splits of triangles before the tree is built over their parts, for each triangle; 0 to
    /// 1. Those are split whose boxes are mostly empty. A triangle that is split lies in several
    /// leaves, each time with its rows.
    float splits = 0.0f;

    /// How far a cluster looks for its nearest along Morton's curve, in clusters. 1 to 64. More
    /// makes better trees, more slowly.
    std::uint32_t radius = 8;

    /// What visiting a node is taken to cost, in triangle tests; 0.1 to 100. More makes trees of
    /// fewer nodes. A node is as large as the rows of five triangles; traversal on processors liked
    /// 7 better than 2 by some percent.
    float node_cost = 5.0f;

    /// Most nodes on the way to a triangle, at least those of a balanced tree. 1 to
    /// depth_limit: clusters are joined in their order along the curve where the nearest could
    /// not keep it.
    std::uint32_t max_depth = depth_limit;
};

/// @throws Error(invalid_argument) when an option is out of its range.
inline void check(const WideBvhOptions& options) {
    expects(options.leaf_size >= 1 && options.leaf_size <= WideBvhOptions::largest_leaf,
            "the wide tree's leaf_size must lie between 1 and 8 (a leaf is one slot of a node); "
            "choose one there");
    expects(options.radius >= 1 && options.radius <= 64,
            "the wide tree's radius must lie between 1 and 64 (neighbours that a cluster looks at "
            "on either side); choose one there");
    expects(options.node_cost >= 0.1f && options.node_cost <= 100.0f,
            "the wide tree's node_cost must lie between 0.1 and 100 (triangle tests that take as "
            "long as a node); choose one there");
    expects(options.splits >= 0.0f && options.splits <= 1.0f,
            "the wide tree's splits must lie between 0 and 1 (splits of triangles, for each "
            "triangle); choose a share there");
    expects(options.max_depth >= 1 && options.max_depth <= WideBvhOptions::depth_limit,
            "the wide tree's max_depth must lie between 1 and 32, the stack of its traversal; "
            "choose one there");
}

}  // namespace mir
