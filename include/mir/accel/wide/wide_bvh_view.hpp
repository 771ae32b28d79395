// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/accel/wide/wide_node.hpp"
#include "mir/accel/wide/wide_options.hpp"
#include "mir/core/space.hpp"

namespace mir {

/// What traversal reads of a wide bounding volume hierarchy. Every box holds the accept boxes
/// (accept_box.hpp) of all triangles below it. There is always a root, even without triangles. The
/// children of a node that are nodes have consecutive numbers in the order of their slots, and so
/// have the triangles of its own leaves their places. A leaf holds at most
/// WideBvhOptions::largest_leaf triangles, and no way from the root to one has more than max_depth
/// nodes.
template <Space S>
struct WideBvhView {
    static constexpr Space space = S;  ///< of the memory that it points to

    /// Largest number of nodes on the way to a triangle. Traversal keeps a stack of this size.
    static constexpr std::uint32_t max_depth = WideBvhOptions::depth_limit;

    /// Most nodes that wait while a walk goes down first. One child per level is on the way.
    static constexpr std::uint32_t most_waiting = (WideNode::width - 1) * max_depth + 1;

    /// Index of the first node.
    static constexpr std::uint32_t root = 0;

    const WideNode* nodes = nullptr;          ///< aligned to 64 bytes
    const TriangleRows* triangles = nullptr;  ///< leaf by leaf
    const std::uint32_t* indices = nullptr;   ///< of the same triangles in WorldGeometry
    float reach = 0.0f;  ///< metres: reach_of(magnitude_of(bounds of the scene)), accept_box.hpp
};

}  // namespace mir
