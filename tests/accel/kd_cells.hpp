// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_build.hpp"

#include <algorithm>
#include <vector>

namespace mirtest {

/// A node as found by walking the whole tree.
struct LeafCell {
    mir::KdNode leaf;
    mir::Vec3 low{0};
    mir::Vec3 high{0};
    std::uint32_t depth = 0;

    [[nodiscard]] mir::detail::Double3 extent() const {
        return mir::detail::Double3(high) - mir::detail::Double3(low);
    }
    [[nodiscard]] double volume() const { return extent().x * extent().y * extent().z; }
    [[nodiscard]] double half_area() const {
        return extent().x * extent().y + extent().y * extent().z + extent().z * extent().x;
    }
};

/// Calls visit(node, cell) for every node; the cell's leaf is the node. Lower children come first.
template <class Visit>
void walk_tree(const mir::KdTree& tree, Visit visit) {
    struct Waiting {
        std::uint32_t node = 0;
        LeafCell cell;
    };
    std::vector<Waiting> stack{
        {mir::KdTreeView<mir::Space::host>::root, {{}, tree.view().low, tree.view().high, 0}}};
    while (!stack.empty()) {
        Waiting w = stack.back();
        stack.pop_back();
        const mir::KdNode node = tree.nodes()[w.node];
        w.cell.leaf = node;
        visit(node, w.cell);
        if (node.is_leaf()) continue;
        Waiting below{node.below(), w.cell};
        Waiting above{node.below() + 1, w.cell};
        const auto axis = static_cast<int>(node.axis());
        below.cell.high[axis] = above.cell.low[axis] = node.split();
        below.cell.depth = above.cell.depth = w.cell.depth + 1;
        stack.push_back(above);
        stack.push_back(below);
    }
}

inline std::vector<LeafCell> leaf_cells(const mir::KdTree& tree) {
    std::vector<LeafCell> leaves;
    walk_tree(tree, [&](mir::KdNode node, const LeafCell& cell) {
        if (node.is_leaf()) leaves.push_back(cell);
    });
    return leaves;
}

/// What statistics should say.
struct TreeCount {
    std::uint64_t inner = 0;
    std::uint64_t leaves = 0;
    std::uint64_t empty = 0;
    std::uint64_t references = 0;
    std::uint32_t depth = 0;
    std::uint32_t largest = 0;
    double cost = 0.0;
};

inline TreeCount count_tree(const mir::KdTree& tree, double visit_cost) {
    TreeCount count;
    const double root = LeafCell{{}, tree.view().low, tree.view().high, 0}.half_area();
    walk_tree(tree, [&](mir::KdNode node, const LeafCell& cell) {
        if (!node.is_leaf()) {
            ++count.inner;
            count.cost += visit_cost * cell.half_area() / root;
            return;
        }
        ++count.leaves;
        count.empty += node.count() == 0 ? 1 : 0;
        count.references += node.count();
        count.depth = std::max(count.depth, cell.depth);
        count.largest = std::max(count.largest, node.count());
        count.cost += node.count() * cell.half_area() / root;
    });
    return count;
}

/// The part of a polygon on one side of a plane, in double precision.
inline std::vector<mir::detail::Double3> clipped(const std::vector<mir::detail::Double3>& polygon,
                                                 int axis, double at, double sign) {
    std::vector<mir::detail::Double3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const mir::detail::Double3 a = polygon[i];
        const mir::detail::Double3 b = polygon[(i + 1) % polygon.size()];
        const double da = sign * (a[axis] - at);
        const double db = sign * (b[axis] - at);
        if (da >= 0) kept.push_back(a);
        if ((da >= 0) != (db >= 0)) kept.push_back(a + (b - a) * (da / (da - db)));
    }
    return kept;
}

