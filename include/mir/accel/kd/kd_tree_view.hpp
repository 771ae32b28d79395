// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/accel/kd/kd_node.hpp"
#include "mir/accel/kd/kd_options.hpp"
#include "mir/core/space.hpp"

namespace mir {

/// What traversal reads of a kd-tree. Cells at the border of the tree have no outer limit.
/// accept_box.hpp says which triangles a leaf must list.
template <Space S>
struct KdTreeView {
    static constexpr Space space = S;  ///< of the memory that it points to

    /// Largest number of planes between the root and a leaf. Traversal keeps a stack of this size.
    static constexpr std::uint32_t max_depth = KdTreeOptions::depth_limit;

    /// Index of the first node. Children follow in pairs, each with an even index.
    static constexpr std::uint32_t root = 1;

    const KdNode* nodes = nullptr;              ///< aligned to 16 bytes
    const std::uint32_t* references = nullptr;  ///< triangle indices, leaf by leaf
    const TriangleRows* triangles = nullptr;    ///< by triangle index of WorldGeometry
    Vec3 low{0};                                ///< box around all accept boxes
    Vec3 high{0};                               ///< upper corner of that box, metres
    float reach = 0.0f;  ///< metres: reach_of(magnitude_of(bounds of the scene)), accept_box.hpp

    /// Both children of an inner node, in one fetch.
    [[nodiscard]] MIR_HD KdChildren children(KdNode inner) const {
        return *reinterpret_cast<const KdChildren*>(nodes + inner.below());
    }
};

}  // namespace mir
