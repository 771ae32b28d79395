// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_node.hpp"
#include "mir/host/wide_build.hpp"
#include "support/wide_statistics.hpp"

#include <vector>

namespace mirtest {

inline mir::WideBvh build_wide(const mir::WorldGeometry& geometry,
                               const mir::WideBvhOptions& options = {}) {
    mir::InlineExecutor executor;
    return mir::build_wide_bvh(geometry, executor, options);
}

/// A child of a node, as found by walking the whole tree.
struct WideChild {
    mir::Bounds box;
    std::uint32_t ref = 0;
    std::int32_t count = 0;
    std::uint32_t depth = 0;  ///< nodes on the way to it
    std::uint32_t node = 0;   ///< whose child it is
};

inline WideChild child_of(const mir::WideNode& node, std::uint32_t slot) {
    WideChild child;
    for (int axis = 0; axis < 3; ++axis) {
        child.box.low[axis] = node.low(axis, slot);
        child.box.high[axis] = node.high(axis, slot);
    }
    child.ref = node.ref[slot];
    child.count = node.count[slot];
    return child;
}

/// Calls visit(child) for every slot of every node. Stops with an exception at a node that is
/// reached twice. `bvh` is a WideBvh or what has its members.
template <class Tree, class Visit>
void walk_wide(const Tree& bvh, Visit visit) {
    struct Waiting {
        std::uint32_t node = 0;
        std::uint32_t depth = 1;
    };
    std::vector<Waiting> stack{{}};
    std::vector<bool> seen(bvh.nodes().size());
    while (!stack.empty()) {
        const Waiting w = stack.back();
        stack.pop_back();
        if (seen.at(w.node)) throw std::logic_error("a node has two parents");
        seen[w.node] = true;
        for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
            WideChild child = child_of(bvh.nodes()[w.node], slot);
            child.depth = w.depth;
            child.node = w.node;
            visit(child);
            if (child.count == mir::WideNode::inner) stack.push_back({child.ref, w.depth + 1});
        }
    }
}

/// Planes of all boxes, in the form in which HardSegments aims at them.
template <class Tree>
std::vector<mir::KdNode> box_planes(const Tree& bvh) {
    std::vector<mir::KdNode> planes;
    walk_wide(bvh, [&](const WideChild& child) {
        if (child.count == mir::WideNode::empty) return;
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            for (const mir::Vec3 side : {child.box.low, child.box.high})
                planes.push_back(mir::KdNode::inner(axis, side[static_cast<int>(axis)], 0));
    });
    return planes;
}

}  // namespace mirtest
