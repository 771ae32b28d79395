// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/accel/wide/collapse_level.hpp"
#include "mir/scene/geometry_view.hpp"

namespace mir::detail {

/// Where a tree is written to.
struct WideArrays {
    WideNode* nodes = nullptr;
    TriangleRows* rows = nullptr;
    std::uint32_t* indices = nullptr;  ///< triangles by place
};

/// Kernel over one index: the root of a scene without triangles.
struct WriteEmptyRoot {
    WideArrays to;
    float reach = 0.0f;

    MIR_HD void operator()(std::uint32_t /*i*/) const {
        for (std::uint32_t slot = 0; slot < WideNode::width; ++slot)
            to.nodes[0].set_empty(slot, reach);
    }
};

/// Kernel over wide nodes: writes them, and the triangles of their leaves.
struct WriteWideNodes {
    const BinaryNode* binary = nullptr;
    WideNotes notes;
    WideArrays to;
    std::uint32_t leaf_size = 0;
    float reach = 0.0f;

    MIR_HD void operator()(std::uint32_t i) const {
        std::uint32_t next = notes.first_child[i];
        std::uint32_t place = notes.first_triangle[i];
        WideNode& node = to.nodes[i];
        for (std::uint32_t slot = 0; slot < WideNode::width; ++slot) {
            if (slot >= notes.children[i].count) {
                node.set_empty(slot, reach);
                continue;
            }
            const std::uint32_t child = notes.children[i].at[slot];
            if (binary[child].count > leaf_size)
                set_child(node, slot, child, next++, WideNode::inner);
            else
                place = set_leaf(node, slot, child, place);
        }
    }

 private:
    MIR_HD void set_child(WideNode& node, std::uint32_t slot, std::uint32_t child,
                          std::uint32_t ref, std::int32_t count) const {
        const BinaryNode& from = binary[child];
        node.set_bounds(0, slot, from.low.x, from.high.x);
        node.set_bounds(1, slot, from.low.y, from.high.y);
        node.set_bounds(2, slot, from.low.z, from.high.z);
        node.ref[slot] = ref;
        node.count[slot] = count;
    }

    /// The place after its triangles.
    [[nodiscard]] MIR_HD std::uint32_t set_leaf(WideNode& node, std::uint32_t slot,
                                                std::uint32_t child, std::uint32_t place) const {
        set_child(node, slot, child, place, static_cast<std::int32_t>(binary[child].count));
        list_triangles(child, place);
        return place + binary[child].count;
    }

    /// From left to right. No way down to one of 8 triangles has more branches than 7.
    MIR_HD void list_triangles(std::uint32_t below, std::uint32_t place) const {
        std::uint32_t waiting[8];
        std::uint32_t count = 0;
        waiting[count++] = below;
        while (count > 0) {
            const BinaryNode& node = binary[waiting[--count]];
            if (node.count == 1) {
                to.indices[place++] = node.left;
            } else {
                waiting[count++] = node.right;
                waiting[count++] = node.left;
            }
        }
    }
};

/// Kernel over places: the rows of the triangles there.
template <Space S>
struct WriteRows {
    GeometryView<S> geometry;
    WideArrays to;

    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t t = to.indices[i];
        to.rows[i] =
            make_triangle_rows(geometry.corner(t, 0), geometry.corner(t, 1), geometry.corner(t, 2));
    }
};

/// Kernel over places: turns numbers among chosen triangles into those of the scene.
struct Renumber {
    const std::uint32_t* numbers = nullptr;  ///< in the scene
    std::uint32_t* indices = nullptr;

    MIR_HD void operator()(std::uint32_t i) const { indices[i] = numbers[indices[i]]; }
};

}  // namespace mir::detail
