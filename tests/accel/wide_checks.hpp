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

/// All inner boxes hold those below them, every place belongs to one leaf, and rows are those of
/// the triangles named beside them.
template <class Tree>
void check_nodes(const mir::WorldGeometry& geometry, const Tree& bvh) {
    std::size_t small_boxes = 0;
    std::size_t visited = 1;
    std::vector<int> listed(bvh.indices().size());
    walk_wide(bvh, [&](const WideChild& child) {
        if (child.count == mir::WideNode::inner) {
            ++visited;
            if (!holds(child.box, box_of(bvh.nodes()[child.ref]))) ++small_boxes;
        }
        for (std::int32_t i = 0; i < child.count; ++i)
            ++listed.at(child.ref + static_cast<std::uint32_t>(i));
    });
    CHECK(visited == bvh.nodes().size());
    CHECK(small_boxes == 0);
    CHECK(std::count(listed.begin(), listed.end(), 1) ==
          static_cast<std::ptrdiff_t>(listed.size()));
    REQUIRE(bvh.triangles().size() == bvh.indices().size());
    std::size_t wrong_rows = 0;
    for (std::size_t i = 0; i < bvh.indices().size(); ++i) {
        const std::uint32_t t = bvh.indices()[i];
        const mir::TriangleRows rows = mir::make_triangle_rows(
            geometry.corner(t, 0), geometry.corner(t, 1), geometry.corner(t, 2));
        wrong_rows += equal_bytes<mir::TriangleRows>({&rows, 1}, {&bvh.triangles()[i], 1}) ? 0 : 1;
    }
    CHECK(wrong_rows == 0);
}

/// Every triangle lies in one leaf, whose box holds its accept box; else as check_nodes().
template <class Tree>
void check_whole(const mir::WorldGeometry& geometry, const Tree& bvh) {
    check_nodes(geometry, bvh);
    std::size_t small_boxes = 0;
    walk_wide(bvh, [&](const WideChild& child) {
        if (child.count > 0 && !holds_accept_boxes(geometry, bvh, child)) ++small_boxes;
    });
    CHECK(small_boxes == 0);
    std::vector<std::uint32_t> listed(bvh.indices().begin(), bvh.indices().end());
    std::sort(listed.begin(), listed.end());
    REQUIRE(listed.size() == geometry.triangles().size());
    for (std::uint32_t t = 0; t < listed.size(); ++t) REQUIRE(listed[t] == t);
}

/// Leaves of a tree, by triangle.
template <class Tree>
std::vector<std::vector<mir::Bounds>> leaves_of_triangles(const mir::WorldGeometry& geometry,
                                                          const Tree& bvh) {
    std::vector<std::vector<mir::Bounds>> leaves(geometry.triangles().size());
    walk_wide(bvh, [&](const WideChild& child) {
        for (std::int32_t i = 0; i < child.count; ++i)
            leaves[bvh.indices()[child.ref + static_cast<std::uint32_t>(i)]].push_back(child.box);
    });
    return leaves;
}

/// Points of accept triangles around which no leaf of the triangle holds everything as near as the
/// lemma of accept_box.hpp and traversal ask: 31 of the 32 parts of sigma_of().
template <class Tree>
std::size_t uncovered_points(const mir::WorldGeometry& geometry, const Tree& bvh) {
    const float magnitude = mir::magnitude_of(geometry.bounds());
    const mir::detail::Double3 near(31.0 / 32.0 * mir::sigma_of(magnitude));
    const double reach = mir::reach_of(magnitude);
    const auto leaves = leaves_of_triangles(geometry, bvh);
    mir::Random random = test_random(22);
    std::size_t uncovered = 0;
    for (std::uint32_t t = 0; t < leaves.size(); ++t) {
        const mir::detail::AcceptTriangle accept = mir::detail::accept_triangle(
            geometry.corner(t, 0), geometry.corner(t, 1), geometry.corner(t, 2), magnitude);
        for (int i = 0; i < 12; ++i) {
            const mir::Vec2 at = mir::square_to_triangle(random.next_2d());
            const auto u = static_cast<double>(at.x);
            const auto v = i % 2 == 0 ? 0.0 : static_cast<double>(at.y);
            const mir::detail::Double3 p =
                accept.a + u * (accept.b - accept.a) + v * (accept.c - accept.a);
            if (glm::any(glm::greaterThan(glm::abs(p), mir::detail::Double3(reach)))) continue;
            uncovered += std::any_of(leaves[t].begin(), leaves[t].end(),
                                     [&](const mir::Bounds& box) {
                                         return glm::all(glm::lessThanEqual(
                                                    mir::detail::Double3(box.low), p - near)) &&
                                                glm::all(glm::lessThanEqual(
                                                    p + near, mir::detail::Double3(box.high)));
                                     })
                             ? 0
                             : 1;
        }
    }
    return uncovered;
}

/// The leaves of every triangle hold all of its accept region; else as check_nodes(). No more
/// references than `most`.
template <class Tree>
void check_split(const mir::WorldGeometry& geometry, const Tree& bvh, double splits) {
    check_nodes(geometry, bvh);
    const auto n = static_cast<double>(geometry.triangles().size());
    CHECK(static_cast<double>(bvh.indices().size()) <= (1.0 + splits) * n);
    CHECK(uncovered_points(geometry, bvh) == 0);
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
