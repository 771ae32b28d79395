// SPDX-License-Identifier: MIT
#pragma once

#include "accel/build_worlds.hpp"
#include "accel/wide_nodes.hpp"
#include "support/catch.hpp"

namespace mirtest {

inline bool holds(const mir::Bounds& outer, const mir::Bounds& inner) {
    return glm::all(glm::lessThanEqual(outer.low, inner.low)) &&
           glm::all(glm::lessThanEqual(inner.high, outer.high));
}

/// Box around the boxes of all children of a node.
inline mir::Bounds box_of(const mir::WideNode& node) {
    mir::Bounds box;
    for (std::uint32_t slot = 0; slot < mir::WideNode::width; ++slot) {
        if (node.count[slot] == mir::WideNode::empty) continue;
        box.add(child_of(node, slot).box.low);
        box.add(child_of(node, slot).box.high);
    }
    return box;
}

template <class Tree>
bool holds_accept_boxes(const mir::WorldGeometry& geometry, const Tree& bvh,
                        const WideChild& leaf) {
    const float magnitude = mir::magnitude_of(geometry.bounds());
    for (std::uint32_t i = leaf.ref; i < leaf.ref + static_cast<std::uint32_t>(leaf.count); ++i) {
        const std::uint32_t t = bvh.indices()[i];
        if (!holds(leaf.box, mir::accept_box(geometry.corner(t, 0), geometry.corner(t, 1),
                                             geometry.corner(t, 2), magnitude)))
            return false;
    }
    return true;
}

/// Every triangle lies in one leaf, all boxes hold what is below them, and rows are those of the
/// triangles named beside them.
template <class Tree>
void check_whole(const mir::WorldGeometry& geometry, const Tree& bvh) {
    const std::size_t n = geometry.triangles().size();
    std::vector<int> listed(n);
    std::size_t small_boxes = 0;
    std::size_t visited = 1;
    walk_wide(bvh, [&](const WideChild& child) {
        if (child.count == mir::WideNode::inner) {
            ++visited;
            if (!holds(child.box, box_of(bvh.nodes()[child.ref]))) ++small_boxes;
        } else if (child.count > 0) {
            if (!holds_accept_boxes(geometry, bvh, child)) ++small_boxes;
            for (std::int32_t i = 0; i < child.count; ++i)
                ++listed.at(bvh.indices()[child.ref + static_cast<std::uint32_t>(i)]);
        }
    });
    CHECK(visited == bvh.nodes().size());
    CHECK(small_boxes == 0);
    CHECK(std::count(listed.begin(), listed.end(), 1) == static_cast<std::ptrdiff_t>(n));
    REQUIRE(bvh.triangles().size() == n);
    std::size_t wrong_rows = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t t = bvh.indices()[i];
        const mir::TriangleRows rows = mir::make_triangle_rows(
            geometry.corner(t, 0), geometry.corner(t, 1), geometry.corner(t, 2));
        wrong_rows += equal_bytes<mir::TriangleRows>({&rows, 1}, {&bvh.triangles()[i], 1}) ? 0 : 1;
    }
    CHECK(wrong_rows == 0);
}

/// What walking the tree counts.
struct WideCount {
    std::uint64_t leaves = 0;
    std::uint32_t depth = 1;
    std::uint32_t largest_leaf = 0;
    double nodes_area = 1.0;
    double tests_area = 0.0;
};

inline double half_area(const mir::Bounds& box) {
    const auto e = mir::detail::Double3(box.high) - mir::detail::Double3(box.low);
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

template <class Tree>
WideCount count_wide(const Tree& bvh) {
    WideCount c;
    const double root = half_area(box_of(bvh.nodes()[0]));
    walk_wide(bvh, [&](const WideChild& child) {
        c.depth = std::max(c.depth, child.depth);
        if (child.count == mir::WideNode::inner) c.nodes_area += half_area(child.box) / root;
        if (child.count <= 0) return;
        ++c.leaves;
        c.largest_leaf = std::max(c.largest_leaf, static_cast<std::uint32_t>(child.count));
        c.tests_area += child.count * half_area(child.box) / root;
    });
    return c;
}

}  // namespace mirtest