/// True when the triangle's accept region, grown by `grow` on each axis, meets the closed cell
/// within reach of segments.
inline bool region_meets(const mir::detail::AcceptTriangle& t, mir::Vec3 low, mir::Vec3 high,
                         mir::detail::Double3 grow, float reach) {
    low = glm::max(low, mir::Vec3(-reach));
    high = glm::min(high, mir::Vec3(reach));
    if (low.x > high.x || low.y > high.y || low.z > high.z) return false;
    std::vector<mir::detail::Double3> polygon{t.a, t.b, t.c};
    for (int axis = 0; axis < 3; ++axis) {
        polygon = clipped(polygon, axis, double(low[axis]) - grow[axis], 1.0);
        polygon = clipped(polygon, axis, double(high[axis]) + grow[axis], -1.0);
    }
    return !polygon.empty();
}

inline mir::detail::AcceptTriangle accept_triangle_of(const mir::WorldGeometry& geometry,
                                                      std::uint32_t triangle) {
    return mir::detail::accept_triangle(geometry.corner(triangle, 0), geometry.corner(triangle, 1),
                                        geometry.corner(triangle, 2),
                                        mir::magnitude_of(geometry.bounds()));
}

/// How many (leaf, triangle) pairs break what a leaf must list.
struct ListErrors {
    std::uint64_t missing = 0;      ///< the accept region meets the cell, but it is not listed
    std::uint64_t superfluous = 0;  ///< listed, but far away
};

/// What is asked about one triangle at every leaf.
struct ListedRegion {
    mir::detail::AcceptTriangle region;
    mir::detail::Double3 sigma{0};
    mir::detail::Double3 far{0};  ///< so much farther than it must a triangle not be listed
    float reach = 0.0f;
    bool is_wild = false;  ///< leaves the reach, and is cut as a box only

    ListedRegion(const mir::WorldGeometry& geometry, std::uint32_t triangle)
        : region(accept_triangle_of(geometry, triangle)) {
        const float magnitude = mir::magnitude_of(geometry.bounds());
        sigma = mir::detail::Double3(mir::sigma_of(magnitude));
        reach = mir::reach_of(magnitude);
        far = 4.0 * mir::detail::clip_margin(high() - low(), magnitude);
        for (int axis = 0; axis < 3; ++axis)
            is_wild = is_wild || low()[axis] < -double(reach) || high()[axis] > double(reach);
    }

    [[nodiscard]] mir::detail::Double3 low() const {
        return glm::min(region.a, glm::min(region.b, region.c));
    }
    [[nodiscard]] mir::detail::Double3 high() const {
        return glm::max(region.a, glm::max(region.b, region.c));
    }

    /// False when even the boxes are far from each other.
    [[nodiscard]] bool is_near(const LeafCell& cell) const {
        bool near = true;
        for (int axis = 0; axis < 3; ++axis)
            near = near && double(cell.low[axis]) <= high()[axis] + far[axis] &&
                   double(cell.high[axis]) >= low()[axis] - far[axis];
        return near;
    }
};

/// By asking every triangle at every leaf.
inline ListErrors list_errors(const mir::WorldGeometry& geometry, const mir::KdTree& tree) {
    ListErrors errors;
    std::uint64_t seen = 0;
    const std::vector<LeafCell> cells = leaf_cells(tree);
    for (std::uint32_t i = 0; i < geometry.triangles().size(); ++i) {
        const ListedRegion t(geometry, i);
        for (const LeafCell& cell : cells) {
            if (!t.is_near(cell)) continue;
            const std::uint32_t* first = tree.references().data() + cell.leaf.first();
            const std::uint32_t* last = first + cell.leaf.count();
            const bool listed = std::find(first, last, i) != last;
            seen += listed ? 1 : 0;
            if (!listed && region_meets(t.region, cell.low, cell.high, t.sigma, t.reach))
                ++errors.missing;
            if (listed && !t.is_wild &&
                !region_meets(t.region, cell.low, cell.high, t.far, t.reach))
                ++errors.superfluous;
        }
    }
    errors.superfluous += tree.references().size() - seen;
    return errors;
}

}  // namespace mirtest
