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
}

}  // namespace mir
