// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/triangle_mask.hpp"
#include "mir/concepts/ray_finder.hpp"

namespace mir {

/// Finds first triangles by a tree over them. Model of RayFinder; the same bits on host and device.
/// `TreeView` is what traversal reads of the tree: it has first_hit() and is_hidden(). `M` says
/// which points of triangles are there. What it reads must outlive it. Thread-safe.
template <class TreeView, class M = UsualMask<TreeView::space>>
struct TreeRayFinder {
    static constexpr Space space = TreeView::space;  ///< of the tree
    using View = TreeView;                           ///< what the tree is read by
    using Mask = M;                                  ///< an Opaque or an AlphaMaskView

    View tree;    ///< of the scene
    Mask mask{};  ///< which points of triangles are there

    /// The first triangle along the ray, t in metres: first_hit(). What lies farther than `within`
    /// metres may not be found.
    [[nodiscard]] MIR_HD TriangleHit closest(const Ray& ray, float within = INFINITY) const {
        return first_hit(tree, ray, mask, within);
    }
    /// Whether a triangle lies between two points, metres: is_hidden(). One that is seen through
    /// does, too.
    [[nodiscard]] MIR_HD bool hides(Vec3 from, Vec3 to) const {
        return is_hidden(tree, from, to, mask);
    }
};

}  // namespace mir
